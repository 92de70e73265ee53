# SPDX-License-Identifier: MIT
atlas_test(overlaps_test)
atlas_test(Exact_validator_test)
atlas_test(certify_test)
atlas_test(Stencil_validator_test OSMesa::OSMesa)
