# SPDX-License-Identifier: MIT
atlas_test(build_surface_test)
