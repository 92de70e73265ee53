#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the example program texture_atlas and runs it, installing on Debian what it needs.
#
#   scripts/make_atlas.sh [MESH] [OPTIONS OF texture_atlas...]
#
# Without MESH the mesh is bunny00.off of Debian's package libcgal-demo; then, or without -o, the results go to
# ./atlas_output/.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

# demo_mesh FILE: extracts a mesh of the package libcgal-demo to ./atlas_output and prints its path.
demo_mesh() {
  local archive=/usr/share/doc/libcgal-dev/data.tar.gz
  mkdir -p atlas_output
  if [ ! -e "atlas_output/$1" ]; then
    install_packages libcgal-demo
    # Slim container images are told not to install documentation, which is where the meshes are.
    [ -r "$archive" ] || archive=$(unpack_documentation libcgal-demo "$archive")
    tar --extract --gzip --to-stdout --file "$archive" "data/meshes/$1" >"atlas_output/$1.part"
    mv "atlas_output/$1.part" "atlas_output/$1"
  fi
  printf '%s\n' "atlas_output/$1"
}

# unpack_documentation PACKAGE FILE: downloads the package and prints the path of a copy of its FILE.
unpack_documentation() {
  local folder=$atlas_root/build/$1
  mkdir -p "$folder"
  (cd "$folder" && apt-get -qq download "$1" >&2 && dpkg-deb --extract "$1"_*.deb .)
  printf '%s\n' "$folder$2"
}

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
    results=(-o "atlas_output/${name%.*}_atlas.obj")
    ;;
esac
say "texture_atlas $mesh ${results[*]} $*"
exec "$atlas_root/build/example/bin/texture_atlas" "$mesh" "${results[@]}" "$@"
