// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_PLACED_RECTANGLE_H
#define ATLAS_PACKING_INTERNAL_SHAPES_PLACED_RECTANGLE_H

#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <cmath>

namespace Atlas::internal {

/// A rectangle anywhere in the plane.
struct Placed_rectangle
{
  Vec2 middle, along, half; ///< `along` its width, of length 1; half of width and height

  /// How far it reaches from its middle in a direction.
  double extent(Vec2 d) const
  {
    return std::abs(dot(d, along)) * half.x + std::abs(cross(along, d)) * half.y;
  }
};

/// How far two rectangles are apart at least; not above zero: they may overlap.
inline double least_distance(const Placed_rectangle& a, const Placed_rectangle& b)
{
  const Vec2 between = b.middle - a.middle;
  double gap = -HUGE_VAL;
  for (const Vec2 d : {a.along, Vec2{-a.along.y, a.along.x}, b.along, Vec2{-b.along.y, b.along.x}})
    gap = std::max(gap, std::abs(dot(d, between)) - a.extent(d) - b.extent(d));
  return gap;
}

} // namespace Atlas::internal

#endif
