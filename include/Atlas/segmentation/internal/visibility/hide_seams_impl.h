// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_VISIBILITY_HIDE_SEAMS_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_VISIBILITY_HIDE_SEAMS_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/segmentation/internal/visibility/Visibility.h>
#include <Atlas/segmentation/smooth_borders.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace Atlas {

namespace internal {

/// What a seam costs out of sight, where it costs 1 in full view.
inline constexpr double least_cost_of_hidden_seams = 0.05;
/// The power of visibility that a seam costs: most of a surface is seen well, and differences there count.
inline constexpr double power_of_visibility = 2;

inline double cost_of_seen_seam(double visibility)
{
  return least_cost_of_hidden_seams +
         (1 - least_cost_of_hidden_seams) * std::pow(visibility, power_of_visibility);
}

/// The unit vector of an axis of any length.
inline Vector_3 checked_axis(const Vector_3& v)
{
  const double largest = std::max({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
  require(std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()) && largest > 0,
          "hide_seams.toward", "must be a finite vector of a length greater than 0");
  const Vector_3 scaled = v / largest;
  return scaled / std::sqrt(scaled.squared_length());
}

} // namespace internal

ATLAS_INLINE void hide_seams(Surface& surface, std::span<const double> visibility)
{
  internal::require(visibility.size() == surface.points.size(), "visibility",
                    "must have one value per point of the surface");
  internal::require(
      std::all_of(visibility.begin(), visibility.end(), [](double v) { return v >= 0 && v <= 1; }),
      "visibility", "must be in [0, 1] everywhere");
  surface.seam_cost.resize(surface.opposite.size(), 1);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (const Index o = surface.opposite[h]; o != no_index && h < o) {
      const auto& triangle = surface.triangles[h / 3];
      const double seen = (visibility[triangle[h % 3]] + visibility[triangle[next_halfedge(h) % 3]]) / 2;
      surface.seam_cost[h] *= internal::cost_of_seen_seam(seen);
      surface.seam_cost[o] = surface.seam_cost[h];
    }
}

ATLAS_INLINE void hide_seams(Surface& surface, const Seam_hiding& from, const Execution& execution)
{
  constexpr int directions = 64;
  internal::require(from.max_angle > 0 && from.max_angle <= 180, "hide_seams.max_angle",
                    "must be in (0, 180] degrees");
  const Vector_3 axis = internal::checked_axis(from.toward);
  const double angle = from.max_angle * std::numbers::pi / 180;
  const std::vector<double> visibility =
      internal::Visibility(surface).run(axis, angle, directions, execution);
  if (!execution.is_cancelled())
    hide_seams(surface, visibility);
}

} // namespace Atlas

#endif
