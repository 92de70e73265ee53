// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_NORMALIZE_H
#define ATLAS_PIPELINE_INTERNAL_NORMALIZE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/area_in_space.h>
#include <Atlas/core/internal/bounding_box.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace Atlas::internal {

/// What `normalize()` found.
struct Normalization
{
  double unit = 1;                ///< the model's unit over the unit used now
  std::vector<Point_3> positions; ///< in the unit used now, not rounded
};

/// The length of the shortest edge that has one; infinite if there is none.
inline double shortest_edge(const Surface& surface)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (Index h = 0; h < 3 * surface.number_of_triangles(); ++h)
    if (const double length = edge_length(surface, h); length > 0)
      shortest = std::min(shortest, length);
  return shortest;
}

/// Rounds positions in units of half the largest side to a grid that is finer than what matters to charts,
/// but far coarser than the last digits, which change when a model is scaled or moved. What is computed from
/// them is the same to the last bit then: comparisons of what is equal but for rounding, and trial packings,
/// which hang on the last digits of all coordinates, have one outcome. Where edges are short for that size,
/// as in specks beside something large, the grid is as much finer. Positions stay as they are if a triangle
/// that has an area would have none.
inline void round_positions(Surface& surface)
{
  constexpr int bits = 29, bits_of_edges = 12;
  constexpr double threshold = 0.50001; // no half: values of few digits may lie in the middle of two places
  const double edge = shortest_edge(surface);
  if (!std::isfinite(edge))
    return;
  const int exponent = std::min(-bits, std::ilogb(edge / std::numbers::phi) - bits_of_edges);
  const auto round = [&](double x) {
    const double places = std::floor(std::ldexp(std::abs(x), -exponent) + threshold);
    return std::copysign(std::ldexp(places, exponent), x) + 0.0; // no -0
  };
  std::vector<Point_3> rounded;
  rounded.reserve(surface.points.size());
  for (const Point_3& p : surface.points)
    rounded.emplace_back(round(p.x()), round(p.y()), round(p.z()));
  const auto is_flat = [](const std::vector<Point_3>& points, const std::array<Index, 3>& triangle) {
    return !has_area(points[triangle[0]], points[triangle[1]], points[triangle[2]]);
  };
  const auto is_flattened = [&](const auto& triangle) {
    return is_flat(rounded, triangle) && !is_flat(surface.points, triangle);
  };
  if (std::none_of(surface.triangles.begin(), surface.triangles.end(), is_flattened))
    surface.points = std::move(rounded);
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
