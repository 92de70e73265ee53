# SPDX-License-Identifier: MIT
atlas_test(cut_to_discs_test)
