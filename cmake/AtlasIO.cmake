# SPDX-License-Identifier: MIT
# The libraries behind the optional headers of include/Atlas/IO, as one target: Atlas::IO, or Atlas_IO.
include_guard(GLOBAL)
find_package(OSMesa REQUIRED)
find_package(PNG REQUIRED)
find_package(TinyGLTF REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
add_library(Atlas_IO INTERFACE)
add_library(Atlas::IO ALIAS Atlas_IO)
target_link_libraries(Atlas_IO INTERFACE Atlas::Atlas OSMesa::OSMesa PNG::PNG TinyGLTF::TinyGLTF
                                         nlohmann_json::nlohmann_json)
