// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_JOINED_CHARTS_H
#define ATLAS_PIPELINE_INTERNAL_JOINED_CHARTS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/measure/distortion.h>

#include <algorithm>

namespace Atlas::internal {

/// The share of what a bound on a mean allows beyond 1 that charts may use which take in pieces of others.
inline constexpr double share_for_joined_charts = 0.6;

/// Pieces of a chart that was split in vain may find together again.
inline bool are_all_beyond_bound(const Flattened_chart& joined, const Flattened_chart& a,
                                 const Flattened_chart& b)
{
  return joined.verdict.status == Chart_status::bound_exceeded &&
         a.verdict.status == Chart_status::bound_exceeded && b.verdict.status == Chart_status::bound_exceeded;
}

/// Whether a chart has no more distortion than the two it came from have on average, or keeps well within the
/// bound.
inline bool is_no_worse(const Chart& joined, const Chart& a, const Chart& b, const Distortion_bound& bound)
{
  const auto distortion = [&](const Chart& chart) { return value(measure_distortion(chart), bound.measure); };
  const double area_a = area_3d(a), area_b = area_3d(b);
  const double mean = (area_a * distortion(a) + area_b * distortion(b)) / (area_a + area_b);
  // Means hide what is bad near the piece.
  const double share = is_mean(bound.measure) ? share_for_joined_charts : 1;
  return distortion(joined) <= std::max(mean, 1 + share * (bound.max - 1));
}

} // namespace Atlas::internal

#endif
