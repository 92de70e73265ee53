# SPDX-License-Identifier: MIT
atlas_test(LSCM_parameterizer_test)
atlas_test(Tutte_parameterizer_test)
atlas_test(Bijective_parameterizer_test)
