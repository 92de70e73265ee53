#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# No file of the library or the examples is longer than 400 lines, no function longer than 50, unless a comment before it
# gives the reason: `// long: ...`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mapfile -t files < <(find include examples -name '*.h' -o -name '*.cpp' | LC_ALL=C sort)
[ ${#files[@]} -gt 0 ] || { echo "no files" >&2; exit 1; }
too_long=$(wc -l "${files[@]}" | awk '$2 != "total" && $1 > 400 { print $2 ": " $1 " lines" }')

# file, first line, last line and name of each function
functions=$(ctags -x --language-force=C++ --kinds-C++=f --fields=+ne --_xformat='%F %n %e %N' "${files[@]}")
[ "$(wc -l <<<"$functions")" -gt 500 ] || { echo "ctags finds no functions" >&2; exit 1; }
while read -r file first last name; do
  before=$((first > 12 ? first - 12 : 1))
  # The comment belongs to the function if no other one ends in between.
  if ! sed -n "$before,${first}p" "$file" | awk '/^ *}/ { reason = 0 } /\/\/+ long: / { reason = 1 } END { exit !reason }'; then
    too_long+="${too_long:+$'\n'}$file:$first: $name() has $((last - first + 1)) lines"
  fi
done < <(awk '$3 - $2 + 1 > 50' <<<"$functions")

[ -z "$too_long" ] && exit 0
printf 'too long:\n%s\n' "$too_long" >&2
exit 1
