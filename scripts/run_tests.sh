#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds everything and runs all tests, installing on Debian what they need. Ends with the summary of ctest.
#
#   scripts/run_tests.sh [CMAKE OPTIONS...]
#
# -DATLAS_BUILD_WASM=ON and -DATLAS_TEST_BROWSER=ON install emscripten and Chromium too.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${ATLAS_EXAMPLE_PACKAGES[@]}" "${ATLAS_TEST_PACKAGES[@]}"
case " $* " in *" -DATLAS_BUILD_WASM=ON "*) install_packages "${ATLAS_WASM_PACKAGES[@]}" ;; esac
case " $* " in *" -DATLAS_TEST_BROWSER=ON "*) install_packages "${ATLAS_BROWSER_PACKAGES[@]}" ;; esac
case " $* " in *" -DATLAS_BUILD_WASM=ON "* | *" -DATLAS_TEST_BROWSER=ON "*) install_node ;; esac
python=(-DATLAS_BUILD_PYTHON=ON)
if command -v dpkg-query >/dev/null; then
  python+=(-DPython3_EXECUTABLE=/usr/bin/python3) # whose packages these are
fi
build test all "${python[@]}" "$@"
say "Built after $((SECONDS / 60)) min $((SECONDS % 60)) s; running the tests"
exec ctest --test-dir "$atlas_root/build/test" --output-on-failure --no-tests=error \
  --parallel "$(nproc)" --timeout 300
