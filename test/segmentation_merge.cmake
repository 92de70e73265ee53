# SPDX-License-Identifier: MIT
atlas_test(variational_segmentation_test)
atlas_test(merge_charts_test)
atlas_test(merge_controls_test)
