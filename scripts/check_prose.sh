#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks the prose of the manual and the README: spelling, and that sentences are short (median of at most 18 words a page).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

most_words=18
install_packages aspell aspell-en
cd "$atlas_root"
pages=(README.md CHANGES.md CONTRIBUTING.md doc/*.md doc/concepts/*.md)

# prose FILE: its sentences without code, commands of Doxygen, names of C++, links and numbers of papers.
prose() {
  awk '/^```/ { in_code = !in_code; next } in_code || /^    / || /^\\/ || /^\|[- :|]*\|$/ { next } { print }' "$1" |
    sed -E 's/`[^`]*`/ /g; s/\{#[a-z_]+\}//g; s/\\(ref|subpage|anchor|image|snippet|include) *[A-Za-z_0-9.\/]+//g; s/\]\([^)]*\)/]/g; s/[A-Za-z]+::[A-Za-z_0-9:]+(\(\))?/it/g; s/[A-Za-z0-9]+_[A-Za-z_0-9]+(\(\))?/it/g; s/^#+ .*$/&./; s/<[^>]*>//g; s/https?:[^ )]*//g'
}

# median FILE: of the numbers of words of its sentences. Tables are not made of sentences.
median() {
  prose "$1" | grep -v '^|' | tr '\n' ' ' | sed -E 's/([.!?:;])[)"]* +/\1\n/g; s/ - /\n/g' |
    awk 'NF > 1 { print NF }' | sort -n | awk '{ words[NR] = $1 } END { print NR ? words[int((NR + 1) / 2)] : 0 }'
}

faults=0
for page in "${pages[@]}"; do
  words=$(median "$page")
  if [ "$words" -gt "$most_words" ]; then
    echo "$page: half of its sentences have $words words or more; at most $most_words is what readers like" >&2
    faults=1
  fi
  unknown=$(prose "$page" | aspell --lang=en_GB --encoding=utf-8 --ignore=2 --personal="$atlas_root/doc/words.pws" list | sort -u | tr '\n' ' ')
  if [ -n "$unknown" ]; then
    echo "$page: misspelled, or missing in doc/words.pws: $unknown" >&2
    faults=1
  fi
done
[ "$faults" -eq 0 ] || die "the prose of the manual needs work"
say "The prose is spelled right, and sentences are short"
