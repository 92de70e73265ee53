#!/bin/bash
# SPDX-License-Identifier: MIT
# The calling contract of repack_atlas. Usage: repack_atlas_cli_test.sh PROGRAM VERIFY_ATLAS
program=$(realpath "$1") || exit 2
verify=$(realpath "$2") || exit 2
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
  grep -q -e "$pattern" $stream || fail "no '$pattern' on $stream: $* ($(cat $stream))"
  [ "$code" -eq 2 ] || [ ! -s stderr ] || fail "something on stderr: $*"
}

# Five quads that all lie on top of each other, each another piece of the plane.
for i in 0 1 2 3 4; do
  printf 'v %d 0 0\nv %d 0 0\nv %d 2 0\nv %d 2 0\n' $((3 * i)) $((3 * i + 1)) $((3 * i + 1)) $((3 * i))
done >piled.obj
printf 'vt 0.1 0.1\nvt 0.2 0.1\nvt 0.2 0.3\nvt 0.1 0.3\n' >>piled.obj
for i in 0 1 2 3 4; do
  echo "f $((4 * i + 1))/1 $((4 * i + 2))/2 $((4 * i + 3))/3 $((4 * i + 4))/4"
done >>piled.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >bare.obj
# The second triangle is folded over the first.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.9 0.3\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n' >folded.obj
printf 'not a mesh' >broken.glb

# valid FILE ARGUMENTS...: what was written is a valid atlas
valid() {
  timeout 60 "$verify" "$@" >/dev/null || fail "not valid: $*"
}

expect 0 '^charts=5 pages=1 .* valid$' piled.obj -o out.obj --texture-size 256 --effort fast
valid out.obj --texture-size 256 --gutter 2
cp out.obj one.obj
expect 0 'valid' piled.obj -o out.obj --texture-size 256 --effort fast --threads 1
cmp -s out.obj one.obj || fail "one thread gives other bytes"
[ "$(grep -c '^f ' out.obj)" -eq 5 ] || fail "faces are lost"
expect 0 'valid' piled.obj -o out.obj --texture-size 256x128 --gutter 6 --effort fast --rotation quarter
expect 0 'valid' out.obj -o again.obj --texture-size 64 --effort fast --rotation none
# 100 texels per unit: each quad measures 10 x 20 texels; a page of 32 x 32 holds two of them at most.
expect 0 'pages=[345] .*texels_per_unit=100 ' piled.obj -o out.obj --texture-size 32 --density 100 --effort fast
awk '$1 == "vt" && $2 > 1 { n = 1 } END { exit !n }' out.obj || fail "no second tile"
expect 0 'pages=2' piled.obj -o out.obj --texture-size 64 --pages 2 --effort fast
expect 1 'NOT VALID.*overlap' piled.obj -o out.obj --texture-size 64 --stack --effort fast
expect 1 'NOT VALID' folded.obj -o out.obj --texture-size 64 --effort fast
expect 0 'valid' piled.obj -o out.obj --texture-size 64 --effort fast --texture paint.png
grep -q 'map_Kd paint.png' out.mtl || fail "no texture in the material library"
expect 0 'Usage' --help
expect 2 'no texture coordinates' bare.obj -o out.obj
expect 2 'missing.obj' missing.obj -o out.obj
expect 2 'broken.glb' broken.glb -o out.obj
expect 2 'nowhere' piled.obj -o nowhere/out.obj --effort fast
for size in 0 x 12x 12x0 -5 64x64x64; do
  expect 2 'texture-size' piled.obj -o out.obj --texture-size=$size
done
expect 2 'gutter' piled.obj -o out.obj --gutter -1
expect 2 'effort' piled.obj -o out.obj --effort lazy
expect 2 'rotation' piled.obj -o out.obj --rotation some
expect 2 'density' piled.obj -o out.obj --density 0
expect 2 'output' piled.obj
expect 2 'FILE' -o out.obj

[ $failures -eq 0 ] && echo "all as agreed"
exit $((failures > 0))
