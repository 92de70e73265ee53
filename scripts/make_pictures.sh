#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pictures of the manual anew with texture_atlas, from meshes of Debian's package libcgal-demo; netpbm
# makes them small, and Chromium shows the report of a run.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${ATLAS_EXAMPLE_PACKAGES[@]}" netpbm libbenchmark-dev chromium
build example texture_atlas
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
archive=$(demo_archive)
atlas=$atlas_root/build/example/bin/texture_atlas

# small IN OUT WIDTH: scales to so many pixels and 255 colours.
small() {
  pngtopnm "$1" | pnmscale -width "$3" | pnmquant 255 | pnmtopng -compression 9 >"$atlas_root/doc/pictures/$2"
}

for mesh in bunny00 camel; do
  tar --extract --gzip --to-stdout --file "$archive" "data/meshes/$mesh.off" >"$folder/$mesh.off"
  "$atlas" "$folder/$mesh.off" -o "$folder/$mesh.obj" \
    --pictures --picture "$folder/$mesh.png" >&2
done
small "$folder/bunny00.png" bunny.png 1400
small "$folder/camel_view.png" camel_view.png 700
small "$folder/camel_stretch.png" camel_stretch.png 700

# Colours at vertices, as a scanner gives them (here stripes and spots by position), baked into the page of few charts.
awk 'NF == 0 { next }
     line++ == 0 { print "COFF"; next }
     line == 2 { n = $1 }
     line > 2 && line <= n + 2 { r = 0.5 + 0.5 * sin(90 * $2); g = 0.5 + 0.5 * sin(70 * $1 + 50 * $3); b = 0.5 + 0.5 * cos(60 * $2)
                             printf "%s %s %s %d %d %d 255\n", $1, $2, $3, 255 * r, 90 + 160 * g, 255 * b; next }
     { print }' "$folder/bunny00.off" >"$folder/colored.off"
"$atlas" "$folder/colored.off" -o "$folder/colored.obj" \
  --bake colors --bake normals --bake occlusion --pictures >&2
for name in color normal occlusion view; do
  pngtopnm "$folder/colored_$name.png" | pnmscale -xsize 480 -ysize 480 >"$folder/$name.pnm"
done
pnmcat -lr "$folder"/{color,normal,occlusion,view}.pnm | pnmquant 255 | pnmtopng -compression 9 >"$atlas_root/doc/pictures/bake.png"
# The gallery: a machine part, a house and an animal, the page beside the model.
tar --extract --gzip --to-stdout --file "$archive" data/meshes/couplingdown.off >"$folder/coupling.off"
tar --extract --gzip --to-stdout --file "$archive" data/meshes/elephant.off >"$folder/elephant.off"
cat >"$folder/house.obj" <<'MESH'
v 0 0 0
v 3 0 0
v 3 0 2
v 0 0 2
v 0 1.6 0
v 3 1.6 0
v 3 1.6 2
v 0 1.6 2
v 0 2.5 1
v 3 2.5 1
f 4 3 2 1
f 1 2 6 5
f 3 4 8 7
f 4 1 5 9 8
f 2 3 7 10 6
f 5 6 10 9
f 7 8 9 10
MESH
"$atlas" "$folder/coupling.off" -o "$folder/coupling.obj" --picture "$folder/coupling.png" >&2
"$atlas" "$folder/elephant.off" -o "$folder/elephant_atlas.obj" --picture "$folder/elephant.png" >&2
"$atlas" "$folder/house.obj" -o "$folder/house_atlas.obj" --picture "$folder/house.png" >&2
for name in coupling elephant house; do
  small "$folder/$name.png" "gallery_$name.png" 1000
done
# The first picture that one sees: a scan and a machine part.
for name in bunny00 coupling; do
  pngtopnm "$folder/$name.png" | pnmscale -width 1000 | pnmpad -white -bottom 20 >"$folder/$name.pnm"
done
pnmcat -white -tb "$folder"/{bunny00,coupling}.pnm | pnmquant 255 | pnmtopng -compression 9 >"$atlas_root/doc/pictures/front.png"
# One model on pages that are ever fuller.
for coverage in 0 0.80 0.85; do
  "$atlas" "$folder/camel.off" -o "$folder/full.obj" --min-coverage "$coverage" --pictures >&2 || [ $? -eq 5 ]
  pngtopnm "$folder/full_page.png" | pnmscale -xsize 460 | pnmpad -white -left 10 -right 10 >"$folder/full_$coverage.pnm"
done
pnmcat -white -lr "$folder"/full_{0,0.80,0.85}.pnm | pnmquant 255 | pnmtopng -compression 9 >"$atlas_root/doc/pictures/full_pages.png"
# The report of a run, as a browser shows it.
tar --extract --gzip --to-stdout --file "$archive" data/meshes/homer.off >"$folder/homer.off"
"$atlas" "$folder/homer.off" -o "$folder/homer.obj" --pictures >&2
chromium --headless --no-sandbox --disable-quic --no-first-run --disable-background-networking --disable-component-update --disable-sync \
  --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --user-data-dir="$folder/chromium" --hide-scrollbars \
  --window-size=1280,1000 --virtual-time-budget=10000 --screenshot="$folder/report.png" "file://$folder/homer.html" >&2
small "$folder/report.png" report.png 960
# The pages of four packers for the same charts, side by side: rectangles, horizon, fast, best.
build benchmark packing_benchmark
tar --extract --gzip --to-stdout --file "$archive" data/meshes/dino.off >"$folder/dino.off"
"$atlas" "$folder/dino.off" -o "$folder/dino.obj" >&2
"$atlas_root/build/benchmark/benchmark/packing_benchmark" --pictures "$folder/packer" "$folder/dino.obj"
for packer in rectangles horizon fast best; do
  pngtopnm "$folder/packer_$packer.png" >"$folder/packer_$packer.ppm"
done
pnmcat -white -lr "$folder"/packer_{rectangles,horizon,fast,best}.ppm | pnmtopng >"$folder/packers.png"
small "$folder/packers.png" packers.png 1400
# The steps of segmentation as in the paper's figures 4 to 6: features, distance to seeds, distance to features and
# charts of the bunny; the legs of the camel, rolled, and its feet, socks; a ribbon that winds over itself.
build example segmentation_steps
steps="$atlas_root/build/example/bin/segmentation_steps"
# row OUT WIDTH PICTURES...: side by side, in all their colours.
row() {
  local out=$1 width=$2 name
  shift 2
  for name; do
    pngtopnm "$folder/$name.png" >"$folder/$name.ppm"
  done
  pnmcat -lr $(printf "$folder/%s.ppm " "$@") | pnmscale -width "$width" |
    pnmtopng -compression 9 >"$atlas_root/doc/pictures/$out"
}
"$steps" "$folder/bunny00.off" -o "$folder/bunny" --size 800
row segmentation_steps.png 1400 bunny_{features,seeds,distance,charts}
"$steps" "$folder/camel.off" -o "$folder/camel" --size 1600 --azimuth 40 --elevation 8
pngtopnm "$folder/camel_charts.png" | pnmcut -left 380 -top 200 -width 860 -height 1240 | pnmtopng >"$folder/camel_left.png"
pngtopnm "$folder/camel_charts.png" | pnmcut -left 570 -top 985 -width 300 -height 433 |
  pnmscale -xsize 860 -ysize 1240 | pnmtopng >"$folder/camel_right.png"
row segmentation_cylinders.png 1000 camel_left camel_right
awk 'BEGIN {
  m = 200; n = 24; print "OFF"; print (m + 1) * (n + 1), m * n, 0
  for (i = 0; i <= m; ++i)
    for (j = 0; j <= n; ++j) { a = 1.3 * 6.2831853 * i / m; r = 1.2 + 0.8 * j / n; print r * cos(a), 0.28 * a, -r * sin(a) }
  for (i = 0; i < m; ++i)
    for (j = 0; j < n; ++j) { k = i * (n + 1) + j; print 4, k, k + 1, k + n + 2, k + n + 1 } }' >"$folder/ribbon.off"
"$steps" "$folder/ribbon.off" -o "$folder/ribbon" --size 800 --azimuth 60 --elevation 30 --ball 0 0 0 100
row segmentation_overlap.png 1400 ribbon_{one_chart,overlap,parts,split}
ls -l "$atlas_root/doc/pictures" >&2
