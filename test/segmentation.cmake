# SPDX-License-Identifier: MIT
atlas_test(cut_to_discs_test)
atlas_test(distance_to_features_test)
atlas_test(expand_charts_test)
atlas_test(feature_detection_test)
atlas_test(Feature_segmentation_test)
atlas_test(smooth_borders_test)
if(TARGET segmentation_steps)
  add_test(NAME segmentation_steps_calling_contract
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/segmentation_steps_cli_test.sh $<TARGET_FILE:segmentation_steps>)
endif()
