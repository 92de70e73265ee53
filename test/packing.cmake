# SPDX-License-Identifier: MIT
atlas_test(horizon_packer_test)
atlas_test(raster_packer_test)
