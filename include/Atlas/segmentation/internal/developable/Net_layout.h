// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_LAYOUT_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_LAYOUT_H

#include <Atlas/planar/internal/alignment.h>
#include <Atlas/planar/internal/convex_hull.h>
#include <Atlas/planar/internal/vectors.h>
#include <Atlas/segmentation/internal/developable/Facets.h>

#include <array>
#include <cmath>
#include <vector>

namespace Atlas::internal {

/// A rotation by the unit complex number `turn`, then a translation.
struct Rigid_motion
{
  Vec2 turn{1, 0}, shift{0, 0};

  Vec2 operator()(Vec2 p) const { return rotated(turn, p) + shift; }
  /// First `inner`, then this.
  Rigid_motion after(const Rigid_motion& inner) const
  {
    Vec2 t = rotated(turn, inner.turn);
    t = (1 / length(t)) * t;
    return {t, (*this)(inner.shift)};
  }
};

/// The motion that takes segment (p, q) onto segment (a, b) of the same length: middle onto middle.
inline Rigid_motion motion_of_segment(Vec2 p, Vec2 q, Vec2 a, Vec2 b)
{
  const Vec2 d = q - p, e = b - a;
  Vec2 turn{dot(d, e), cross(d, e)};
  const double l = length(turn);
  turn = l > 0 ? (1 / l) * turn : Vec2{1, 0};
  return {turn, 0.5 * (a + b) - rotated(turn, 0.5 * (p + q))};
}

/// Per halfedge, where it starts in the plane of its facet: coordinates seen from outside.
inline std::vector<Vec2> coordinates_in_facets(const Surface& surface, const Facets& facets)
{
  std::vector<std::array<Vector_3, 2>> axes(facets.count());
  std::vector<Index> origin(facets.count(), no_index);
  std::vector<double> longest(facets.count(), -1);
  for (Index h = 0; h < 3 * facets.of_triangle.size(); ++h) {
    const Index f = facets.of_triangle[h / 3];
    if (const double l = edge_length(surface, h); l > longest[f]) {
      longest[f] = l;
      origin[f] = h;
    }
  }
  for (Index f = 0; f < facets.count(); ++f) {
    const Vector_3 e = surface.point(next_halfedge(origin[f])) - surface.point(origin[f]);
    const Vector_3& n = facets.normal[f];
    Vector_3 x = e - (e * n) * n;
    const double l = std::sqrt(x.squared_length());
    x = l > 0 ? x / l : Vector_3(1, 0, 0);
    axes[f] = {x, CGAL::cross_product(n, x)};
  }
  std::vector<Vec2> local(3 * facets.of_triangle.size());
  for (Index h = 0; h < local.size(); ++h) {
    const Index f = facets.of_triangle[h / 3];
    const Vector_3 d = surface.point(h) - surface.point(origin[f]);
    local[h] = {d * axes[f][0], d * axes[f][1]};
  }
  return local;
}

/// Room that a net takes in the plane, in the pose that it will have on a page.
struct Extent
{
  double rectangle = 0;   ///< area of the bounding rectangle
  double side = 0;        ///< its longer side
  double square = 0;      ///< side of a square around it, at most `side`
  double hull = 0;        ///< area of the convex hull
  double free_square = 0; ///< side of a small square around it, in any of twelve directions

  static constexpr int directions = 12; ///< in which `free_square` is tried, evenly over 90 degrees

  /// About the area of a page that it takes.
  double room() const { return (rectangle + hull) / 2; }
};

/// The directions over 90 degrees but for the first, which is (1, 0).
inline const std::array<Vec2, Extent::directions - 1>& directions_of_extent()
{
  static const auto result = [] {
    std::array<Vec2, Extent::directions - 1> turns;
    for (int k = 1; k < Extent::directions; ++k) {
      const double angle = k * CGAL_PI / (2 * Extent::directions);
      turns[k - 1] = {std::cos(angle), std::sin(angle)};
    }
    return turns;
  }();
  return result;
}

/// What has a dominant direction will lie along it on the page, as packers place it
/// (`Chart_rotation::aligned`); all else as it takes least room.
///
/// \param small  no square smaller than a side of this length is looked for
inline Extent extent_of_hull(const std::vector<Vec2>& hull, const Alignment& border, double small = 0)
{
  const Vec2 e = border.is_dominant() ? border.direction : least_rectangle_direction(hull);
  const Vec2 size = size_along(hull, e);
  const double side = std::max(size.x, size.y);
  Extent result{size.x * size.y, side, side, 0, side};
  if (side > small)
    for (const Vec2& turn : directions_of_extent()) {
      const Vec2 turned = size_along(hull, rotated(turn, e));
      result.free_square = std::min(result.free_square, std::max(turned.x, turned.y));
    }
  if (!border.is_dominant())
    result.square = result.free_square;
  for (std::size_t i = 0; i < hull.size(); ++i)
    result.hull += cross(hull[i] - hull[0], hull[(i + 1) % hull.size()] - hull[0]) / 2;
  return result;
}

/// About the alignment of two borders put side by side: the direction that more of them has. The parts along
/// which they are glued still count, and the chord is not known: 0.
inline Alignment joined(Alignment a, const Alignment& b)
{
  const auto fold = [](Vec2 d) {
    const Vec2 square{d.x * d.x - d.y * d.y, 2 * d.x * d.y};
    return Vec2{square.x * square.x - square.y * square.y, 2 * square.x * square.y};
  };
  constexpr double same_direction = 0.9994; // cosine of four times half a degree
  const bool is_same = dot(fold(a.direction), fold(b.direction)) >= same_direction;
  const double border = a.border + b.border;
  if (a.aligned < b.aligned) {
    const double other = a.aligned;
    a = b;
    a.aligned += is_same ? other : 0;
  } else
    a.aligned += is_same ? b.aligned : 0;
  a.border = border;
  a.chord = 0;
  return a;
}

} // namespace Atlas::internal

#endif
