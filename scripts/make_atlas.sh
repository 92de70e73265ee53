#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the example program texture_atlas and runs it, installing on Debian what it needs.
#
#   scripts/make_atlas.sh [MESH] [OPTIONS OF texture_atlas...]
#
# Without MESH the mesh is bunny00.off of Debian's package libcgal-demo. Without -o the results go to ./atlas_output/,
# with pictures.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

mesh=
if [ $# -gt 0 ] && [ "${1#-}" = "$1" ]; then
  mesh=$1
  shift
  [ -r "$mesh" ] || die "cannot read $mesh"
fi

install_packages "${ATLAS_EXAMPLE_PACKAGES[@]}"
[ -n "$mesh" ] || mesh=$(demo_mesh bunny00.off)
build example texture_atlas

results=()
case " $* " in
  *" -o "* | *" --help "* | *" -h "*) ;;
  *)
    name=$(basename "$mesh")
    mkdir -p atlas_output
    results=(-o "atlas_output/${name%.*}_atlas.obj" --pictures)
    ;;
esac
say "texture_atlas $mesh ${results[*]} $*"
exec "$atlas_root/build/example/bin/texture_atlas" "$mesh" "${results[@]}" "$@"
