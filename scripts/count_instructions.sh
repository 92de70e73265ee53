#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Counts the instructions of generate_atlas() on five small meshes, on one thread, and compares them with those that are kept
# in test/speed/instructions.txt. Unlike seconds they do not depend on what else the machine does. Fails where one has grown
# by more than a tenth. valgrind counts them; it is installed if need be.
#
#   scripts/count_instructions.sh             builds the preset `test` and compares
#   scripts/count_instructions.sh --renew     writes the numbers anew: for a change that is worth what it costs, or that is faster
#   scripts/count_instructions.sh PROGRAM     compares this counted_call, and installs nothing
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
kept=$atlas_root/test/speed/instructions.txt
most_growth=10 # per cent: compilers and processors differ by one or two

program= renew=
for argument in "$@"; do
  case $argument in
    --renew) renew=yes ;;
    -*) die "unknown option $argument" ;;
    *) program=$argument ;;
  esac
done
if [ -z "$program" ]; then
  install_packages "${ATLAS_EXAMPLE_PACKAGES[@]}" "${ATLAS_TEST_PACKAGES[@]}"
  build test counted_call
  program=$atlas_root/build/test/test/speed/counted_call
fi
command -v valgrind >/dev/null || die "valgrind is missing"
[ -x "$program" ] || die "no program $program"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# count MESH: how many instructions the program takes for it.
count() {
  if ! valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file=/dev/null "$program" "$1" >"$folder/$1.log" 2>&1; then
    cat "$folder/$1.log" >&2
    return 1
  fi
  sed -n 's/^==.* I *refs: *//p' "$folder/$1.log" | tr -d , >"$folder/$1.count"
  [ -s "$folder/$1.count" ]
}

meshes=$("$program")
export -f count
export folder program
xargs -P "$(nproc)" -I {} bash -c 'count {}' <<<"$meshes" || die "a run has failed"

if [ -n "$renew" ]; then
  for mesh in $meshes; do
    printf '%s %s\n' "$mesh" "$(cat "$folder/$mesh.count")"
  done >"$kept"
  cat "$kept"
  exit
fi
grown=
for mesh in $meshes; do
  now=$(cat "$folder/$mesh.count")
  before=$(sed -n "s/^$mesh \([0-9]*\)$/\1/p" "$kept")
  [ -n "$before" ] || die "$kept has no number for $mesh: run scripts/count_instructions.sh --renew"
  change=$(((1000 * now / before) - 1000)) # tenths of a per cent
  printf '%-8s %6d million instructions, %6d kept: %+.1f %%\n' "$mesh" $((now / 1000000)) $((before / 1000000)) \
    "$(printf '%d' "$change")e-1"
  [ "$change" -le $((10 * most_growth)) ] || grown+=" $mesh"
  [ "$change" -ge $((-10 * most_growth)) ] ||
    echo "         faster than what is kept: scripts/count_instructions.sh --renew makes that the measure"
done
if [ -n "$grown" ]; then
  die "more instructions than before on:$grown. Find out why (valgrind --tool=callgrind).
If the change is worth that, run scripts/count_instructions.sh --renew and say so in the commit."
fi
