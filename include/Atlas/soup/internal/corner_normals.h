// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_CORNER_NORMALS_H
#define ATLAS_SOUP_INTERNAL_CORNER_NORMALS_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The points of a surface in the unit ball about the origin.
struct Normalized_points
{
  std::vector<Point_3> points;
  double unit = 1; ///< the length in the surface that is 1 here
};

/// Moves the middle of the bounding box of the triangles to the origin and the farthest vertex to distance 1.
inline Normalized_points normalized_points(const Surface& surface)
{
  const Bounding_box box = bounding_box(surface);
  const double half = box.half_side;
  const auto centered = [&](const Point_3& p, int k) { return half > 0 ? (p[k] - box.center[k]) / half : 0; };
  std::vector<Point_3> points;
  points.reserve(surface.points.size());
  for (const Point_3& p : surface.points)
    points.emplace_back(centered(p, 0), centered(p, 1), centered(p, 2));
  double radius = 0;
  for (const auto& triangle : surface.triangles)
    for (const Index v : triangle)
      radius = std::max(radius, (points[v] - CGAL::ORIGIN).squared_length());
  radius = radius > 0 ? std::sqrt(radius) : 1;
  for (Point_3& p : points)
    p = Point_3(p.x() / radius, p.y() / radius, p.z() / radius);
  return {std::move(points), half > 0 ? half * radius : 1};
}

/// Per triangle its area vector, twice as long as the area.
inline std::vector<Vector_3> facet_normals(const Surface& surface, const std::vector<Point_3>& points)
{
  std::vector<Vector_3> normals;
  normals.reserve(surface.number_of_triangles());
  for (const auto& [a, b, c] : surface.triangles)
    normals.push_back(CGAL::cross_product(points[b] - points[a], points[c] - points[a]));
  return normals;
}

/// \brief Unit normals that are smooth except at sharp edges: per triangle corner the mean of the area
/// vectors around the vertex that lie within 45 degrees of the triangle's own.
///
/// Fans of many triangles are shaded flat, so that the work stays linear.
inline std::vector<Vector_3> corner_normals(const Surface& surface, const std::vector<Vector_3>& facet)
{
  constexpr std::size_t most_corners_averaged = 64;
  std::vector<std::vector<Index>> around(surface.points.size());
  for (Index h = 0; h < 3 * surface.number_of_triangles(); ++h)
    around[surface.triangles[h / 3][h % 3]].push_back(h);
  std::vector<Vector_3> normals;
  normals.reserve(3 * surface.number_of_triangles());
  for (Index h = 0; h < 3 * surface.number_of_triangles(); ++h) {
    const Vector_3& own = facet[h / 3];
    const auto& corners = around[surface.triangles[h / 3][h % 3]];
    Vector_3 sum = own;
    if (corners.size() <= most_corners_averaged)
      for (const Index g : corners) {
        const Vector_3& other = facet[g / 3];
        const double product = own * other;
        if (g != h && product > 0 && 2 * product * product > own.squared_length() * other.squared_length())
          sum = sum + other;
      }
    const double length = std::sqrt(sum.squared_length());
    normals.push_back(length > 0 ? sum / length : Vector_3(0, 0, 1));
  }
  return normals;
}

} // namespace Atlas::internal

#endif
