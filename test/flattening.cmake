# SPDX-License-Identifier: MIT
atlas_test(ABF_parameterizer_test)
atlas_test(flattening_stress_test)
