// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_CUTTING_ROOM_ESTIMATE_H
#define ATLAS_PACKING_INTERNAL_CUTTING_ROOM_ESTIMATE_H

#include <Atlas/planar/internal/convex_hull.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief About how much of a page a chart takes up, told from its shape alone.
///
/// Packers fill bays of charts in part only: a chart counts with the mean of its convex hull and its least
/// bounding rectangle, with half a gutter all around. Large charts leave gaps between them that nothing
/// fills, so that room grows a little faster than area. A chart that is longer than the page sets the scale
/// of all others: it takes up the page that it would need.
struct Room_estimate
{
  double side = 1;   ///< of the page, in units of the charts
  double gutter = 0; ///< in units of the charts

  /// How much of the gaps between charts is due to their size.
  static constexpr double share_of_size = 0.3;
  /// Charts of up to so many sides of the page lie on it askew.
  static constexpr double longest = 1.1;

  /// How many sides of the page a chart is long. O(n log n).
  double sides(std::vector<Vec2> points) const
  {
    const std::vector<Vec2> hull = convex_hull(std::move(points));
    const Vec2 extent = size_along(hull, least_rectangle_direction(hull));
    return std::max(extent.x, extent.y) / side;
  }

  /// O(n log n) for n points, which are those of the chart's border.
  double operator()(std::vector<Vec2> points) const
  {
    const std::vector<Vec2> hull = convex_hull(std::move(points));
    const Vec2 extent = size_along(hull, least_rectangle_direction(hull));
    const double solid = (extent.x * extent.y + polygon_area(hull)) / 2 + gutter * (extent.x + extent.y);
    const double excess = std::max(extent.x, extent.y) / (longest * side);
    return solid + share_of_size * solid * std::sqrt(solid) / side +
           side * side * std::max(0.0, excess * excess - 1);
  }
};

} // namespace Atlas::internal

#endif
