// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_NORMALIZE_H
#define ATLAS_PIPELINE_INTERNAL_NORMALIZE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/bounding_box.h>
#include <Atlas/measure/distortion.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace Atlas::internal {

/// What `normalize()` found.
struct Normalization
{
  double unit = 1;                ///< the model's unit over the unit used now
  std::vector<Point_3> positions; ///< in the unit used now, not rounded
};

/// Rounds positions in units of half the largest side to a grid that is finer than what matters to charts,
/// but far coarser than the last digits, which change when a model is scaled or moved. What is computed from
/// them is the same to the last bit then: comparisons of what is equal but for rounding, and trial packings,
/// which hang on the last digits of all coordinates, have one outcome. Where there is little area for that
/// size, in specks far apart, the grid is as much finer.
inline void round_positions(Surface& surface)
{
  constexpr int bits = 29, bits_of_area = 27;
  constexpr double threshold = 0.50001; // no half: values of few digits may lie in the middle of two places
  const double side = std::sqrt(area_3d(surface));
  if (!(side > 0) || !std::isfinite(side))
    return;
  const int exponent = std::min(-bits, std::ilogb(side / std::numbers::phi) - bits_of_area);
  const auto round = [&](double x) {
    const double places = std::floor(std::ldexp(std::abs(x), -exponent) + threshold);
    return std::copysign(std::ldexp(places, exponent), x) + 0.0; // no -0
  };
  for (Point_3& p : surface.points)
    p = Point_3(round(p.x()), round(p.y()), round(p.z()));
}

/// Moves the model to the origin, scales it to unit size, so that no product of coordinates overflows, and
/// rounds the positions: models that are equal but for scale and place become one.
inline Normalization normalize(Surface& surface)
{
  const Bounding_box box = bounding_box(surface);
  if (!(box.half_side > 0) || !std::isfinite(box.half_side))
    return {1, surface.points};
  // First by a power of two: quotients of tiny numbers lose digits.
  const int exponent = std::ilogb(box.half_side);
  const double half_side = std::ldexp(box.half_side, -exponent);
  const auto coordinate = [&](const Point_3& p, int i) {
    return (std::ldexp(p[i], -exponent) - std::ldexp(box.center[i], -exponent)) / half_side;
  };
  for (Point_3& p : surface.points)
    p = Point_3(coordinate(p, 0), coordinate(p, 1), coordinate(p, 2));
  Normalization result{box.half_side, surface.points};
  round_positions(surface);
  return result;
}

} // namespace Atlas::internal

#endif
