# SPDX-License-Identifier: MIT
atlas_test(ABF_parameterizer_test)
