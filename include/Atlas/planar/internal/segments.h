// SPDX-License-Identifier: MIT
#ifndef ATLAS_PLANAR_INTERNAL_SEGMENTS_H
#define ATLAS_PLANAR_INTERNAL_SEGMENTS_H

#include <Atlas/core/Kernel.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>

namespace Atlas::internal {

inline Vec2 to_vector(const Point_2& p)
{
  return {p.x(), p.y()};
}

/// Where on the segment from `a` to `b` the point nearest to `p` is: 0 at `a`, 1 at `b`.
inline double closest_position(Vec2 p, Vec2 a, Vec2 b)
{
  const Vec2 d = b - a;
  const double l = dot(d, d);
  return l > 0 ? std::clamp(dot(p - a, d) / l, 0.0, 1.0) : 0.0;
}

/// The point of the segment from `a` to `b` that is nearest to `p`.
inline Vec2 closest_point(Vec2 p, Vec2 a, Vec2 b)
{
  return a + closest_position(p, a, b) * (b - a);
}

/// Squared distance of a point from a segment, in double precision.
inline double squared_distance(Vec2 p, Vec2 a, Vec2 b)
{
  const Vec2 e = p - closest_point(p, a, b);
  return dot(e, e);
}

/// Which side of the line from `a` to `b` a point lies on: 1 left, -1 right, 0 on it. Exact.
inline int side_of_line(Vec2 a, Vec2 b, Vec2 p)
{
  return static_cast<int>(CGAL::orientation(Point_2(a.x, a.y), Point_2(b.x, b.y), Point_2(p.x, p.y)));
}

/// Whether two segments have a point in common. Exact.
inline bool do_segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
  const auto in_box = [](Vec2 p, Vec2 q, Vec2 r) {
    return std::min(p.x, q.x) <= r.x && r.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= r.y &&
           r.y <= std::max(p.y, q.y);
  };
  const int c_side = side_of_line(a, b, c), d_side = side_of_line(a, b, d), a_side = side_of_line(c, d, a),
            b_side = side_of_line(c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0)
    return true;
  return (c_side == 0 && in_box(a, b, c)) || (d_side == 0 && in_box(a, b, d)) ||
         (a_side == 0 && in_box(c, d, a)) || (b_side == 0 && in_box(c, d, b));
}

/// Whether two segments cross in inner points of both. Exact.
inline bool do_segments_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
  return side_of_line(a, b, c) * side_of_line(a, b, d) < 0 &&
         side_of_line(c, d, a) * side_of_line(c, d, b) < 0;
}

/// Squared distance of the ends of two segments from the other segment: their distance unless they cross.
inline double squared_distance_of_ends(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
  return std::min({squared_distance(a, c, d), squared_distance(b, c, d), squared_distance(c, a, b),
                   squared_distance(d, a, b)});
}

/// Squared distance of two segments, in double precision; zero exactly when they have a point in common.
inline double squared_distance(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
  const double apart = squared_distance_of_ends(a, b, c, d);
  const double reach = std::max({length(b - a), length(d - c)});
  // Segments that cross have an end within half of the longer one of the other segment.
  return apart <= reach * reach && do_segments_meet(a, b, c, d) ? 0 : apart;
}

} // namespace Atlas::internal

#endif
