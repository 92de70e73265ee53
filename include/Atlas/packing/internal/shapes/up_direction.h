// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_UP_DIRECTION_H
#define ATLAS_PACKING_INTERNAL_SHAPES_UP_DIRECTION_H

#include <Atlas/core/Chart.h>
#include <Atlas/planar/internal/vectors.h>

#include <cmath>
#include <optional>

namespace Atlas::internal {

/// The image of a direction in space, of length 1, under the map of a triangle: of its part in the triangle's
/// plane, under the map's Jacobian. Times twice the triangle's area.
inline Vec2 image_of_direction(const Chart& chart, const std::array<Index, 3>& triangle,
                               const Vector_3& direction)
{
  const auto& [i, j, k] = triangle;
  const Vector_3 e = chart.points[j] - chart.points[i], f = chart.points[k] - chart.points[i];
  const double ee = e * e, ef = e * f, ff = f * f, eu = e * direction, fu = f * direction;
  const double area = std::sqrt(CGAL::cross_product(e, f).squared_length());
  if (!(area > 0))
    return {};
  const double a = (ff * eu - ef * fu) / area, b = (ee * fu - ef * eu) / area;
  const auto at = [&](Index v) { return Vec2{chart.uv[v].x(), chart.uv[v].y()}; };
  return a * (at(j) - at(i)) + b * (at(k) - at(i));
}

/// Where a direction in space points in the plane of a chart, on average over its area: a vector of length 1.
/// Nothing where the mean is shorter than a tenth of what it is for a chart along that direction: the chart
/// faces that way, or goes around. O(triangles).
///
/// \param direction  of length 1
inline std::optional<Vec2> mean_direction(const Chart& chart, const Vector_3& direction)
{
  constexpr double least_share = 0.1;
  if (chart.points.size() != chart.uv.size())
    return std::nullopt;
  Vec2 sum;
  double area = 0, in_plane = 0;
  for (const auto& triangle : chart.triangles) {
    const auto& [i, j, k] = triangle;
    sum = sum + image_of_direction(chart, triangle, direction);
    area += 2 * std::sqrt(CGAL::squared_area(chart.points[i], chart.points[j], chart.points[k]));
    in_plane += 2 * std::abs(CGAL::area(chart.uv[i], chart.uv[j], chart.uv[k]));
  }
  if (!(length(sum) > least_share * std::sqrt(area * in_plane)) || !std::isfinite(length(sum)))
    return std::nullopt;
  return (1 / length(sum)) * sum;
}

} // namespace Atlas::internal

#endif
