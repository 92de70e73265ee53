# SPDX-License-Identifier: MIT
"""pip install --no-build-isolation ./python; a wheel: pip wheel --no-build-isolation --no-deps -w wheels ./python"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = Path(__file__).resolve().parent.parent
version = next(
    line.split('"')[1] for line in (root / "include/Atlas/version.h").read_text().splitlines() if 'ATLAS_VERSION "' in line
)


class CMakeBuild(build_ext):
    """The compiled part is built by CMake, of the core and the component IO: all of it is under licences like MIT's."""

    def build_extension(self, ext: Extension) -> None:
        file = Path(self.get_ext_fullpath(ext.name)).resolve()
        file.parent.mkdir(parents=True, exist_ok=True)
        if "ATLAS_UV_NATIVE" in os.environ:  # it has been built: package it
            shutil.copy(os.environ["ATLAS_UV_NATIVE"], file)
            return
        build = Path(self.build_temp).resolve() / "cmake"
        build.mkdir(parents=True, exist_ok=True)
        options = [
            "-DCMAKE_BUILD_TYPE=Release", "-DATLAS_BUILD_PYTHON=ON", "-DATLAS_BUILD_EXAMPLES=OFF", "-DATLAS_BUILD_TESTS=OFF",
            "-DATLAS_COMPONENTS=IO", "-DATLAS_UNITY_BUILD=ON", f"-DPython3_EXECUTABLE={sys.executable}",
            *os.environ.get("CMAKE_ARGS", "").split(),
        ]
        jobs = str(self.parallel or os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or os.cpu_count() or 1)
        subprocess.run(["cmake", "-S", root, "-B", build, *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "atlas_uv_native", "--parallel", jobs], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", file.parent], check=True)


setup(
    name="atlas-uv",
    version=version,
    description="Texture atlases of polygon meshes, proved free of flips and overlaps",
    license="MIT",
    python_requires=">=3.8",
    install_requires=["numpy"],
    packages=["atlas_uv"],
    package_data={"atlas_uv": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("atlas_uv._native", [])],
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
)
