# SPDX-License-Identifier: MIT
# Tests of the package as a whole: its headers one by one, its licence border, its use from outside.

include(${PROJECT_SOURCE_DIR}/cmake/AtlasIO.cmake)

set(atlas_include ${PROJECT_SOURCE_DIR}/include)
file(GLOB_RECURSE atlas_headers RELATIVE ${atlas_include} CONFIGURE_DEPENDS ${atlas_include}/Atlas/*.h)

# Headers that stand on more than CGAL's LGPL parts, Boost and Eigen; each says so.
set(atlas_gpl_headers ${atlas_headers})
list(FILTER atlas_gpl_headers INCLUDE REGEX "parameterization/(CGAL_parameterizer|Cholmod_)|bake_ambient_occlusion")
set(atlas_optional_headers ${atlas_headers})
list(FILTER atlas_optional_headers INCLUDE REGEX "^Atlas/IO/|Stencil_validator|OSMesa")
list(APPEND atlas_optional_headers ${atlas_gpl_headers})
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)

# atlas_header_checks(NAME SOURCES...): sources that only need to compile.
function(atlas_header_checks name)
  add_library(${name} OBJECT ${ARGN})
  target_link_libraries(${name} PRIVATE Atlas::IO)
  target_compile_options(${name} PRIVATE ${ATLAS_WARNINGS} -O0 -g0)
  target_include_directories(${name} SYSTEM PRIVATE ${CHOLMOD_INCLUDE_DIR})
endfunction()

# Sets RESULT to whether the header includes Atlas/core/Kernel.h, directly or through others.
function(atlas_reaches_kernel header result)
  get_property(is_known GLOBAL PROPERTY atlas_reaches_kernel_${header} SET)
  if(is_known)
    get_property(reaches GLOBAL PROPERTY atlas_reaches_kernel_${header})
  else()
    set(reaches FALSE)
    # For the time being: a header and the definitions behind it include each other.
    set_property(GLOBAL PROPERTY atlas_reaches_kernel_${header} FALSE)
    file(STRINGS ${atlas_include}/${header} lines REGEX "^#include <Atlas/")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include <(.*)>.*" "\\1" included ${line})
      if(NOT reaches AND included STREQUAL "Atlas/core/Kernel.h")
        set(reaches TRUE)
      elseif(NOT reaches AND EXISTS ${atlas_include}/${included})
        atlas_reaches_kernel(${included} reaches)
      endif()
    endforeach()
    set_property(GLOBAL PROPERTY atlas_reaches_kernel_${header} ${reaches})
  endif()
  set(${result} ${reaches} PARENT_SCOPE)
endfunction()

# Every public header compiles alone, and twice. Those that include Atlas/core/Kernel.h find it precompiled: CGAL's kernel
# takes longer than all the rest.
set(atlas_public_headers ${atlas_headers})
list(FILTER atlas_public_headers EXCLUDE REGEX "/internal/")
foreach(header IN LISTS atlas_public_headers)
  string(REGEX REPLACE "[/.]" "_" name ${header})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include <@header@>\n#include <@header@>\n" @ONLY)
  atlas_reaches_kernel(${header} reaches)
  if(reaches)
    list(APPEND sources_with_kernel ${source})
  else()
    list(APPEND sources_without_kernel ${source})
  endif()
endforeach()
atlas_header_checks(atlas_headers_alone ${sources_without_kernel})
atlas_header_checks(atlas_kernel_headers_alone ${sources_with_kernel})
target_precompile_headers(atlas_kernel_headers_alone PRIVATE ${atlas_include}/Atlas/core/Kernel.h)

# All headers but those that say so compile when CGAL refuses its GPL packages; without a library, so that all
# definitions get along with each other, too.
set(content)
foreach(header IN LISTS atlas_headers)
  if(NOT header IN_LIST atlas_gpl_headers)
    string(APPEND content "#include <${header}>\n")
  endif()
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/headers/licence.cpp CONTENT "${content}" @ONLY)
atlas_header_checks(atlas_licence ${CMAKE_CURRENT_BINARY_DIR}/headers/licence.cpp)
target_compile_definitions(atlas_licence PRIVATE CGAL_LICENSE_ERROR ATLAS_HEADER_ONLY)

# atlas_must_not_compile(NAME SOURCE DEFINITION ERRORS...): the compiler refuses the source, and each of the regular
# expressions matches one of its errors.
function(atlas_must_not_compile name source definition)
  list(JOIN ARGN "|" errors)
  add_test(NAME ${name}
           COMMAND ${CMAKE_COMMAND} "-DERRORS=${errors}" -P ${PROJECT_SOURCE_DIR}/cmake/must_not_compile.cmake
                   -- ${CMAKE_CXX_COMPILER} -std=c++20 -fsyntax-only ${definition}
                   "-I$<JOIN:$<TARGET_PROPERTY:Atlas,INTERFACE_INCLUDE_DIRECTORIES>,;-I>"
                   "-I$<JOIN:$<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>,;-I>"
                   ${CMAKE_CURRENT_SOURCE_DIR}/must_not_compile/${source}
           COMMAND_EXPAND_LISTS)
endfunction()

# The licence test above sees what it has to see.
atlas_must_not_compile(Package.CompilerRefusesGplHeaders gpl_header.cpp -DCGAL_LICENSE_ERROR
                       "you defined CGAL_LICENSE_ERROR")
# A wrong policy fails at the call, with the name of the concept.
atlas_must_not_compile(Package.CompilerNamesTheConcept wrong_policies.cpp -DNDEBUG
                       ChartSegmentation ChartParameterizer UVOptimizer ChartValidator ChartSplitter ChartPacker)
atlas_must_not_compile(Package.CompilerRefusesUnknownNames unknown_name.cpp -DNDEBUG
                       "this function has no such named parameter")
atlas_must_not_compile(Package.CompilerNamesWhatIsNoMap wrong_maps.cpp -DNDEBUG "no matching function")

add_test(NAME Package.HeadersIncludeOnlyWhatTheirRoomMay
         COMMAND ${CMAKE_COMMAND} -DINCLUDE_DIR=${atlas_include} "-DOPTIONAL=${atlas_optional_headers}"
                 -P ${PROJECT_SOURCE_DIR}/cmake/check_includes.cmake)
add_test(NAME Package.EveryFileHasItsLicenceLine
         COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_licence_lines.sh)

# Every test source is listed in its folder; asked once all of them have been read.
function(atlas_check_test_lists)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  set(unlisted)
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME_WE)
    if(NOT TARGET ${name})
      string(APPEND unlisted " ${name}")
    endif()
  endforeach()
  add_test(NAME Package.EveryTestIsListed COMMAND ${CMAKE_COMMAND} -E echo "not listed:${unlisted}")
  set_tests_properties(Package.EveryTestIsListed PROPERTIES PASS_REGULAR_EXPRESSION "not listed:[\r\n]*$")
endfunction()
cmake_language(DEFER CALL atlas_check_test_lists)

# The package as others use it: installed, and as a subdirectory.
set(consumer ${CMAKE_CURRENT_BINARY_DIR}/consumer)
add_test(NAME Package.Install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${consumer}/prefix)
set_tests_properties(Package.Install PROPERTIES FIXTURES_SETUP atlas_installed)
# atlas_consumer_test(NAME OPTION): builds and runs the consumer project.
function(atlas_consumer_test name option)
  add_test(NAME ${name}
           COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer}/${name}
                   --build-generator ${CMAKE_GENERATOR} --build-makeprogram ${CMAKE_MAKE_PROGRAM}
                   --build-options ${option} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
                   -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
                   --test-command consumer)
endfunction()
atlas_consumer_test(Package.FindPackage -DCMAKE_PREFIX_PATH=${consumer}/prefix)
set_tests_properties(Package.FindPackage PROPERTIES FIXTURES_REQUIRED atlas_installed)
atlas_consumer_test(Package.AddSubdirectory -DATLAS_SOURCE_DIR=${PROJECT_SOURCE_DIR})
