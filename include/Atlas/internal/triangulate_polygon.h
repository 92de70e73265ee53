// SPDX-License-Identifier: MIT
#ifndef ATLAS_INTERNAL_TRIANGULATE_POLYGON_H
#define ATLAS_INTERNAL_TRIANGULATE_POLYGON_H

#include <Atlas/Kernel.h>

#include <array>
#include <cmath>
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

/// Splits a polygon with n >= 3 corners into n - 2 triangles of corner numbers. The fan from the first corner
/// is taken where it is valid, since that is what most readers of polygon files do; else the fan from the
/// first corner that gives a valid one; else ears are cut, roundest first. Non-planar and self-crossing
/// polygons get a triangulation too.
template <typename PointAt>
void triangulate_polygon(std::size_t n, PointAt point, std::vector<std::array<Index, 3>>& triangles)
{
  triangles.clear();
  const auto fan = [&](std::size_t apex) {
    for (std::size_t k = 1; k + 1 < n; ++k)
      triangles.push_back({static_cast<Index>(apex), static_cast<Index>((apex + k) % n),
                           static_cast<Index>((apex + k + 1) % n)});
  };
  if (n == 3)
    return fan(0);
  const Vector_3 normal = area_vector(n, point);
  for (std::size_t apex = 0; apex < n; ++apex)
    if (is_fan_valid(n, point, normal, apex))
      return fan(apex);

  // Ear cutting, O(n^2): polygons that no fan triangulates are rare and small.
  std::vector<Index> ring(n);
  for (Index i = 0; i < n; ++i)
    ring[i] = i;
  const auto inside = [&](const Point_3& p, const Point_3& a, const Point_3& b, const Point_3& c) {
    return CGAL::cross_product(b - a, p - a) * normal >= 0 &&
           CGAL::cross_product(c - b, p - b) * normal >= 0 && CGAL::cross_product(a - c, p - c) * normal >= 0;
  };
  while (ring.size() > 3) {
    const std::size_t m = ring.size();
    std::size_t best = 0;
    double best_score = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < m; ++i) {
      const Index ia = ring[(i + m - 1) % m], ib = ring[i], ic = ring[(i + 1) % m];
      const Point_3 a = point(ia), b = point(ib), c = point(ic);
      const double area = CGAL::cross_product(b - a, c - b) * normal;
      bool is_ear = area > 0;
      for (std::size_t k = 0; is_ear && k < m; ++k)
        if (ring[k] != ia && ring[k] != ib && ring[k] != ic && inside(point(ring[k]), a, b, c))
          is_ear = false;
      const double longest =
          std::max({(b - a).squared_length(), (c - b).squared_length(), (a - c).squared_length()});
      const double roundness = longest > 0 ? area / longest : 0;
      const double score = is_ear ? roundness : roundness - 1e3 * std::sqrt(normal.squared_length()) - 1e300;
      if (score > best_score) {
        best_score = score;
        best = i;
      }
    }
    triangles.push_back({ring[(best + m - 1) % m], ring[best], ring[(best + 1) % m]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
}

} // namespace Atlas::internal

#endif
