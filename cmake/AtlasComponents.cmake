# SPDX-License-Identifier: MIT
# The optional libraries and what each of them needs. Read by the project itself and by find_package(Atlas).
#
#   IO         mesh and picture files, pictures of pages, baking, reports: libpng, tinygltf, nlohmann-json; where they
#              are there, draco and meshoptimizer, which decode compressed glTF files
#   Rendering  pictures of the model, and the stencil test: OSMesa
#   Occlusion  ambient occlusion: CGAL's AABB tree, which is under the GPL
#   C          the C interface of Atlas/atlas.h, a shared library that has all of IO inside
include_guard(GLOBAL)
set(ATLAS_MODULE_DIR ${CMAKE_CURRENT_LIST_DIR})
set(ATLAS_ALL_COMPONENTS IO Rendering Occlusion C)
set(ATLAS_IO_LIBRARIES PNG::PNG TinyGLTF::TinyGLTF nlohmann_json::nlohmann_json)
set(ATLAS_IO_CODECS draco::draco meshoptimizer::meshoptimizer)
set(ATLAS_Rendering_LIBRARIES OSMesa::OSMesa)
set(ATLAS_Occlusion_LIBRARIES)
set(ATLAS_C_LIBRARIES)
# Components that stand on others.
set(ATLAS_Occlusion_COMPONENTS IO)

# atlas_find_libraries(COMPONENT RESULT): looks for what a component needs, and sets RESULT to what has not been found.
macro(atlas_find_libraries component result)
  if("${component}" STREQUAL "IO")
    find_package(PNG QUIET)
    find_package(TinyGLTF QUIET CONFIG)
    find_package(nlohmann_json QUIET CONFIG)
    find_package(draco QUIET CONFIG)
    find_package(meshoptimizer QUIET CONFIG)
  elseif("${component}" STREQUAL "Rendering")
    list(APPEND CMAKE_MODULE_PATH ${ATLAS_MODULE_DIR}) # FindOSMesa.cmake
    find_package(OSMesa QUIET)
  endif()
  set(${result})
  foreach(atlas_library IN LISTS ATLAS_${component}_LIBRARIES)
    if(NOT TARGET ${atlas_library})
      list(APPEND ${result} ${atlas_library})
    endif()
  endforeach()
endmacro()
