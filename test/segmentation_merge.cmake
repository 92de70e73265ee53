# SPDX-License-Identifier: MIT
atlas_test(variational_segmentation_test)
