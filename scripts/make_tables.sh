#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Prints the tables of doc/performance.md and doc/quality.md: whole runs on meshes of different kinds, on one thread. The machine should be quiet.
#
#   scripts/make_tables.sh [--repeat N] [--only NAME] [-- OPTIONS OF texture_atlas...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${ATLAS_EXAMPLE_PACKAGES[@]}" python3
archive=$(demo_archive)
build example texture_atlas
exec python3 "$atlas_root/benchmark/kinds.py" --program "$atlas_root/build/example/bin/texture_atlas" --archive "$archive" "$@"
