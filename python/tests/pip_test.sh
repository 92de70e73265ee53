#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes wheels of both packages, of a compiled part that has been built, installs them, and runs them from there.
#
#   pip_test.sh PYTHON NATIVE FOLDER
set -euo pipefail
python=$1 native=$2 folder=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
rm -rf "$folder" && mkdir -p "$folder"
cp -r "$here" "$folder/source" # setuptools leaves files beside the sources
mkdir -p "$folder/include" && cp -r "$here/../include/Atlas" "$folder/include/"
pip() { "$python" -m pip --disable-pip-version-check --no-cache-dir "$@"; }
for source in "$folder/source" "$folder/source/xatlas"; do
  ATLAS_UV_NATIVE=$native pip wheel --quiet --no-index --no-build-isolation --no-deps -w "$folder/wheels" "$source"
done
pip install --quiet --no-index --no-deps --target "$folder/installed" "$folder"/wheels/*.whl
cd "$folder/installed"
"$python" - <<'END'
import atlas_uv, xatlas
from pathlib import Path
assert Path(atlas_uv.__file__).parent.parent == Path.cwd() == Path(xatlas.__file__).parent.parent
assert Path("atlas_uv/py.typed").exists() and Path("atlas_uv/_native.pyi").exists()
triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
for module in atlas_uv, xatlas:
    vmapping, indices, uvs = module.parametrize(*triangle)
    assert vmapping.tolist() == [0, 1, 2] and indices.tolist() == [[0, 1, 2]] and uvs.max() <= 1
print("installed:", atlas_uv.__version__)
END
