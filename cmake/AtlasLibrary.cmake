# SPDX-License-Identifier: MIT
# atlas_add_library(NAME FOLDERS...): the library NAME of all *_impl.h below the folders of include/Atlas, one source for
# each; the same as NAME_header_only, with nothing to link; and NAME_headers, what both have in common. NAME is Atlas or
# Atlas_<component>; others know a component as Atlas::<component>.
#
# A folder is a room, or a folder of a component in it: internal/rendering and internal/occlusion are left out of rooms.
include_guard(GLOBAL)
option(ATLAS_UNITY_BUILD "Compile sources of the library eight at a time: all of them sooner, one of them later" OFF)
set(ATLAS_SOURCE_DIR ${CMAKE_CURRENT_LIST_DIR}/..)
set(ATLAS_COMPONENT_FOLDERS "/internal/(rendering|occlusion)/")

function(atlas_sources name result)
  set(sources)
  foreach(folder IN LISTS ARGN)
    file(GLOB_RECURSE headers RELATIVE ${ATLAS_SOURCE_DIR}/include CONFIGURE_DEPENDS
         ${ATLAS_SOURCE_DIR}/include/Atlas/${folder}/*_impl.h)
    if(NOT "/${folder}/" MATCHES "${ATLAS_COMPONENT_FOLDERS}")
      list(FILTER headers EXCLUDE REGEX "${ATLAS_COMPONENT_FOLDERS}")
    endif()
    foreach(header IN LISTS headers)
      string(REGEX REPLACE "[/.]" "_" source ${header})
      set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_sources/${source}.cpp)
      file(CONFIGURE OUTPUT ${source} CONTENT "#include <@header@>\n" @ONLY)
      list(APPEND sources ${source})
    endforeach()
  endforeach()
  set(${result} ${sources} PARENT_SCOPE)
endfunction()

function(atlas_add_library name)
  atlas_sources(${name} sources ${ARGN})
  add_library(${name} ${sources})
  add_library(${name}_headers INTERFACE)
  add_library(${name}_header_only INTERFACE)
  target_link_libraries(${name} PUBLIC ${name}_headers)
  target_link_libraries(${name}_header_only INTERFACE ${name}_headers)
  target_compile_definitions(${name}_header_only INTERFACE ATLAS_HEADER_ONLY)
  # Headers that are all included together when there is no library can be compiled together as well.
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD ${ATLAS_UNITY_BUILD}
                                           UNITY_BUILD_BATCH_SIZE 8)
  target_compile_options(${name} PRIVATE ${ATLAS_WARNINGS})
  # CGAL's kernel takes two thirds of the time of a source.
  target_precompile_headers(${name} PRIVATE <Atlas/core/Kernel.h>)
  # Without optimisation the library is 17 times slower: in projects that choose no build type it is optimised
  # nevertheless.
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    target_compile_options(${name} PRIVATE -O2)
  endif()
  foreach(target IN ITEMS ${name} ${name}_headers ${name}_header_only)
    string(REGEX REPLACE "^Atlas_(.*[A-Z].*)$" "\\1" short ${target}) # a component's name has capitals
    add_library(Atlas::${short} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${short})
  endforeach()
endfunction()

# atlas_add_component(COMPONENT FOLDERS...): the library of a component, if it is in ATLAS_COMPONENTS and what it needs is
# found; a missing library is an error only for those who test or develop Atlas.
function(atlas_add_component component)
  if(NOT component IN_LIST ATLAS_COMPONENTS)
    return()
  endif()
  atlas_find_libraries(${component} missing)
  foreach(other IN LISTS ATLAS_${component}_COMPONENTS)
    if(NOT TARGET Atlas_${other})
      list(APPEND missing "the component ${other}")
    endif()
  endforeach()
  if(missing)
    list(JOIN missing ", " missing)
    if(ATLAS_BUILD_TESTS)
      message(FATAL_ERROR "the tests need the component ${component} of Atlas; not found: ${missing}")
    endif()
    message(STATUS "Atlas is built without its component ${component}; not found: ${missing}")
    return()
  endif()
  atlas_add_library(Atlas_${component} ${ARGN})
  target_link_libraries(Atlas_${component}_headers INTERFACE Atlas_headers)
  target_link_libraries(Atlas_${component} PUBLIC Atlas PRIVATE ${ATLAS_${component}_LIBRARIES})
  target_link_libraries(Atlas_${component}_header_only INTERFACE Atlas_header_only ${ATLAS_${component}_LIBRARIES})
  foreach(other IN LISTS ATLAS_${component}_COMPONENTS)
    target_link_libraries(Atlas_${component} PUBLIC Atlas_${other})
    target_link_libraries(Atlas_${component}_header_only INTERFACE Atlas_${other}_header_only)
  endforeach()
  atlas_install(Atlas_${component})
endfunction()

# atlas_install(NAME): installs the targets of atlas_add_library() as NAMETargets.cmake, without the underscore.
function(atlas_install name)
  string(REPLACE "_" "" set ${name}Targets)
  install(TARGETS ${name} ${name}_headers ${name}_header_only EXPORT ${set}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT ${set} NAMESPACE Atlas:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Atlas)
endfunction()
