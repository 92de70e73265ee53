// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_OPTION_RANGES_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_OPTION_RANGES_H

#include <Atlas/segmentation/internal/arguments.h>
#include <Atlas/segmentation/merge_charts.h>

#include <limits>
#include <string>

namespace Atlas::internal {

/// Throws `Invalid_argument` if an option is out of its range.
inline void require_valid(const Merge_options& options)
{
  if (!(options.max_distortion >= 1))
    throw Invalid_argument("max_distortion",
                           "must be at least 1, but is " + std::to_string(options.max_distortion));
  if (!(options.max_stretch >= 1))
    throw Invalid_argument("max_stretch",
                           "must be at least 1, but is " + std::to_string(options.max_stretch));
  require_share(options.max_stretch_share, "max_stretch_share");
  require_positive(options.max_stretch_share, "max_stretch_share");
  require_share(options.share_for_trials, "share_for_trials");
  require_positive(options.share_for_trials, "share_for_trials");
  require_share(options.max_area_share, "max_area_share");
  require_positive(options.max_area_share, "max_area_share");
  require_share(options.solidity_of_large_charts, "solidity_of_large_charts");
  require_share(options.min_solidity, "min_solidity");
  require_share(options.min_gap, "min_gap");
  require_not_negative(options.max_misfit, "max_misfit");
  require_positive(options.triangles_per_chart, "triangles_per_chart");
  require(options.batch > 0, "batch", "must be at least 1, but is 0");
  if (options.orders < 1 || options.orders > 6)
    throw Invalid_argument("orders", "must be in [1, 6], but is " + std::to_string(options.orders));
  require_not_negative(options.min_chart_area, "min_chart_area");
}

} // namespace Atlas::internal

#endif
