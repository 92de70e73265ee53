# SPDX-License-Identifier: MIT
include(${PROJECT_SOURCE_DIR}/cmake/AtlasIO.cmake)
atlas_test(read_polygon_soup_test Atlas_IO)
atlas_test(write_obj_test Atlas_IO)
atlas_test(draw_atlas_test Atlas_IO)
atlas_test(write_gltf_test Atlas_IO)
atlas_test(write_html_report_test Atlas_IO)
atlas_test(bake_texture_test Atlas_IO)
atlas_test(bake_normals_test Atlas_IO)
atlas_test(bake_ambient_occlusion_test Atlas_IO)
atlas_test(transfer_texture_test Atlas_IO)
atlas_test(pages_test Atlas_IO)
# Another library reads what is written.
find_package(assimp REQUIRED CONFIG)
atlas_test(assimp_round_trip_test Atlas_IO assimp::assimp)
if(TARGET texture_atlas)
  add_test(NAME texture_atlas_calling_contract
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/cli_test.sh $<TARGET_FILE:texture_atlas>)
endif()
