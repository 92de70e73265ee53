// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_LAYOUT_LIMITS_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_LAYOUT_LIMITS_H

#include <Atlas/core/Chart.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/segmentation/internal/merging/layout_quality.h>
#include <Atlas/segmentation/merge_charts.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The share of its convex hull that a flat chart fills.
inline double solidity(const Chart& layout)
{
  return area_uv(layout) / hull_area(layout.uv);
}

/// The share of the area that has to keep the stretch on a coarse surface: all but the largest triangle,
/// where that is more than the bound leaves out. A quantile is no worst triangle.
inline double share_of_coarse_triangles(const std::vector<Triangle_distortion>& measured,
                                        const Distortion_bound& bound)
{
  double sum = 0, largest = 0;
  for (const Triangle_distortion& t : measured) {
    sum += t.area_3d;
    largest = std::max(largest, t.area_3d);
  }
  return bound.stretch_share < 1 && sum > 0 ? 1 - largest / sum : 1;
}

/// Trials may use this share of the stretch that the bound allows beyond 1: at full resolution there are
/// worse places, and a chart that is beyond its bound then has to be cut and flattened anew.
inline constexpr double stretch_share_for_trials = 0.9;

/// Whether a triangle that has an area is flipped, or flat on the page.
inline bool has_flips(const Chart& layout)
{
  return std::any_of(layout.triangles.begin(), layout.triangles.end(), [&](const auto& triangle) {
    const auto& [u, v, w] = triangle;
    return CGAL::orientation(layout.uv[u], layout.uv[v], layout.uv[w]) != CGAL::LEFT_TURN &&
           CGAL::squared_area(layout.points[u], layout.points[v], layout.points[w]) > 0;
  });
}

/// The share that is used of the distortion beyond 1 that trials may use.
inline double used_share_of_trials(const Chart& layout, const Merge_options& options, double factor = 1)
{
  Distortion_bound bound = bound_of(options);
  bound.max = 1 + factor * options.share_for_trials * (bound.max - 1);
  bound.max_stretch =
      1 + factor * options.share_for_trials * stretch_share_for_trials * (bound.max_stretch - 1);
  const std::vector<Triangle_distortion> measured = triangle_distortions(layout);
  bound.stretch_share = std::min(bound.stretch_share, share_of_coarse_triangles(measured, bound));
  return used_share(measured, bound);
}

/// Whether the distortion beyond 1 is at most `factor` times what trials may use, and no triangle is flipped.
inline bool is_within_bound(const Chart& layout, const Merge_options& options, double factor = 1)
{
  return (std::isinf(factor) || used_share_of_trials(layout, options, factor) <= 1) && !has_flips(layout);
}

/// The share of their hull that two charts fill beside each other.
/// \param fit  brings the second to the first
inline double solidity_side_by_side(const Chart& a, const Chart& b, const Chain_fit& fit)
{
  std::vector<Vec2> points;
  points.reserve(a.uv.size() + b.uv.size());
  for (const Point_2& p : a.uv)
    points.push_back(to_vector(p));
  for (const Point_2& p : b.uv)
    points.push_back(fit(to_vector(p)));
  return (area_uv(a) + area_uv(b)) / polygon_area(convex_hull(std::move(points)));
}

/// The least share of its convex hull that a chart fills which comes from merging.
/// \param is_large  whether it has more than its share of the surface's area
inline double least_solidity(bool is_large, const Merge_options& options)
{
  return is_large ? std::max(options.min_solidity, options.solidity_of_large_charts) : options.min_solidity;
}

/// Whether a chart that comes from merging fills enough of its convex hull.
inline bool fills_hull(const Chart& layout, bool is_large, const Merge_options& options)
{
  return solidity(layout) >= least_solidity(is_large, options);
}

} // namespace Atlas::internal

#endif
