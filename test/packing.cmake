# SPDX-License-Identifier: MIT
atlas_test(horizon_packer_test)
