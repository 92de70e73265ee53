# SPDX-License-Identifier: MIT
atlas_test(overlaps_test)
atlas_test(Exact_validator_test)
atlas_test(certify_test)
atlas_test(Stencil_validator_test OSMesa::OSMesa)
if(TARGET verify_atlas)
  add_test(NAME verify_atlas_calling_contract
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/verify_atlas_cli_test.sh $<TARGET_FILE:verify_atlas>)
endif()
