#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the whole pipeline and the merging tests under the thread sanitizer and runs them: see
# test/thread_sanitizer/README.md.
#
#   scripts/run_thread_sanitizer.sh [MESH...]
#
# Without MESH the meshes are two of Debian's package libcgal-demo.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${ATLAS_LIBRARY_PACKAGES[@]}" "${ATLAS_TEST_PACKAGES[@]}"
build sanitize-threads thread_sanitizer_pipeline
build sanitize-threads merge_charts_test
[ $# -gt 0 ] || set -- "$(demo_mesh cow.off)" "$(demo_mesh fandisk.off)"
export TSAN_OPTIONS="halt_on_error=1 ${TSAN_OPTIONS:-}"
say "thread_sanitizer_pipeline $*"
"$atlas_root/build/sanitize-threads/test/thread_sanitizer/thread_sanitizer_pipeline" "$@"
say "merge_charts_test"
"$atlas_root/build/sanitize-threads/test/segmentation/merge_charts_test"
