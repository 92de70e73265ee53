#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the package for browsers and Node.js in build/wasm/package, installing on Debian what that needs. Open atlas.html there, or
# hand the folder to npm.
#
#   scripts/build_wasm.sh [CMAKE OPTIONS...]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${ATLAS_WASM_PACKAGES[@]}"
install_node
say "Building the package in build/wasm"
emcmake cmake -S "$atlas_root/bindings/wasm" -B "$atlas_root/build/wasm" -G Ninja "$@" >&2 || die "CMake failed"
cmake --build "$atlas_root/build/wasm" >&2 || die "the build failed"
ls -l "$atlas_root/build/wasm/package"
