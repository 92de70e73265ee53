// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_TRIAL_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_TRIAL_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/merging/Merge_trials.h>
#include <Atlas/segmentation/internal/merging/layout_limits.h>
#include <Atlas/segmentation/internal/merging/layout_quality.h>
#include <Atlas/segmentation/merge_charts.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The chart with about `triangles` triangles, or as it is if it has hardly more. The chart has to be a disc.
inline Chart coarse_copy(const Chart& chart, double triangles)
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

/// About how many triangles a coarse copy of a whole chart has: more than a chart of the coarse surface,
/// since it is what several of them have become.
inline double triangles_of_coarse_copies(const Merge_options& options)
{
  constexpr double least = 1200, charts_in_one = 6;
  return std::max(least, charts_in_one * options.triangles_per_chart);
}

/// Whether the border of a flat chart keeps off itself: two edges come no nearer than this share of their
/// length.
inline bool is_border_clear(const Chart& flat, double gap)
{
  std::vector<Border_edge> border;
  const std::vector<Index> opposite = opposite_halfedges(flat.triangles);
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] == no_index) {
      const Index a = flat.triangles[h / 3][h % 3], b = flat.triangles[h / 3][next_halfedge(h) % 3];
      border.push_back({flat.uv[a], flat.uv[b], a, b});
    }
  return is_clear(std::move(border), gap);
}

/// How a chart keeps the bounds when it is flattened.
struct Trial_verdict
{
  bool is_flat = false;                                  ///< without flips
  double used = std::numeric_limits<double>::infinity(); ///< share of the distortion that trials may use
  double filled = 0;                                     ///< share of the hull, over the least one
  bool is_clear = false;                                 ///< whether its border keeps off itself
  double area = 0;                                       ///< in space

  bool is_acceptable() const { return is_flat && used <= 1 && filled >= 1 && is_clear; }

  /// Whether it keeps every bound that another one keeps, and exceeds none by more but for rounding.
  bool is_no_worse_than(const Trial_verdict& other) const
  {
    constexpr double rounding = 1e-6;
    return is_flat && used <= (1 + rounding) * std::max(1., other.used) && fills_like(other, rounding) &&
           is_clear >= other.is_clear;
  }

private:
  /// A chart that fills too little of its hull may be one that is too large: it must not grow.
  bool fills_like(const Trial_verdict& other, double rounding) const
  {
    return filled >= 1 || (filled >= (1 - rounding) * other.filled && area <= (1 + rounding) * other.area);
  }
};

/// Examines a chart as far as a coarse copy of it tells. One that does not get coarse, such as one full of
/// spikes, is not flattened: this bounds the cost of a trial.
inline Trial_verdict examine(const Chart& chart, double whole_area, const Merge_options& options,
                             const Trial_flattening& flatten)
{
  Chart coarse = coarse_copy(chart, triangles_of_coarse_copies(options));
  if (coarse.number_of_triangles() > options.max_trial_triangles || flatten(coarse) != Chart_status::valid ||
      has_flips(coarse))
    return {};
  const double area = area_3d(chart);
  const double least = least_solidity(area > options.max_area_share * whole_area, options);
  return {true, used_share_of_trials(coarse, options),
          least > 0 ? solidity(coarse) / least : std::numeric_limits<double>::infinity(),
          is_border_clear(coarse, options.min_gap), area};
}

} // namespace Atlas::internal

#endif
