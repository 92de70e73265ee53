#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks that the files which the manual and the README name exist, and that the reference has every option of the programs, every named parameter and
# every status.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

cd "$atlas_root"
pages=(README.md CHANGES.md CONTRIBUTING.md doc/*.md doc/concepts/*.md)
reference=doc/reference.md
faults=0
fault() {
  echo "$*" >&2
  faults=1
}

# Files of the source tree; those in capitals stand for any name. Links of pages that are read outside of Doxygen.
for page in "${pages[@]}"; do
  for path in $(grep -oP '(?<![\w/])(\.ci|cmake|doc|examples|python|bindings|benchmark|scripts|test)/[A-Za-z0-9_./-]*[A-Za-z0-9_]' "$page" | sort -u); do
    [ -e "$path" ] || [[ $path =~ /[A-Z_]+(/|$) ]] || fault "$page: there is no $path"
  done
  for header in $(grep -oE '\b(core|IO|soup|image|bake|report|measure|planar|validation|segmentation|parameterization|packing|pipeline|Atlas)/[A-Za-z0-9_/]+\.h\b' "$page" | sort -u); do
    [ -e "include/Atlas/${header#Atlas/}" ] || [[ $header =~ /(internal/.*)?(X|Your_[a-z]+)\.h|ROOM ]] || fault "$page: there is no header $header"
  done
  for link in $(grep -oE '\]\([^)#:]+\)' "$page" | tr -d ']()' | sort -u); do
    [ -e "$(dirname "$page")/$link" ] || fault "$page: the link to $link is dead"
  done
done

# has NAME: whether a row of a table of the reference begins with it, or names it in its first column.
has() { grep -qE "^\|[^|]*\`$1[\` ]" "$reference"; }

for option in $(grep -ohE '"(-o,)?--[a-z-]+"' examples/programs/{texture_atlas,repack_atlas,verify_atlas,common}/*.cpp | tr -d '"' | sed -E 's/^(-o,)?--output$/-o/' | sort -u); do
  has "$option" || fault "$reference: the option $option is missing"
done
for name in $(sed -nE 's/^struct ([a-z_]+)_t$/\1/p' include/Atlas/core/internal/parameter_tags.h); do
  grep -qE "^\| \`$name\` \|" "$reference" || fault "$reference: the named parameter $name is missing"
done

# enumerators HEADER NAME: those of an enumeration.
enumerators() {
  awk -v name="$2" '$0 ~ "^enum class " name " ?" { inside = 1; next } inside && /^};/ { exit } inside' "include/Atlas/$1" | sed -E 's,//.*,,; s/=.*//' | grep -oE '[a-z_]+'
}
for enumeration in pipeline/Atlas_report.h:Atlas_status core/Chart.h:Chart_status pipeline/Atlas_report.h:Excess_reason \
                   pipeline/Atlas_report.h:Coverage_outcome core/Surface.h:Rejection; do
  names=$(enumerators "${enumeration%:*}" "${enumeration#*:}")
  [ -n "$names" ] || fault "there is no ${enumeration#*:} in ${enumeration%:*}"
  for name in $names; do
    [ "$name" = none ] || has "$name" || fault "$reference: ${enumeration#*:}::$name is missing"
  done
done

[ "$faults" -eq 0 ] || die "the manual and the source tree do not agree"
say "What the manual names is there, and what is there is named"
