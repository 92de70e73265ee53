// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_TRIANGULATE_POLYGON_H
#define ATLAS_CORE_INTERNAL_TRIANGULATE_POLYGON_H

#include <Atlas/core/Kernel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// Newell's normal of a polygon in space: twice its area vector.
template <typename PointAt>
Vector_3 area_vector(std::size_t n, PointAt point)
{
  Vector_3 sum(0, 0, 0);
  for (std::size_t i = 1; i + 1 < n; ++i)
    sum = sum + CGAL::cross_product(point(i) - point(0), point(i + 1) - point(0));
  return sum;
}

/// Whether all triangles of the fan around corner `apex` face the same way as the polygon.
template <typename PointAt>
bool is_fan_valid(std::size_t n, PointAt point, const Vector_3& normal, std::size_t apex)
{
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Point_3 a = point(apex), b = point((apex + k) % n), c = point((apex + k + 1) % n);
    if (!(CGAL::cross_product(b - a, c - a) * normal > 0))
      return false;
  }
  return true;
}

/// Splits a polygon with n >= 3 corners into a fan of n - 2 triangles of corner numbers, the common corner
/// first.
///
/// The fan from the first corner is taken where all its triangles face the same way, else that from the first
/// corner for which they do. If there is none, the polygon is a fan from its first corner all the same: that
/// is how readers of polygon files see it, so that a map that is one-to-one on this fan is one-to-one for
/// them.
template <typename PointAt>
void triangulate_polygon(std::size_t n, PointAt point, std::vector<std::array<Index, 3>>& triangles)
{
  std::size_t apex = 0;
  if (n > 3) {
    const Vector_3 normal = area_vector(n, point);
    while (apex < n && !is_fan_valid(n, point, normal, apex))
      ++apex;
    apex %= n;
  }
  triangles.clear();
  for (std::size_t k = 1; k + 1 < n; ++k)
    triangles.push_back({static_cast<Index>(apex), static_cast<Index>((apex + k) % n),
                         static_cast<Index>((apex + k + 1) % n)});
}

} // namespace Atlas::internal

#endif
