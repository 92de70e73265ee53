#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# segmentation_steps_cli_test.sh PROGRAM: the pictures are written, and a ribbon that winds over itself is split.
set -euo pipefail
program=$1
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

awk 'BEGIN {
  m = 60; print "OFF"; print 2 * (m + 1), m, 0
  for (i = 0; i <= m; ++i)
    for (r = 2; r <= 3; ++r) { a = 8 * i / m; print r * cos(a), 0.3 * a, -r * sin(a) }
  for (i = 0; i < m; ++i) print 4, 2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2 }' >"$folder/ribbon.off"

"$program" "$folder/ribbon.off" -o "$folder/all" --size 64 --ball 0 0 0 100 >"$folder/said"
grep -q '^one chart: .*overlap' "$folder/said"
[ "$(grep -c '^after the split: the chart is valid$' "$folder/said")" = 2 ]
"$program" "$folder/ribbon.off" -o "$folder/part" --size 64 --up z --ball 0 2 0 1.9 >"$folder/said"
grep -q '^one chart: the chart is valid$' "$folder/said"
"$program" "$folder/ribbon.off" -o "$folder/steps" --size 64 >"$folder/said"
grep -q 'charts grown' "$folder/said"
for name in all_{one_chart,overlap,parts,split} steps_{features,distance,seeds,charts}; do
  [ "$(head -c 4 "$folder/$name.png" | tail -c 3)" = PNG ]
done
if "$program" "$folder/missing.off" -o "$folder/x" 2>"$folder/said"; then
  exit 1
fi
grep -q missing.off "$folder/said"
