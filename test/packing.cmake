# SPDX-License-Identifier: MIT
atlas_test(horizon_packer_test)
atlas_test(raster_packer_test)
atlas_test(Overlap_search_test)
atlas_test(pack_charts_test)
atlas_test(packing_property_test)
if(TARGET repack_atlas)
  add_test(NAME repack_atlas_calling_contract
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/repack_atlas_cli_test.sh $<TARGET_FILE:repack_atlas>
                   $<TARGET_FILE:verify_atlas>)
endif()
