#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the tables and figures of Levy, Petitjean, Ray, Maillot, Least squares conformal maps for automatic
# texture atlas generation, 2002, on one HTML page: atlas_output/paper/index.html. Installs on Debian what it needs.
#
#   scripts/reproduce_paper.sh [NAME=MESH[@AXIS]...]
#
# NAME is dinosaur, skull, bunny or horse where the mesh is the paper's, so that its printed numbers stand beside
# those measured, and anything else otherwise. AXIS points up, if y does not. Without meshes, those of Debian's package libcgal-demo stand in for
# them. Table 1 and figure 6 need the head of an animal: it is the cow's of that package, as in figure 4.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

for mesh in "$@"; do
  file=${mesh#*=}
  [ -r "${file%@*}" ] || die "cannot read ${file%@*}: meshes are given as NAME=FILE or NAME=FILE@AXIS"
done
install_packages "${ATLAS_EXAMPLE_PACKAGES[@]}"
meshes=("$@")
if [ $# -eq 0 ]; then
  # The package has a small dinosaur, a head and a camel in place of the paper's; its bunny is that of the scan.
  for pair in dinosaur:dino:-x skull:mannequin-devil bunny:bunny00 horse:camel; do
    IFS=: read -r name file axis <<<"$pair"
    meshes+=("${name}_$file=$(demo_mesh "$file.off")@${axis:-y}")
  done
fi
cow=$(demo_mesh cow.off)
build example paper_results
build example segmentation_steps
bin=$atlas_root/build/example/bin
folder=atlas_output/paper
mkdir -p "$folder"

say "Figure 3 and table 1"
"$bin/paper_results" -o "$folder" figure_3
head_of_cow=(--ball 0.43 0.18 0 0.12) # from the muzzle to the horns
"$bin/paper_results" -o "$folder" table_1 "cow's head=$cow" "${head_of_cow[@]}"
say "Figure 1"
large=${meshes[${#meshes[@]} - 1]}
"$bin/paper_results" -o "$folder" figure_1 "$large"
say "Figures 4 to 6"
first=${meshes[0]}
first=${first#*=}
up=y
case $first in *@*) up=${first##*@} ;; esac
"$bin/segmentation_steps" "${first%@*}" --up="$up" -o "$folder/figure_4"
awk 'BEGIN {
  m = 200; n = 24; print "OFF"; print (m + 1) * (n + 1), m * n, 0
  for (i = 0; i <= m; ++i)
    for (j = 0; j <= n; ++j) { a = 1.3 * 6.2831853 * i / m; r = 1.2 + 0.8 * j / n; print r * cos(a), 0.28 * a, -r * sin(a) }
  for (i = 0; i < m; ++i)
    for (j = 0; j < n; ++j) { k = i * (n + 1) + j; print 4, k, k + 1, k + n + 2, k + n + 1 } }' >"$folder/ribbon.off"
"$bin/segmentation_steps" "$folder/ribbon.off" -o "$folder/figure_6" --azimuth 60 --elevation 30 --ball 0 0 0 100
say "Table 2 and figures 7 to 10"
"$bin/paper_results" -o "$folder" table_2 "${meshes[@]}"

# figure FILE...: the pictures side by side.
figure() {
  local file
  printf '<div class="row">'
  for file; do
    printf '<img alt="%s" src="data:image/png;base64,%s">' "$(basename "$file" .png)" "$(base64 -w0 "$file")"
  done
  printf '</div>\n'
}

# caption TEXT: what a figure shows.
caption() { printf '<p class="caption">%s</p>\n' "$*"; }

say "Writing $folder/index.html"
{
  cat <<'HTML'
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Least squares conformal maps, 2002, again</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; max-width: 76rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
table { border-collapse: collapse; margin: 1rem 0; } td, th { border: 1px solid #ccc; padding: 0.25rem 0.6rem; text-align: left; }
.row, .two { display: flex; gap: 0.5rem; } .row img { flex: 1 1 0; min-width: 0; object-fit: contain; } .two > div { flex: 1; }
.caption { color: #555; }
</style></head><body>
<h1>Least squares conformal maps for automatic texture atlas generation</h1>
<p>The tables and figures of L&eacute;vy, Petitjean, Ray and Maillot (2002), made again by Atlas.
"Letter" is the paper's pipeline (<code>texture_atlas --mode paper</code>); "Atlas, default" is what
<code>texture_atlas</code> does without options. The page <em>What the paper says, and what is so</em> of the manual
explains the differences.</p>
HTML
  echo '<h2>Table 1: stretch optimisation of one chart</h2>'
  cat "$folder/table_1.html"
  echo '<h2>Table 2: statistics and timings</h2>'
  caption 'Times of the column "paper" are those of a Pentium III at 1.3 GHz.'
  cat "$folder/table_2.html"
  echo '<h2>Figure 1: a large chart</h2>'
  cat "$folder/figure_1.html"
  figure "$folder"/figure_1_{model,back,plane}.png
  caption 'Iso-parameter curves (u blue, v red), cuts and border dark; right, the chart in the plane.'
  echo '<h2>Figure 3: independence of resolution</h2>'
  cat "$folder/figure_3.html"
  figure "$folder"/figure_3_{coarse,fine,graded_left,graded_right}.png
  echo '<h2>Figures 4 and 5: features, distance to seeds, distance to features, charts</h2>'
  figure "$folder"/figure_4_{features,seeds,distance,charts}.png
  echo '<h2>Figure 6: an overlap, and the split that ends it</h2>'
  figure "$folder"/figure_6_{one_chart,overlap,parts,split}.png
  for mesh in "${meshes[@]}"; do
    name=${mesh%%=*}
    printf '<h2>Figures 7 to 10: %s</h2>\n' "$name"
    figure "$folder/figure_7_${name}_horizon.png" "$folder/figure_7_${name}_page.png"
    caption 'Figure 7: a chart (green) on the horizon (blue); lost space is black. Right, the page.'
    figure "$folder/figure_8_${name}_model.png" "$folder/figure_10_$name.png"
    caption 'Figure 8: the charts on the model. Figure 10: the model with a pattern.'
    cat "$folder/figure_9_$name.html"
    caption 'Figure 9: histograms of angles and areas.'
  done
  echo '</body></html>'
} >"$folder/index.html"
printf '%s\n' "$folder/index.html"
