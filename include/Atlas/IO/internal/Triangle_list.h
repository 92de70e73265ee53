// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_TRIANGLE_LIST_H
#define ATLAS_IO_INTERNAL_TRIANGLE_LIST_H

#include <Atlas/IO/Polygon_soup.h>
#include <Atlas/Surface.h>
#include <Atlas/build_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// \brief The soup as separate triangles of floats, for renderers: three corners each, scaled into the unit
/// ball about the origin, with normals that are smooth except at sharp edges.
struct Triangle_list
{
  std::vector<float> positions; ///< 3 per corner
  std::vector<float> normals;   ///< 3 per corner
  std::vector<float> uv;        ///< 2 per corner; 0 where the face has none
  std::vector<Index> face;      ///< per triangle: the face of the soup

  explicit Triangle_list(const Polygon_soup& soup)
  {
    const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
    const std::vector<Point_3> points = normalized_points(surface);
    const std::vector<Vector_3> facet = facet_normals(surface, points);
    const std::vector<std::vector<Index>> around = corners_around(surface);
    for (Index h = 0; h < 3 * surface.number_of_triangles(); ++h) {
      const Point_3& p = points[surface.triangles[h / 3][h % 3]];
      const Vector_3 n = corner_normal(surface, facet, around, h);
      const Point_2 t = soup.uv.empty() ? Point_2(0, 0) : soup.uv[surface.corner[h]];
      const bool has_uv = std::isfinite(t.x()) && std::isfinite(t.y());
      append(positions, {p.x(), p.y(), p.z()});
      append(normals, {n.x(), n.y(), n.z()});
      append(uv, {has_uv ? t.x() : 0, has_uv ? t.y() : 0});
    }
    face = surface.face;
  }

private:
  static void append(std::vector<float>& to, std::initializer_list<double> values)
  {
    for (const double value : values)
      to.push_back(static_cast<float>(value));
  }

  /// Moves the middle of the bounding box of the triangles to the origin and the farthest vertex to
  /// distance 1.
  static std::vector<Point_3> normalized_points(const Surface& surface)
  {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (const auto& triangle : surface.triangles)
      for (const Index v : triangle)
        for (int k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], surface.points[v][k]);
          high[k] = std::max(high[k], surface.points[v][k]);
        }
    // Halves first: the sum and the difference of large numbers may overflow.
    const double half =
        std::max({high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2, high[2] / 2 - low[2] / 2});
    const auto centered = [&](const Point_3& p, int k) {
      return half > 0 ? (p[k] - (low[k] / 2 + high[k] / 2)) / half : 0;
    };
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
    return points;
  }

  static std::vector<Vector_3> facet_normals(const Surface& surface, const std::vector<Point_3>& points)
  {
    std::vector<Vector_3> normals;
    normals.reserve(surface.number_of_triangles());
    for (const auto& [a, b, c] : surface.triangles)
      normals.push_back(CGAL::cross_product(points[b] - points[a], points[c] - points[a]));
    return normals;
  }

  static std::vector<std::vector<Index>> corners_around(const Surface& surface)
  {
    std::vector<std::vector<Index>> around(surface.points.size());
    for (Index h = 0; h < 3 * surface.number_of_triangles(); ++h)
      around[surface.triangles[h / 3][h % 3]].push_back(h);
    return around;
  }

  /// The mean of the area vectors around the vertex that lie within 45 degrees of the corner's own.
  static Vector_3 corner_normal(const Surface& surface, const std::vector<Vector_3>& facet,
                                const std::vector<std::vector<Index>>& around, Index h)
  {
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
    return length > 0 ? sum / length : Vector_3(0, 0, 1);
  }

  /// Fans of more triangles are shaded flat, so that the work stays linear.
  static constexpr std::size_t most_corners_averaged = 64;
};

} // namespace Atlas::internal

#endif
