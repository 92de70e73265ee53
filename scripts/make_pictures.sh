#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pictures of the manual anew with texture_atlas, from meshes of Debian's package libcgal-demo; netpbm
# makes them small.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${ATLAS_EXAMPLE_PACKAGES[@]}" libcgal-demo netpbm libbenchmark-dev
build example texture_atlas
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

# small IN OUT WIDTH: scales to so many pixels and 255 colours.
small() {
  pngtopnm "$1" | pnmscale -width "$3" | pnmquant 255 | pnmtopng -compression 9 >"$atlas_root/doc/pictures/$2"
}

for mesh in bunny00 camel; do
  tar --extract --gzip --to-stdout --file /usr/share/doc/libcgal-dev/data.tar.gz "data/meshes/$mesh.off" >"$folder/$mesh.off"
  "$atlas_root/build/example/examples/texture_atlas" "$folder/$mesh.off" -o "$folder/$mesh.obj" \
    --picture "$folder/$mesh.png" >&2
done
small "$folder/bunny00.png" bunny.png 1400
small "$folder/camel_page.png" camel_page.png 700
small "$folder/camel_view.png" camel_view.png 700
small "$folder/camel_stretch.png" camel_stretch.png 700

# Colours at vertices, as a scanner gives them (here stripes and spots by position), baked into the page of few charts.
awk 'NF == 0 { next }
     line++ == 0 { print "COFF"; next }
     line == 2 { n = $1 }
     line > 2 && line <= n + 2 { r = 0.5 + 0.5 * sin(90 * $2); g = 0.5 + 0.5 * sin(70 * $1 + 50 * $3); b = 0.5 + 0.5 * cos(60 * $2)
                             printf "%s %s %s %d %d %d 255\n", $1, $2, $3, 255 * r, 90 + 160 * g, 255 * b; next }
     { print }' "$folder/bunny00.off" >"$folder/colored.off"
"$atlas_root/build/example/examples/texture_atlas" "$folder/colored.off" -o "$folder/colored.obj" \
  --bake colors --bake normals --bake occlusion >&2
for name in color normal occlusion view; do
  pngtopnm "$folder/colored_$name.png" | pnmscale -xsize 480 -ysize 480 >"$folder/$name.pnm"
done
pnmcat -lr "$folder"/{color,normal,occlusion,view}.pnm | pnmquant 255 | pnmtopng -compression 9 >"$atlas_root/doc/pictures/bake.png"
# The pages of four packers for the same charts, side by side: rectangles, horizon, fast, best.
build benchmark packing_benchmark
tar --extract --gzip --to-stdout --file /usr/share/doc/libcgal-dev/data.tar.gz data/meshes/dino.off >"$folder/dino.off"
"$atlas_root/build/example/examples/texture_atlas" "$folder/dino.off" -o "$folder/dino.obj" >&2
"$atlas_root/build/benchmark/benchmark/packing_benchmark" --pictures "$folder/packer" "$folder/dino.obj"
for packer in rectangles horizon fast best; do
  pngtopnm "$folder/packer_$packer.png" >"$folder/packer_$packer.ppm"
done
pnmcat -white -lr "$folder"/packer_{rectangles,horizon,fast,best}.ppm | pnmtopng >"$folder/packers.png"
small "$folder/packers.png" packers.png 1400
ls -l "$atlas_root/doc/pictures" >&2
