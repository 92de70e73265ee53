// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_CULPRIT_SPLITTER_IMPL_H
#define ATLAS_VALIDATION_INTERNAL_CULPRIT_SPLITTER_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/validation/Culprit_splitter.h>
#include <Atlas/validation/internal/Worst_place.h>
#include <Atlas/validation/internal/chart_densities.h>
#include <Atlas/validation/internal/chart_faults.h>
#include <Atlas/validation/internal/split_chart.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Atlas {

namespace internal {

/// Two parts, by a short cut through the place with most distortion.
inline std::vector<Index> cut_at_worst_place(const Chart& chart)
{
  const auto length = [&](Index h) {
    const Index g = next_halfedge(h);
    return std::sqrt(CGAL::squared_distance(chart.points[chart.triangles[h / 3][h % 3]],
                                            chart.points[chart.triangles[g / 3][g % 3]]));
  };
  return Worst_place(chart, length).parts();
}

} // namespace internal

ATLAS_INLINE Culprit_splitter::Culprit_splitter(double area_quantile) : area_quantile_(area_quantile)
{
  internal::require(area_quantile >= 0 && area_quantile < 0.5, "area_quantile", "must be in [0, 0.5)");
}

ATLAS_INLINE std::vector<Index> Culprit_splitter::split(const Chart& chart,
                                                        const Chart_verdict& verdict) const
{
  const internal::Chart_graph graph(chart);
  auto [parts, components] = graph.components([](Index) { return true; });
  if (components > 1)
    return parts;
  if (internal::has_coordinates(chart)) {
    // Triangles that are counterclockwise here are to blame for what rounding makes of them on a page.
    const auto is_flipped_later = [&] {
      return std::none_of(verdict.culprits.begin(), verdict.culprits.end(),
                          [&](Index t) { return internal::is_flipped(chart, t); });
    };
    if (verdict.status == Chart_status::overlapping)
      parts = internal::split_overlap(
          chart, graph,
          find_overlaps(internal::triangles_uv(chart), Execution(), internal::max_pairs_of_zone));
    else if (verdict.status == Chart_status::area_ratio_exceeded)
      parts = internal::Chart_densities(chart, area_quantile_).split(graph);
    else if (verdict.status == Chart_status::bound_exceeded)
      parts = internal::cut_at_worst_place(chart);
    else if (verdict.status == Chart_status::flipped && is_flipped_later())
      parts = internal::cut_off_small(chart, graph, verdict.culprits);
    else if (verdict.status == Chart_status::flipped)
      parts = internal::cut_through(graph, verdict.culprits);
  }
  if (!internal::is_split(parts))
    parts = internal::halve(graph);
  return internal::renumber(std::move(parts));
}

} // namespace Atlas

#endif
