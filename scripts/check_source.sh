#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks of the source text that need no build: formatting, and the licence line of every file.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${ATLAS_CHECK_PACKAGES[@]}"
cd "$atlas_root"

say "Checking the formatting"
find . \( -path ./.git -o -path './build*' \) -prune -o \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format --dry-run --Werror

say "Checking the licence lines"
"$atlas_root/scripts/check_licence_lines.sh"
