# SPDX-License-Identifier: MIT
# An overlay port: vcpkg install atlas-uv --overlay-ports=packaging/vcpkg/ports. It builds the source that it lies in.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)

set(components)
if("io" IN_LIST FEATURES)
  list(APPEND components IO)
endif()
if("occlusion" IN_LIST FEATURES)
  list(APPEND components Occlusion)
endif()
if("c" IN_LIST FEATURES)
  list(APPEND components C)
endif()
string(REPLACE ";" "\\;" components "${components}") # one option, not several

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DATLAS_BUILD_EXAMPLES=OFF
    -DATLAS_BUILD_TESTS=OFF
    "-DATLAS_COMPONENTS=${components}"
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME Atlas CONFIG_PATH lib/cmake/Atlas)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
