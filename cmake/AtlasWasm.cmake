# SPDX-License-Identifier: MIT
# The package for browsers and Node.js: a project of its own, for another compiler, built along with this one; and its tests.
include_guard(GLOBAL)
find_program(ATLAS_EMCMAKE emcmake DOC "emcmake of emscripten")
find_program(ATLAS_NODE NAMES node nodejs DOC "Node.js")
foreach(tool IN ITEMS ATLAS_EMCMAKE ATLAS_NODE)
  if(NOT ${tool})
    message(FATAL_ERROR "ATLAS_BUILD_WASM needs emscripten and Node.js; ${tool} has not been found")
  endif()
endforeach()
set(wasm ${PROJECT_BINARY_DIR}/wasm)
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
add_custom_target(atlas_wasm ALL
  COMMAND ${ATLAS_EMCMAKE} ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR}/bindings/wasm -B ${wasm} -G ${CMAKE_GENERATOR}
          -DCMAKE_BUILD_TYPE=Release -DATLAS_WARNINGS_AS_ERRORS=${ATLAS_WARNINGS_AS_ERRORS}
  COMMAND ${CMAKE_COMMAND} --build ${wasm} --parallel ${processors}
  USES_TERMINAL VERBATIM COMMENT "Building the package for browsers in ${wasm}/package")
if(NOT ATLAS_BUILD_TESTS)
  return()
endif()

set(tests ${PROJECT_SOURCE_DIR}/bindings/wasm/test)
add_test(NAME wasm.PredicatesAreExact COMMAND ${ATLAS_NODE} ${wasm}/exactness.js)
add_test(NAME wasm.Package COMMAND ${ATLAS_NODE} --test ${tests}/package_test.mjs)
if(TARGET texture_atlas)
  add_test(NAME wasm.SameAtlasAsNative
           COMMAND ${ATLAS_NODE} ${tests}/native_test.mjs $<TARGET_FILE:texture_atlas> ${ATLAS_DEMO_MESH_ARCHIVE})
endif()
set(wasm_tests wasm.PredicatesAreExact wasm.Package wasm.SameAtlasAsNative)

# With what npm installs: glTF-Transform, which calls the package in place of watlas, and what drives the browser.
if(ATLAS_TEST_BROWSER)
  find_program(ATLAS_NPM npm REQUIRED)
  find_program(ATLAS_CHROMIUM NAMES chromium chromium-browser google-chrome REQUIRED)
  add_test(NAME wasm.NodeModules COMMAND ${ATLAS_NPM} install --no-audit --no-fund --prefix ${wasm}/npm
                                               @gltf-transform/core@4.5.1 @gltf-transform/functions@4.5.1 playwright-core@1.65.1)
  set_tests_properties(wasm.NodeModules PROPERTIES FIXTURES_SETUP node_modules)
  add_test(NAME wasm.GltfTransform COMMAND ${ATLAS_NODE} ${tests}/gltf_transform_test.mjs)
  add_test(NAME wasm.Page COMMAND ${ATLAS_NODE} ${tests}/page_test.mjs ${ATLAS_CHROMIUM})
  list(APPEND wasm_tests wasm.GltfTransform wasm.Page)
  set_tests_properties(wasm.GltfTransform wasm.Page PROPERTIES FIXTURES_REQUIRED node_modules)
endif()
foreach(test IN LISTS wasm_tests)
  if(TEST ${test})
    set_tests_properties(${test} PROPERTIES ENVIRONMENT "ATLAS_PACKAGE=${wasm}/package;ATLAS_NODE_MODULES=${wasm}/npm/node_modules")
  endif()
endforeach()
