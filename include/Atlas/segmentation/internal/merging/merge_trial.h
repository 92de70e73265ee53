// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_TRIAL_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_TRIAL_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/measure/area.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/segmentation/Merge_options.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/merging/layout_quality.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The share of its convex hull that a flat chart fills.
inline double solidity(const Chart& layout)
{
  return area_uv(layout) / hull_area(layout.uv);
}

/// Whether the distortion beyond 1 is at most `factor` times what trials may use, and no triangle is flipped.
inline bool is_within_bound(const Chart& layout, const Merge_options& options, double factor = 1)
{
  const Atlas::Distortion distortion = measure_distortion(layout);
  if (std::isfinite(factor) && !(value(distortion, options.measure) <=
                                 1 + factor * options.share_for_trials * (options.max_distortion - 1)))
    return false;
  for (const auto& [u, v, w] : layout.triangles)
    if (CGAL::orientation(layout.uv[u], layout.uv[v], layout.uv[w]) != CGAL::LEFT_TURN &&
        CGAL::squared_area(layout.points[u], layout.points[v], layout.points[w]) > 0)
      return false;
  return true;
}

/// The chart with about `triangles` triangles, or as it is if it has hardly more. The chart has to be a disc.
inline Chart coarse_chart(const Chart& chart, double triangles)
{
  if (static_cast<double>(chart.number_of_triangles()) <= 2 * triangles)
    return chart;
  Surface surface;
  surface.points = chart.points;
  surface.triangles = chart.triangles;
  surface.opposite = opposite_halfedges(chart.triangles);
  surface.face.resize(chart.number_of_triangles());
  for (Index t = 0; t < surface.face.size(); ++t)
    surface.face[t] = t;
  Segmentation whole;
  whole.chart.assign(chart.number_of_triangles(), 0);
  whole.cut.assign(3 * chart.number_of_triangles(), 0);
  whole.number_of_charts = 1;
  Coarse_surface coarse = Surface_simplifier(surface, whole, chart_arcs(surface, whole), triangles).run();
  Chart result;
  result.points = std::move(coarse.points);
  result.triangles = std::move(coarse.triangles);
  return result;
}

/// About how many triangles a chart has when it is flattened to see whether smoothing keeps the bound.
inline double triangles_of_smoothed_charts(const Merge_options& options)
{
  constexpr double least = 400, charts_in_one = 6;
  return std::max(least, charts_in_one * options.triangles_per_chart);
}

/// Whether the chart stays within the bounds when it is flattened, as far as a coarse copy of it tells. A
/// chart that does not get coarse, such as one full of spikes, is refused: this bounds the cost of a trial.
template <typename Flatten>
bool passes_trial(const Chart& chart, double whole_area, const Merge_options& options, const Flatten& flatten)
{
  Chart coarse = coarse_chart(chart, triangles_of_smoothed_charts(options));
  if (coarse.number_of_triangles() > options.max_trial_triangles || flatten(coarse) != Chart_status::valid ||
      !is_within_bound(coarse, options))
    return false;
  const double filled = solidity(coarse);
  if (filled < options.min_solidity ||
      (filled < options.solidity_of_large_charts && area_3d(chart) > options.max_area_share * whole_area))
    return false;
  std::vector<Border_edge> border;
  const std::vector<Index> opposite = opposite_halfedges(coarse.triangles);
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] == no_index) {
      const Index a = coarse.triangles[h / 3][h % 3], b = coarse.triangles[h / 3][next_halfedge(h) % 3];
      border.push_back({coarse.uv[a], coarse.uv[b], a, b});
    }
  return is_clear(std::move(border), options.min_gap);
}

} // namespace Atlas::internal

#endif
