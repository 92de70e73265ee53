# SPDX-License-Identifier: MIT
atlas_test(LSCM_parameterizer_test)
