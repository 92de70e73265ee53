# SPDX-License-Identifier: MIT
# Tests of the package as a whole: its headers one by one, its licence border, its use from outside.


set(atlas_include ${PROJECT_SOURCE_DIR}/include)
file(GLOB_RECURSE atlas_headers RELATIVE ${atlas_include} CONFIGURE_DEPENDS ${atlas_include}/Atlas/*.h)
set(atlas_public_headers ${atlas_headers})
list(FILTER atlas_public_headers EXCLUDE REGEX "/internal/")

# Headers that stand on more than CGAL's LGPL parts, Boost and Eigen; each says so.
set(atlas_gpl_headers ${atlas_headers})
list(FILTER atlas_gpl_headers INCLUDE REGEX "parameterization/(CGAL_parameterizer|Cholmod_)|bake_ambient_occlusion|/internal/occlusion/")
set(atlas_optional_headers ${atlas_headers})
list(FILTER atlas_optional_headers INCLUDE REGEX "/internal/rendering/")
list(APPEND atlas_optional_headers ${atlas_gpl_headers})
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)

# atlas_header_checks(NAME SUFFIX SOURCES...): sources that only need to compile.
function(atlas_header_checks name suffix)
  add_library(${name} OBJECT ${ARGN})
  target_link_libraries(${name} PRIVATE Atlas::IO${suffix} Atlas::Rendering${suffix} Atlas::Occlusion${suffix}
                                        OSMesa::OSMesa)
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
atlas_header_checks(atlas_headers_alone _headers ${sources_without_kernel})
atlas_header_checks(atlas_kernel_headers_alone _headers ${sources_with_kernel})
target_precompile_headers(atlas_kernel_headers_alone PRIVATE ${atlas_include}/Atlas/core/Kernel.h)

# All headers but those that say so, and all definitions behind them, go together without a library, and compile when
# CGAL refuses its GPL packages.
set(content)
foreach(header IN LISTS atlas_public_headers atlas_headers) # public ones come first, as for a user
  if(NOT header IN_LIST atlas_gpl_headers)
    string(APPEND content "#include <${header}>\n")
  endif()
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/headers/all.cpp CONTENT "${content}" @ONLY)
atlas_header_checks(atlas_headers_together _header_only ${CMAKE_CURRENT_BINARY_DIR}/headers/all.cpp)
target_compile_definitions(atlas_headers_together PRIVATE CGAL_LICENSE_ERROR)

# Then nothing is defined that a second source would define again: no symbol but weak and local ones.
add_test(NAME Package.HeadersAloneDefineNothingTwice
         COMMAND ${CMAKE_COMMAND} -E env ${CMAKE_NM} -C -g --defined-only $<TARGET_OBJECTS:atlas_headers_together>)
set_tests_properties(Package.HeadersAloneDefineNothingTwice PROPERTIES FAIL_REGULAR_EXPRESSION " [TDBRC] ")

# What a user meets stays small: public headers, files and functions.
list(LENGTH atlas_public_headers count)
add_test(NAME Package.AtMost60PublicHeaders COMMAND ${CMAKE_COMMAND} -E echo "${count} public headers")
set_tests_properties(Package.AtMost60PublicHeaders PROPERTIES PASS_REGULAR_EXPRESSION "^([1-5]?[0-9]|60) public")
add_test(NAME Package.FilesAndFunctionsAreShort COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_sizes.sh)

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

set(from_prefix -DCMAKE_PREFIX_PATH=${consumer}/prefix)
set(configure -G ${CMAKE_GENERATOR} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER})

# atlas_consumer_test(NAME TARGET OPTIONS...): configures the consumer project, builds the target and runs what it has made.
function(atlas_consumer_test name target)
  add_test(NAME ${name}
           COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer}/${name}
                   --build-generator ${CMAKE_GENERATOR} --build-makeprogram ${CMAKE_MAKE_PROGRAM} --build-target ${target}
                   --build-options ${ARGN} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
                   -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
                   --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure --no-tests=error)
endfunction()
atlas_consumer_test(Package.FindPackage all ${from_prefix} -DEXPECTED=IO,Rendering,Occlusion,C)
# As a subdirectory: what needs no library of Atlas, since that would be compiled once more.
atlas_consumer_test(Package.AddSubdirectory consumer_header_only -DATLAS_SOURCE_DIR=${PROJECT_SOURCE_DIR} -DEXPECTED=IO)

# And by a compiler of C that asks pkg-config.
if(TARGET Atlas::C)
  enable_language(C)
  find_program(PKG_CONFIG pkg-config REQUIRED)
  set(program ${consumer}/consumer_of_pkg_config)
  set(pc ${consumer}/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  add_test(NAME Package.PkgConfig
           COMMAND sh -c "export PKG_CONFIG_PATH=${pc} LD_LIBRARY_PATH=${pc}/.. && \
                   ${CMAKE_C_COMPILER} -std=c89 ${CMAKE_CURRENT_SOURCE_DIR}/consumer/consumer_in_c.c -o ${program} \
                   $(${PKG_CONFIG} --cflags --libs atlas_c) && ${program}")
  set_tests_properties(Package.PkgConfig PROPERTIES FIXTURES_REQUIRED atlas_installed)
endif()

# What a component needs may be missing: then it is not found, and nothing else fails. The first list is what is left.
function(atlas_missing_test name left)
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_SOURCE_DIR}/consumer -B ${consumer}/${name}
                                ${configure} ${from_prefix} -DEXPECTED=${left} ${ARGN})
endfunction()
atlas_missing_test(Package.FindPackageWithoutOSMesa IO,Occlusion,C -DCMAKE_DISABLE_FIND_PACKAGE_OSMesa=ON)
atlas_missing_test(Package.FindPackageWithoutPNG Rendering,C -DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON)
set_tests_properties(Package.FindPackage Package.FindPackageWithoutOSMesa Package.FindPackageWithoutPNG
                     PROPERTIES FIXTURES_REQUIRED atlas_installed)
add_test(NAME Package.ConfigureWithoutOSMesa
         COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${consumer}/without_osmesa ${configure}
                 -DCMAKE_DISABLE_FIND_PACKAGE_OSMesa=ON -DATLAS_BUILD_TESTS=OFF)
set_tests_properties(Package.ConfigureWithoutOSMesa PROPERTIES
                     PASS_REGULAR_EXPRESSION "without its component Rendering; not found: OSMesa.*Generating done"
                     FAIL_REGULAR_EXPRESSION "CMake Error")

# Recipes of packages say what is so.
add_test(NAME Package.RecipesAgreeWithTheProject
         COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} -P
                 ${PROJECT_SOURCE_DIR}/cmake/check_recipes.cmake)
