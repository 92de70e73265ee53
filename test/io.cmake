# SPDX-License-Identifier: MIT
include(${PROJECT_SOURCE_DIR}/cmake/AtlasIO.cmake)
atlas_test(read_polygon_soup_test Atlas_IO)
atlas_test(write_obj_test Atlas_IO)
atlas_test(draw_atlas_test Atlas_IO)
