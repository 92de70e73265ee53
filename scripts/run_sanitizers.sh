#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the library with clang under the address and undefined behaviour sanitizers, runs the tests that
# test/CMakeLists.txt names for it, then the fuzz targets side by side, each from its kept corpus.
#
#   scripts/run_sanitizers.sh
#
# By default the fuzz targets make a fixed number of inputs from a fixed seed: the same commit meets the same inputs on every
# machine, fast or slow, so that what has passed here passes there. To look for what is not known yet, give
# ATLAS_FUZZ_SECONDS, the time for each target, and ATLAS_FUZZ_SEED, by default another one each time.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${ATLAS_LIBRARY_PACKAGES[@]}" "${ATLAS_TEST_PACKAGES[@]}"
install_clang
cd "$atlas_root"

# An input that takes a minute, or 2 GB, is a fault as well.
fuzz_options=(-timeout=60 -rss_limit_mb=2048 -print_final_stats=1)
if [ -n "${ATLAS_FUZZ_SECONDS:-}" ]; then
  fuzz_options+=(-max_total_time="$ATLAS_FUZZ_SECONDS" -seed="${ATLAS_FUZZ_SEED:-$((RANDOM + 1))}")
  reader_runs=() atlas_runs=()
else
  fuzz_options+=(-seed=1)
  reader_runs=(-runs=200000) atlas_runs=(-runs=400)
fi

# fuzz TARGET OPTIONS...: new inputs join a copy of the corpus in the build folder, those that break a promise the
# folder `broken` beside it.
fuzz() {
  local target=$1 folder=$atlas_root/build/sanitize/fuzz/$1
  shift
  mkdir -p "$folder/corpus" "$folder/broken"
  cp test/fuzz/corpus/"$target"/* "$folder/corpus"
  "build/sanitize/test/fuzz/$target" "${fuzz_options[@]}" "$@" -artifact_prefix="$folder/broken/" \
    "$folder/corpus" >"$folder/log" 2>&1
}

# end_of_fuzz TARGET STATUS: what it has done, or what has happened.
end_of_fuzz() {
  local log=$atlas_root/build/sanitize/fuzz/$1/log
  if [ "$2" -eq 0 ]; then
    say "$1: $(awk '/^Done/ { runs = $2 } /cov:/ { for (i = 1; i < NF; ++i) if ($i == "cov:") edges = $(i + 1) }
                  END { print runs " runs, " edges " edges of the code reached" }' "$log")"
  else
    tail -n 60 "$log" >&2
    say "$1 has found an input that breaks a promise: see above, and build/sanitize/fuzz/$1/broken"
    failed=1
  fi
}

# Tests of these names are about time or about numbers, and would take minutes here; of the whole pipeline, those on meshes
# of CGAL are enough.
long_tests='^Overlaps\.(AMillion|Needles)|MapsClosedOpenAndPolygonMeshes|KeepsSeamsAway|^GenerateAtlasOnSurface|^GivenParameterizer'

build sanitize sanitized_tests
build sanitize fuzzers
say "Running the tests under the address and undefined behaviour sanitizers"
LSAN_OPTIONS=suppressions=$atlas_root/test/leak_suppressions.txt:print_suppressions=0 \
  ctest --test-dir build/sanitize --label-regex '^sanitized$' --exclude-regex "$long_tests" --output-on-failure \
  --no-tests=error --progress --parallel "$(nproc)" --timeout 300

say "Fuzzing${ATLAS_FUZZ_SECONDS:+ for $ATLAS_FUZZ_SECONDS s}"
fuzz fuzz_read_polygon_soup "${reader_runs[@]}" -max_len=2048 &
readers=$!
# The entropic schedule of libFuzzer takes longer than an atlas of a few faces.
fuzz fuzz_generate_atlas "${atlas_runs[@]}" -max_len=128 -entropic=0 &
atlases=$!
failed=0
wait "$readers" && status=0 || status=$?
end_of_fuzz fuzz_read_polygon_soup "$status"
wait "$atlases" && status=0 || status=$?
end_of_fuzz fuzz_generate_atlas "$status"
exit "$failed"
