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
