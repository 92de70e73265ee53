# SPDX-License-Identifier: MIT
"""Conan 2: conan create packaging/conan --build=missing."""

import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy

required_conan_version = ">=2.0"


class AtlasConan(ConanFile):
    name = "atlas-uv"
    version = "0.2.0"
    description = "Texture atlases of polygon meshes by least squares conformal maps, proved free of flips and overlaps"
    license = "MIT"
    topics = ("texture-atlas", "uv-unwrapping", "mesh", "parameterization")
    settings = "os", "arch", "compiler", "build_type"
    package_type = "static-library"
    options = {"io": [True, False], "occlusion": [True, False]}  # occlusion: by a part of CGAL that is under the GPL
    default_options = {"io": True, "occlusion": False}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "bindings/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("cgal/[>=5.5 <7]", transitive_headers=True)
        self.requires("eigen/[>=3.3 <4]", transitive_headers=True)
        self.requires("onetbb/[>=2021]")
        if self.options.io:
            self.requires("nlohmann_json/[>=3.11]", transitive_headers=True)
            self.requires("libpng/[>=1.6]")
            self.requires("tinygltf/[>=2.8]")
            self.requires("draco/[>=1.5]")
            self.requires("meshoptimizer/[>=0.18]")

    def validate(self):
        if self.options.occlusion and not self.options.io:
            from conan.errors import ConanInvalidConfiguration

            raise ConanInvalidConfiguration("the component Occlusion needs IO")

    def generate(self):
        components = [name for name, wanted in (("IO", self.options.io), ("Occlusion", self.options.occlusion)) if wanted]
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["ATLAS_BUILD_EXAMPLES"] = False
        toolchain.cache_variables["ATLAS_BUILD_TESTS"] = False
        toolchain.cache_variables["ATLAS_COMPONENTS"] = ";".join(components)
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # What the project installs for CMake says more than Conan would: components, and what they need.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "Atlas")]
