#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# paper_results_cli_test.sh PROGRAM: tables and figures are written, a mesh that is missing is named.
set -euo pipefail
program=$1
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

# A dome of quads on a square.
awk 'BEGIN {
  n = 12; print "OFF"; print (n + 1) * (n + 1), n * n, 0
  for (i = 0; i <= n; ++i)
    for (j = 0; j <= n; ++j) { x = i / n; y = j / n; print x, y, 4 * x * (1 - x) * y * (1 - y) }
  for (i = 0; i < n; ++i)
    for (j = 0; j < n; ++j) { k = i * (n + 1) + j; print 4, k, k + n + 1, k + n + 2, k + 1 } }' >"$folder/dome.off"

"$program" -o "$folder/out" --size 64 table_2 "bunny=$folder/dome.off@z" 2>"$folder/said"
grep -q '^letter: ' "$folder/said"
for column in paper letter 'letter, without the rule on areas' 'Atlas, default'; do
  grep -q "<td>$column</td>" "$folder/out/table_2.html"
done
grep -q '<td>0.43</td>' "$folder/out/table_2.html" # the printed packing ratio of the bunny
"$program" -o "$folder/out" table_1 "$folder/dome.off" --ball 0.5 0.5 0.2 0.6
# After the optimisation with a free border no map has more stretch than before.
sed -n 's/<tr><td>LSCM<.td><td>\([0-9.]*\)<.td><td>[0-9.]*<.td><td>\([0-9.]*\)<.*/\1 \2/p' "$folder/out/table_1.html" |
  awk '{ exit !($2 <= $1 && $2 >= 1) } END { exit NR != 1 }'
"$program" -o "$folder/out" --size 64 figure_1 "$folder/dome.off"
for name in figure_7_bunny_{horizon,page} figure_8_bunny_model figure_10_bunny figure_1_{model,back,plane}; do
  [ "$(head -c 4 "$folder/out/$name.png" | tail -c 3)" = PNG ]
done
if "$program" -o "$folder/out" table_2 "bunny=$folder/missing.off" 2>"$folder/said"; then
  exit 1
fi
grep -q missing.off "$folder/said"
