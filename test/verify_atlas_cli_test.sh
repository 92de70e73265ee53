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

# Two triangles apart in space, as points for binary files: three floats a corner, then two a corner.
positions='\0\0\0\0\0\0\0\0\0\0\0\0 \0\0\x80\x3f\0\0\0\0\0\0\0\0 \0\0\0\0\0\0\x80\x3f\0\0\0\0
           \0\0\x80\x40\0\0\0\0\0\0\0\0 \0\0\xa0\x40\0\0\0\0\0\0\0\0 \0\0\x80\x40\0\0\x80\x3f\0\0\0\0'
low='\0\0\x80\x3e' middle='\0\0\0\x3f' high='\0\0\x40\x3f' # 1/4, 1/2, 3/4
apart="$low$low $middle$low $low$middle  $high$high $middle$high $high$middle"
crossed="$low$low $high$low $low$high  $high$high $low$high $high$low"
stacked="$low$low $high$low $low$high  $low$low $high$low $low$high"
bytes() { printf "$(tr -d ' \n' <<<"$1")"; }

# gltf NAME UV: the second triangle is found by its indices
gltf() {
  local data
  data=$( (bytes "$positions$2"; bytes '\0\0\1\0\2\0\3\0\4\0\5\0') | base64 -w 0)
  cat >"$1" <<JSON
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
 "buffers": [{"byteLength": 132, "uri": "data:application/octet-stream;base64,$data"}],
 "bufferViews": [{"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 48},
                 {"buffer": 0, "byteOffset": 120, "byteLength": 12}],
 "accessors": [
  {"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [0, 0, 0], "max": [5, 1, 0]},
  {"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"},
  {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}]}
JSON
}
gltf apart.gltf "$apart"
gltf stacked.gltf "$stacked"
gltf crossed.gltf "$crossed"

# ply NAME UV: binary, coordinates per corner of the faces
ply() {
  local corners=${2//$'\n'/} v
  corners=${corners// /}
  {
    printf 'ply\nformat binary_little_endian 1.0\nelement vertex 6\nproperty float x\nproperty float y\n'
    printf 'property float z\nelement face 2\nproperty list uchar int vertex_indices\n'
    printf 'property list uchar float texcoord\nend_header\n'
    bytes "$positions"
    v=${#corners}
    bytes "\\3\\0\\0\\0\\0\\1\\0\\0\\0\\2\\0\\0\\0\\6${corners:0:v/2}"
    bytes "\\3\\3\\0\\0\\0\\4\\0\\0\\0\\5\\0\\0\\0\\6${corners:v/2}"
  } >"$1"
}
ply apart.ply "$apart"
ply stacked.ply "$stacked"

expect 0 '^valid' apart.gltf
expect 0 'charts  *2$' apart.gltf --gutter 4
expect 0 'mirrored  *2$' apart.gltf # v runs down in glTF: read as they are drawn
expect 1 'NOT VALID: 1 overlapping pairs of triangles between charts$' stacked.gltf
expect 0 '"overlaps_between_charts": 0' crossed.gltf --json
expect 1 'charts 0 texels apart instead of 1' crossed.gltf --gutter 1
expect 0 '^valid' apart.ply
expect 0 'charts  *2$' apart.ply --gutter 4
expect 1 'NOT VALID: 1 overlapping pairs of triangles between charts$' stacked.ply
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
expect 0 '^valid' good.obj --picture before.png
expect 1 'border of the page' good.obj --texture-size 8 --gutter 6 --picture after.png
cmp -s before.png after.png && fail "the picture does not show faults of the gutter"
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
