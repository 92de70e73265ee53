// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_NORMALIZE_H
#define ATLAS_PIPELINE_INTERNAL_NORMALIZE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/bounding_box.h>

#include <cmath>
#include <vector>

namespace Atlas::internal {

/// What `normalize()` found.
struct Normalization
{
  double unit = 1;         ///< the model's unit over the unit used now
  double largest_side = 0; ///< of the bounding box, in the unit used now
};

/// Moves the model to the origin and scales it by a power of two to about unit size, so that no product of
/// coordinates overflows or loses digits that the input has.
inline Normalization normalize(Surface& surface)
{
  const Bounding_box box = bounding_box(surface);
  if (!(box.half_side > 0) || !std::isfinite(box.half_side))
    return {};
  const int exponent = std::ilogb(box.half_side);
  const auto coordinate = [&](const Point_3& p, int i) {
    return std::ldexp(p[i], -exponent) - std::ldexp(box.center[i], -exponent);
  };
  for (Point_3& p : surface.points)
    p = Point_3(coordinate(p, 0), coordinate(p, 1), coordinate(p, 2));
  return {std::ldexp(1.0, exponent), std::ldexp(2 * box.half_side, -exponent)};
}

/// The positions in units of `largest_side`, on a grid that is finer than what matters to charts, but far
/// coarser than the last digits, which change when a model is scaled. Segmentation compares many things that
/// are equal but for these, on symmetric models above all.
inline std::vector<Point_3> positions_on_grid(const Surface& surface, double largest_side)
{
  constexpr double cells = 1 << 30;
  if (!(largest_side > 0) || !std::isfinite(largest_side))
    return surface.points;
  std::vector<Point_3> result;
  result.reserve(surface.points.size());
  const auto round = [&](double x) { return std::round(x / largest_side * cells) / cells; };
  for (const Point_3& p : surface.points)
    result.emplace_back(round(p.x()), round(p.y()), round(p.z()));
  return result;
}

} // namespace Atlas::internal

#endif
