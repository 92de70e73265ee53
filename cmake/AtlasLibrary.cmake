# SPDX-License-Identifier: MIT
# atlas_add_library(NAME ROOMS...): the library NAME of all *_impl.h of the rooms, one source for each; the same as
# NAME_header_only; and NAME_headers, what both have in common.
include_guard(GLOBAL)
option(ATLAS_UNITY_BUILD "Compile sources of the library eight at a time: all of them sooner, one of them later" OFF)
set(ATLAS_SOURCE_DIR ${CMAKE_CURRENT_LIST_DIR}/..)
function(atlas_add_library name)
  set(sources)
  foreach(room IN LISTS ARGN)
    file(GLOB_RECURSE headers RELATIVE ${ATLAS_SOURCE_DIR}/include CONFIGURE_DEPENDS
         ${ATLAS_SOURCE_DIR}/include/Atlas/${room}/internal/*_impl.h)
    foreach(header IN LISTS headers)
      string(REGEX REPLACE "[/.]" "_" source ${header})
      set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_sources/${source}.cpp)
      file(CONFIGURE OUTPUT ${source} CONTENT "#include <@header@>\n" @ONLY)
      list(APPEND sources ${source})
    endforeach()
  endforeach()
  add_library(${name} ${sources})
  add_library(${name}_headers INTERFACE)
  add_library(${name}_header_only INTERFACE)
  target_compile_definitions(${name}_header_only INTERFACE ATLAS_HEADER_ONLY)
  target_link_libraries(${name}_header_only INTERFACE ${name}_headers)
  # Headers that are all included together when there is no library can be compiled together as well.
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD ${ATLAS_UNITY_BUILD}
                                           UNITY_BUILD_BATCH_SIZE 8)
  target_compile_options(${name} PRIVATE ${ATLAS_WARNINGS})
  foreach(target IN ITEMS ${name} ${name}_headers ${name}_header_only)
    add_library(Atlas::${target} ALIAS ${target})
  endforeach()
endfunction()
