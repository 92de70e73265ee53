#!/bin/bash
# SPDX-License-Identifier: MIT
# The calling contract of verify_atlas. Usage: verify_atlas_cli_test.sh PROGRAM
source "$(dirname "$0")/cli_helpers.sh"
cd "$folder" || exit 2

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

expect_match 0 '^valid' apart.gltf
expect_match 0 'charts  *2$' apart.gltf --gutter 4
expect_match 0 'mirrored  *2$' apart.gltf # v runs down in glTF: read as they are drawn
expect_match 1 'NOT VALID: 1 overlapping pairs of triangles between charts$' stacked.gltf
expect_match 0 '"overlaps_between_charts": 0' crossed.gltf --json
expect_match 1 'charts 0 texels apart instead of 1' crossed.gltf --gutter 1
expect_match 0 '^valid' apart.ply
expect_match 0 'charts  *2$' apart.ply --gutter 4
expect_match 1 'NOT VALID: 1 overlapping pairs of triangles between charts$' stacked.ply
expect_match 0 '^valid' good.obj
expect_match 0 'charts  *1$' good.obj --texture-size 512 --gutter 4
expect_match 1 'border of the page' good.obj --texture-size 8 --gutter 6
expect_match 1 'border of the page' good.obj --texture-size 8x100 --gutter 6
expect_match 0 '"page_border_distance_texels": 25.0' good.obj --texture-size 100x400 --gutter 6 --json
expect_match 2 'texture-size' good.obj --texture-size 100x
expect_match 0 '"is_valid": true' good.obj --json
expect_match 0 '"page_border_distance_texels": 256.0' good.obj --json
expect_match 1 'NOT VALID: 1 flipped' flipped.obj
expect_match 1 '"is_valid": false' flipped.obj --json
expect_match 1 '1 flat triangles' flat.obj
expect_match 1 '1 triangles without finite coordinates' nan.obj
expect_match 0 '^valid' wedge.ply
expect_match 0 '^valid' wedge.ply --precision single
expect_match 1 'NOT VALID' flipped.obj --picture page.png
[ "$(head -c 4 page.png | tail -c 3)" = PNG ] || fail "no picture"
expect_match 0 '^valid' good.obj --picture before.png
expect_match 1 'border of the page' good.obj --texture-size 8 --gutter 6 --picture after.png
cmp -s before.png after.png && fail "the picture does not show faults of the gutter"
expect_match 0 'Usage' --help
expect_match 2 'no texture coordinates' bare.obj
expect_match 2 'missing.obj' missing.obj
expect_match 2 'broken.glb' broken.glb
expect_match 2 'nowhere' good.obj --picture nowhere/page.png
expect_match 2 'texture-size' good.obj --texture-size 0
expect_match 2 'gutter' good.obj --gutter -1
expect_match 2 'precision' good.obj --precision half
expect_match 2 'wrong' good.obj --wrong
expect_match 2 'FILE'
if [ -w /dev/full ]; then
  timeout 60 "$program" good.obj >/dev/full 2>stderr
  [ $? -eq 2 ] || fail "exit code on a full disk"
fi

# Tiles: two squares side by side, each on a page of its own.
cat >tiles.obj <<OBJ
v 0 0 0
v 1 0 0
v 1 1 0
v 3 0 0
v 4 0 0
v 4 1 0
vt 0.2 0.2
vt 0.8 0.2
vt 0.8 0.8
vt 1.2 0.2
vt 1.8 0.2
vt 1.8 0.8
f 1/1 2/2 3/3
f 4/4 5/5 6/6
OBJ
expect_match 1 'outside' tiles.obj
expect_match 0 '^valid' tiles.obj --udim --gutter 8 --picture tiles.png
[ -s tiles.png ] || fail "no picture of the tiles"
sed 's/^vt 1/vt 0/' tiles.obj >piled.obj
expect_match 1 'between charts' piled.obj --udim
finish
