#!/bin/bash
# SPDX-License-Identifier: MIT
# The calling contract of repack_atlas. Usage: repack_atlas_cli_test.sh PROGRAM VERIFY_ATLAS
verify=$(realpath "$2") || exit 2
source "$(dirname "$0")/cli_helpers.sh"
cd "$folder" || exit 2

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

expect_match 0 '^charts=5 pages=1 .* valid$' piled.obj -o out.obj --texture-size 256 --effort fast
valid out.obj --texture-size 256 --gutter 2
cp out.obj one.obj
expect_match 0 'valid' piled.obj -o out.obj --texture-size 256 --effort fast --threads 1
cmp -s out.obj one.obj || fail "one thread gives other bytes"
[ "$(grep -c '^f ' out.obj)" -eq 5 ] || fail "faces are lost"
expect_match 0 'valid' piled.obj -o out.obj --texture-size 256x128 --gutter 6 --effort fast --rotation quarter
valid out.obj --texture-size 256x128 --gutter 6
expect_match 0 'valid' out.obj -o again.obj --texture-size 64 --effort fast --rotation none
# 100 texels per unit: each quad measures 10 x 20 texels; a page of 32 x 32 holds two of them at most.
expect_match 0 'pages=[345] .*texels_per_unit=100 ' piled.obj -o out.obj --texture-size 32 --density 100 --effort fast
awk '$1 == "vt" && $2 > 1 { n = 1 } END { exit !n }' out.obj || fail "no second tile"
run 0 piled.obj -o out.obj --texture-size 16 --density 100 --effort fast
grep -q 'a chart at 100 texels per unit is larger than a page' stderr || fail "a lower density is not told: $(cat stderr)"
expect_match 2 'must end in .obj' piled.obj -o out.glb
[ ! -e out.glb ] || fail "an OBJ file of another name"
expect_match 0 'pages=2' piled.obj -o out.obj --texture-size 64 --pages 2 --effort fast
# Copies that lie on each other as they were asked to are no fault; all of them cover the page once.
for stack in copies mirrored; do
  expect_match 0 'charts=5 .*stacked=[1-4] valid' piled.obj -o out.obj --texture-size 64 --stack $stack --effort fast
  awk -F'efficiency=' '{ exit !($2 + 0 > 0 && $2 + 0 <= 1) }' stdout || fail "stacked charts count twice: $(cat stdout)"
done
# Charts that lie face down are mirror images of those that do not, of which they may cover the place.
(grep -v '^f ' piled.obj; printf 'vt 0.1 0.1\nvt 0.2 0.1\nvt 0.1 0.3\nf 1/1 2/2 3/3 4/4\nf 6/2 5/1 8/4 7/3\nf 9/5 10/6 11/7\nf 14/5 13/7 15/6\n') >facing.obj
expect_match 0 'charts=4 .*stacked=0 valid' facing.obj -o out.obj --texture-size 64 --stack copies --effort fast
expect_match 0 'charts=4 .*stacked=2 valid' facing.obj -o out.obj --texture-size 64 --stack mirrored --effort fast
expect_match 0 'stacked=0 valid' piled.obj -o out.obj --texture-size 64 --effort fast
expect_match 1 'NOT VALID' folded.obj -o out.obj --texture-size 64 --stack copies --effort fast
expect_match 2 'cannot write' piled.obj -o no/such/folder.obj
expect_match 2 'stack' piled.obj -o out.obj --stack all
expect_match 1 'NOT VALID' folded.obj -o out.obj --texture-size 64 --effort fast
expect_match 0 'valid' piled.obj -o out.obj --texture-size 64 --effort fast --texture paint.png
grep -q 'map_Kd paint.png' out.mtl || fail "no texture in the material library"
expect_match 0 'Usage' --help
# What charts of materials may do. `sides FILE`: the width in texels of each face on a page of 256.
(sed '/^f /d' piled.obj
 printf 'usemtl a\n' && grep '^f ' piled.obj | sed -n '1,2p'
 printf 'usemtl b=c\n' && grep '^f ' piled.obj | sed -n '3,5p') >materials.obj
sides() {
  awk '$1 == "vt" { u[++n] = $2 * 256; v[n] = $3 * 256 }
       $1 == "f" { split($2, a, "/"); split($3, b, "/"); printf "%.2f\n", sqrt((u[a[2]] - u[b[2]])^2 + (v[a[2]] - v[b[2]])^2) }' "$1"
}
expect_match 0 'valid' materials.obj -o out.obj --texture-size 256 --weight b=c=2.5 --effort fast
sides out.obj | awk '{ s[NR] = $1 } END { exit !(NR == 5 && s[1] > 1 && s[3] / s[1] > 2.499 && s[3] / s[1] < 2.501 && s[1] == s[2]) }' ||
  fail "weights: $(sides out.obj | tr '\n' ' ')"
expect_match 0 'gutter=8.00 .*valid' materials.obj -o out.obj --texture-size 256 --mip-levels 3 --effort fast
expect_match 0 'gutter=5.66 .*valid' materials.obj -o out.obj --texture-size 256 --block 4 --effort fast
# Charts apart from each other already: those of one material stay, in their tile.
awk '$1 == "vt" { next } { print }
     $1 == "v" && !done { for (i = 0; i < 5; ++i) { x = 0.15 * i + (i > 3)
       printf "vt %g 0.1\nvt %g 0.1\nvt %g 0.3\nvt %g 0.3\n", x, x + 0.1, x + 0.1, x } done = 1 }' materials.obj |
  awk '$1 == "f" { for (k = 0; k < 4; ++k) printf "%s%d/%d%s", k ? " " : "f ", 4 * n + k + 1, 4 * n + k + 1, k < 3 ? "" : "\n"; ++n; next } { print }' >apart.obj
corners() { awk '$1 == "vt" { u[++n] = $2; v[n] = $3 } $1 == "f" { for (k = 2; k <= NF; ++k) { split($k, a, "/"); printf "%.5f %.5f ", u[a[2]], v[a[2]] } print "" }' "$1"; }
expect_match 0 'pages=2.*valid' apart.obj -o out.obj --texture-size 256 --lock b=c --effort fast
[ "$(corners out.obj | sed -n '3,5p')" = "$(corners apart.obj | sed -n '3,5p')" ] || fail "locked charts have moved"
[ "$(corners out.obj | sed -n '1,2p')" = "$(corners apart.obj | sed -n '1,2p')" ] && fail "the other charts stay"
expect_match 0 'valid' apart.obj -o out.obj --texture-size 256 --group a --effort fast
corners out.obj | awk '{ x[NR] = $1; y[NR] = $2; w[NR] = sqrt(($1 - $3)^2 + ($2 - $4)^2) }
  END { d = sqrt((x[1] - x[2])^2 + (y[1] - y[2])^2) / w[1]; exit !(d > 1.499 && d < 1.501) }' || fail "no group"
expect_match 2 'weight' materials.obj -o out.obj --weight a
expect_match 2 'weight' materials.obj -o out.obj --weight a=-1
expect_match 2 "no material called 'none'" materials.obj -o out.obj --lock none
expect_match 2 'square' materials.obj -o out.obj --lock a --texture-size 64x32
sed 's/^vt 1.6 /vt 91.6 /; s/^vt 1.7 /vt 91.7 /' apart.obj >far.obj
expect_match 2 'outside of the tiles' far.obj -o out.obj --lock b=c
# Sixteen squares of a sheet, each a chart; the picture is one of 8 x 8 pixels.
python3 - <<'MESH'
import struct, zlib
with open("sheet.obj", "w") as out:
    out.write("mtllib sheet.mtl\nusemtl m\n")
    for y in range(5):
        for x in range(5):
            out.write(f"v {x} {y} 0\n")
    for f in range(16):
        x, y = f % 4, f // 4
        u, v = (3 - y) / 4, (3 - x) / 4  # not in the order of the sheet
        for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
            out.write(f"vt {u + 0.05 + 0.15 * du} {v + 0.05 + 0.15 * dv}\n")
        a = y * 5 + x + 1
        out.write(f"f {a}/{4 * f + 1} {a + 1}/{4 * f + 2} {a + 6}/{4 * f + 3} {a + 5}/{4 * f + 4}\n")
open("sheet.mtl", "w").write("newmtl m\nmap_Kd sheet.png\n")
rows = b"".join(b"\0" + b"\xff\0\0" * 4 + b"\0\0\xff" * 4 for _ in range(8))
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
open("sheet.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 8, 8, 2, 0, 0, 0)) +
                              chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
MESH
expect_match 0 '^charts=1 before=16 pages=1 .* valid$' sheet.obj -o merged.obj --defragment --texture-size 128
valid merged.obj --texture-size 128 --gutter 2
grep -q 'map_Kd merged_texture.png' merged.mtl && [ -s merged_texture.png ] || fail "the texture stays behind"
grep -q '^usemtl m' merged.obj || fail "the material is lost"
expect_match 0 '^charts=1 before=16' sheet.obj -o merged.obj --defragment --threads 1 --gutter 0
[ "$(od -A n -t u1 -j 19 -N 1 merged_texture.png | tr -d ' ')" = 8 ] || fail "another size than that of the picture"
rm merged*
# Without a picture there is none; what does not hang together does not merge.
expect_match 0 '^charts=5 before=5 .* valid$' piled.obj -o merged.obj --defragment --texture-size 64
[ "$(ls merged*)" = merged.obj ] || fail "a picture of nothing: $(ls merged*)"
expect_match 2 'max-stretch' sheet.obj -o merged.obj --max-stretch 2
expect_match 2 'max-distortion' sheet.obj -o merged.obj --defragment --max-distortion 0.5
expect_match 2 'texture' sheet.obj -o merged.obj --defragment --texture a.png
expect_match 2 'no texture coordinates' bare.obj -o out.obj --defragment
expect_match 2 'no texture coordinates' bare.obj -o out.obj
expect_match 2 'missing.obj' missing.obj -o out.obj
expect_match 2 'broken.glb' broken.glb -o out.obj
expect_match 2 'nowhere' piled.obj -o nowhere/out.obj --effort fast
for size in 0 x 12x 12x0 -5 64x64x64; do
  expect_match 2 'texture-size' piled.obj -o out.obj --texture-size=$size
done
expect_match 2 'gutter' piled.obj -o out.obj --gutter -1
expect_match 2 'effort' piled.obj -o out.obj --effort lazy
expect_match 2 'rotation' piled.obj -o out.obj --rotation some
expect_match 2 'density' piled.obj -o out.obj --density 0
expect_match 2 'output' piled.obj
expect_match 2 'FILE' -o out.obj

finish
