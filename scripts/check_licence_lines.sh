#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fails and names the files that lack their licence line. Data, texts and pictures carry none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

missing=$(find . \( -path ./.git -o -path './build*' -o -path ./atlas_output \) -prune -o -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.cmake' -o -name '*.in' -o -name '*.sh' -o -name '*.py' \
     -o -name CMakeLists.txt -o -path './.ci/*' \) \
  -exec awk 'FNR <= 3 && /SPDX-License-Identifier: MIT/ { found = 1; exit } END { if (!found) print FILENAME }' {} \;)
if [ -n "$missing" ]; then
  printf 'no licence line in:\n%s\n' "$missing" >&2
  exit 1
fi
