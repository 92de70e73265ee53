// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SURFACE_TRIANGLE_GEOMETRY_H
#define ATLAS_SEGMENTATION_INTERNAL_SURFACE_TRIANGLE_GEOMETRY_H

#include <Atlas/core/Surface.h>

#include <algorithm>
#include <cmath>

namespace Atlas::internal {

/// The distance of two points, without overflow or underflow on the way.
inline double distance_between(const Point_3& p, const Point_3& q)
{
  constexpr double largest = 1e300, smallest = 1e-280;
  const double x = q.x() - p.x(), y = q.y() - p.y(), z = q.z() - p.z();
  const double square = x * x + y * y + z * z;
  return square < largest && square > smallest ? std::sqrt(square) : std::hypot(x, y, z);
}

inline double edge_length(const Surface& surface, Index h)
{
  return distance_between(surface.point(h), surface.point(next_halfedge(h)));
}

/// Twice the area vector divided by the square of `scale`, the largest component of the edges at corner 0: in
/// range whatever the unit of the model is. The zero vector if all corners are in one place.
inline Vector_3 scaled_area_vector(const Surface& surface, Index t, double& scale)
{
  const Point_3& origin = surface.point(3 * t);
  const Vector_3 a = surface.point(3 * t + 1) - origin, b = surface.point(3 * t + 2) - origin;
  scale = std::max(
      {std::abs(a.x()), std::abs(a.y()), std::abs(a.z()), std::abs(b.x()), std::abs(b.y()), std::abs(b.z())});
  if (!(scale > 0) || !std::isfinite(scale))
    return Vector_3(0, 0, 0);
  return CGAL::cross_product(a / scale, b / scale);
}

inline double triangle_area(const Surface& surface, Index t)
{
  double scale;
  const Vector_3 n = scaled_area_vector(surface, t, scale);
  return std::sqrt(n.squared_length()) * scale * scale / 2;
}

/// The unit normal; the zero vector where the triangle has none.
inline Vector_3 unit_normal(const Surface& surface, Index t)
{
  double scale;
  const Vector_3 n = scaled_area_vector(surface, t, scale);
  const double length = std::sqrt(n.squared_length());
  return length > 0 ? n / length : Vector_3(0, 0, 0);
}

/// A vector over its length; the zero vector stays.
inline Vector_3 unit(const Vector_3& v)
{
  const double length = std::sqrt(v.squared_length());
  return length > 0 ? v / length : Vector_3(0, 0, 0);
}

/// The angle between two vectors in [0, pi]; zero if one of them is zero.
inline double angle_between(const Vector_3& a, const Vector_3& b)
{
  return std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
}

} // namespace Atlas::internal

#endif
