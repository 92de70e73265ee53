# SPDX-License-Identifier: MIT
atlas_test(build_surface_test)
atlas_test(measure_test)
atlas_test(generate_atlas_test)
atlas_test(Piece_rejoiner_test)
atlas_test(given_coordinates_test)
atlas_test(page_controls_test)
