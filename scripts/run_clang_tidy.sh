#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs clang-tidy with the rules of .clang-tidy on all headers at once, installing it on Debian if it is missing.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages clang-tidy "${ATLAS_EXAMPLE_PACKAGES[@]}" "${ATLAS_TEST_PACKAGES[@]}"
cd "$atlas_root"
source_file=$(mktemp --suffix=.cpp)
trap 'rm "$source_file"' EXIT
(cd include && find Atlas -name '*.h' | LC_ALL=C sort | sed 's/.*/#include <&>/') >"$source_file"
clang-tidy --quiet --config-file=.clang-tidy --header-filter=include/Atlas/ "$source_file" -- -std=c++20 \
  -Iinclude -isystem /usr/include/eigen3 -isystem /usr/include/suitesparse -DCGAL_LINKED_WITH_TBB -DATLAS_HEADER_ONLY
