#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the manual in build/doc/html, installing Doxygen on Debian if it is missing. Warnings are errors.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages doxygen
cd "$atlas_root"
mkdir -p build
say "Building the manual"
doxygen doc/Doxyfile
say "The manual is in build/doc/html/index.html"
