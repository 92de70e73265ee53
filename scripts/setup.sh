# SPDX-License-Identifier: MIT
# Helpers of the other scripts, to be sourced: install what is missing, configure, build.

# What the library needs with the readers and writers, what the programs need besides, the Python
# module and its tests, all tests, the checks of the source.
ATLAS_LIBRARY_PACKAGES=(g++ cmake ninja-build ccache libcgal-dev libeigen3-dev libtbb-dev libosmesa6-dev libpng-dev
                        libtinygltf-dev nlohmann-json3-dev libdraco-dev libmeshoptimizer-dev)
ATLAS_EXAMPLE_PACKAGES=("${ATLAS_LIBRARY_PACKAGES[@]}" libcli11-dev)
ATLAS_PYTHON_PACKAGES=(pybind11-dev python3-dev python3-numpy python3-pytest python3-pip python3-setuptools
                       python3-wheel)
ATLAS_TEST_PACKAGES=(libgtest-dev libsuitesparse-dev libassimp-dev universal-ctags pkgconf valgrind "${ATLAS_PYTHON_PACKAGES[@]}")
# The package for browsers, and the browser that tests it.
ATLAS_WASM_PACKAGES=(emscripten cmake ninja-build libcgal-dev libeigen3-dev libtinygltf-dev nlohmann-json3-dev)
ATLAS_BROWSER_PACKAGES=(chromium)
ATLAS_CHECK_PACKAGES=(clang-format)

say() { printf '\n== %s\n' "$*" >&2; }
die() { printf 'error: %s\n' "$*" >&2; exit 1; }

# as_root COMMAND...: runs it as root, if need be through sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "root or sudo is needed to run: $*"
  fi
}

# apt_get ARGUMENTS...: apt-get that asks nothing, waits for other package managers and tries again.
apt_get() {
  local try
  for try in 1 2 3; do
    if as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3 \
        -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@" </dev/null >/dev/null; then
      return 0
    fi
    [ "$try" -eq 3 ] || sleep $((5 * try))
  done
  return 1
}

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# install_packages NAME...: installs the Debian packages of the list that are missing.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "Not a Debian system: make sure that the counterparts of these packages are installed: $*"
    return 0
  fi
  local package missing=()
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  say "Installing ${missing[*]}"
  apt_get update || die "the lists of Debian packages cannot be brought up to date"
  apt_get install --yes --no-install-recommends "${missing[@]}" || die "could not install ${missing[*]}"
}

# install_clang: clang, its sanitizers, and what names the lines in their reports.
install_clang() {
  install_packages clang llvm
  local version
  version=$(clang --version | sed -n 's/.*version \([0-9]*\).*/\1/p;q')
  install_packages "libclang-rt-$version-dev"
}

# install_node: Node.js and npm, where no others are there. Emscripten wants one of them, whoever made it.
install_node() {
  command -v node >/dev/null || install_packages nodejs
  command -v npm >/dev/null || install_packages npm
}

# demo_archive: the archive of meshes of the package libcgal-demo.
demo_archive() {
  local archive=/usr/share/doc/libcgal-dev/data.tar.gz
  install_packages libcgal-demo
  # Slim container images are told not to install documentation, which is where the meshes are.
  [ -r "$archive" ] || archive=$(unpack_documentation libcgal-demo "$archive")
  printf '%s\n' "$archive"
}

# demo_mesh FILE: extracts a mesh of that archive to ./atlas_output and prints its path.
demo_mesh() {
  local archive
  mkdir -p atlas_output
  if [ ! -e "atlas_output/$1" ]; then
    archive=$(demo_archive)
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

# build PRESET TARGET [CMAKE OPTIONS...]: configures and builds in build/PRESET, with ccache when it is there.
build() {
  local preset=$1 target=$2
  shift 2
  local options=()
  if command -v ccache >/dev/null; then
    export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros,include_file_mtime,include_file_ctime}
    options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  case $preset in # those that build tests, which have meshes to work on
    test | sanitize*) options+=("-DATLAS_DEMO_MESH_ARCHIVE=$(demo_archive)") ;;
  esac
  say "Configuring and building $target in build/$preset"
  (cd "$atlas_root" && cmake --preset "$preset" "${options[@]}" "$@" >&2) || die "CMake failed"
  cmake --build "$atlas_root/build/$preset" --target "$target" >&2 || die "the build failed"
}

atlas_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
