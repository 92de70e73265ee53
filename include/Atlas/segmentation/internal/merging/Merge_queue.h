// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_QUEUE_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_QUEUE_H

#include <Atlas/segmentation/internal/merging/Merge_trials.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace Atlas::internal {

/// Which merges go first: those along borders that are long beside ...
enum class Merge_order {
  by_union,              ///< ... the root of the area of the union
  by_mean_perimeter,     ///< ... the geometric mean of both perimeters
  by_perimeter_in_union, ///< ... the perimeter of the smaller chart, small unions still earlier
  by_larger_perimeter,   ///< ... the perimeter of the larger chart, which makes round charts
  by_length,             ///< ... nothing
  by_smaller_area        ///< ... the root of the smaller area
};

/// What the length of the border between two charts is compared with.
inline double yardstick(Merge_order order, const Mergeable_chart& a, const Mergeable_chart& b)
{
  switch (order) {
  case Merge_order::by_union:
    return std::sqrt(a.area + b.area);
  case Merge_order::by_mean_perimeter:
    return std::sqrt(a.perimeter * b.perimeter);
  case Merge_order::by_perimeter_in_union:
    return std::min(a.perimeter, b.perimeter) * std::sqrt(std::sqrt(a.area + b.area));
  case Merge_order::by_larger_perimeter:
    return std::max(a.perimeter, b.perimeter);
  case Merge_order::by_length:
    return 1;
  case Merge_order::by_smaller_area:
    return std::sqrt(std::min(a.area, b.area));
  }
  return 0;
}

/// A merge that may be tried, as it stands while both charts keep their versions.
struct Queued_merge
{
  double priority;
  Index side, version, other_version;
  bool is_single; ///< only this arc, not all of its run

  bool operator<(const Queued_merge& o) const
  {
    return std::tie(priority, o.side, version, other_version, o.is_single) <
           std::tie(o.priority, side, o.version, o.other_version, is_single);
  }
};

/// Highest priority first.
using Merge_queue = std::priority_queue<Queued_merge>;

} // namespace Atlas::internal

#endif
