#!/bin/bash
# SPDX-License-Identifier: MIT
# The calling contract of verify_atlas. Usage: verify_atlas_cli_test.sh PROGRAM
program=$(realpath "$1") || exit 2
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
failures=0

fail() {
  echo "FAILED: $1"
  failures=$((failures + 1))
}

# expect CODE PATTERN ARGUMENTS...: the exit code, and what stdout (0 and 1) or the one line on stderr (2) must match
expect() {
  local code=$1 pattern=$2 stream=stdout
  shift 2
  timeout 60 "$program" "$@" >stdout 2>stderr </dev/null
  local got=$?
  [ $got -eq "$code" ] || fail "exit code $got instead of $code: $* ($(head -n 1 stderr))"
  [ "$code" -eq 2 ] && stream=stderr
  grep -q -e "$pattern" $stream || fail "no '$pattern' on $stream: $*"
  [ "$code" -eq 2 ] || [ ! -s stderr ] || fail "something on stderr: $*"
}

# square NAME U: two triangles, the second one shifted to the left by U where it does not touch the first
square() {
  cat >"$1" <<OBJ
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0.25 0.25
vt 0.75 0.25
vt 0.75 0.75
vt $2 0.75
f 1/1 2/2 3/3
f 1/1 3/3 4/4
OBJ
}
square good.obj 0.25
square flipped.obj 1.25
square flat.obj 0.75
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >bare.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt nan 1\nf 1/1 2/2 3/3\n' >nan.obj
printf 'not a mesh' >broken.glb
cat >wedge.ply <<PLY
ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
property list uchar float texcoord
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2 6 0.1 0.1 0.9 0.1 0.1 0.9
PLY

expect 0 '^valid' good.obj
expect 0 'charts  *1$' good.obj --texture-size 512 --gutter 4
expect 1 'border of the page' good.obj --texture-size 8 --gutter 6
expect 0 '"is_valid": true' good.obj --json
expect 0 '"page_border_distance_texels": 256.0' good.obj --json
expect 1 'NOT VALID: 1 flipped' flipped.obj
expect 1 '"is_valid": false' flipped.obj --json
expect 1 '1 flat triangles' flat.obj
expect 1 '1 triangles without finite coordinates' nan.obj
expect 0 '^valid' wedge.ply
expect 0 '^valid' wedge.ply --precision single
expect 1 'NOT VALID' flipped.obj --picture page.png
[ "$(head -c 4 page.png | tail -c 3)" = PNG ] || fail "no picture"
expect 0 'Usage' --help
expect 2 'no texture coordinates' bare.obj
expect 2 'missing.obj' missing.obj
expect 2 'broken.glb' broken.glb
expect 2 'nowhere' good.obj --picture nowhere/page.png
expect 2 'texture-size' good.obj --texture-size 0
expect 2 'gutter' good.obj --gutter -1
expect 2 'precision' good.obj --precision half
expect 2 'wrong' good.obj --wrong
expect 2 'FILE'
if [ -w /dev/full ]; then
  timeout 60 "$program" good.obj >/dev/full 2>stderr
  [ $? -eq 2 ] || fail "exit code on a full disk"
fi

[ $failures -eq 0 ] && echo "all as agreed"
exit $((failures > 0))
