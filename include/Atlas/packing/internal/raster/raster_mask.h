// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_RASTER_RASTER_MASK_H
#define ATLAS_PACKING_INTERNAL_RASTER_RASTER_MASK_H

#include <Atlas/core/Kernel.h>
#include <Atlas/packing/internal/raster/Raster_page.h>
#include <Atlas/packing/internal/shapes/Packing_shape.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// The corners of a box.
struct Corners
{
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
};

/// The box of points after they have been turned, scaled and moved: of a point p, `shift + turn p`.
inline Corners box_of(const std::vector<Vec2>& points, Vec2 turn, Vec2 shift = {})
{
  Corners box;
  for (const Vec2& p : points) {
    const Vec2 q = shift + rotated(turn, p);
    box.low = {std::min(box.low.x, q.x), std::min(box.low.y, q.y)};
    box.high = {std::max(box.high.x, q.x), std::max(box.high.y, q.y)};
  }
  return box;
}

/// Distances from a grown shape at the centres of pixels, and which pixels are nearer than 0.
struct Pixel_distances
{
  double x0 = 0, y0 = 0; ///< of the first pixel, in pixels from the shape's centre
  Index nx = 0, ny = 0;
  std::vector<float> distances; ///< row by row
  Index left = 0, right = 0, bottom = 0, top = 0;

  float at(Index x, Index y) const
  {
    return x < nx && y < ny ? distances[std::size_t(y) * nx + x] : HUGE_VALF;
  }
};

/// The distances of the pixels within the box of the grown shape and a ring around it. A shape that is
/// smaller than a pixel and between the centres takes the nearest.
inline Pixel_distances pixel_distances(const Packing_shape& shape, double scale, Vec2 turn, double grow,
                                       double pixel)
{
  const Corners box = box_of(shape.hull, scale * turn);
  const double around = std::max(grow, 0.0) + Raster_mask::ring_width * pixel;
  Pixel_distances result;
  result.x0 = std::floor((box.low.x - around) / pixel);
  result.y0 = std::floor((box.low.y - around) / pixel);
  const Index nx = result.nx = static_cast<Index>(std::ceil((box.high.x + around) / pixel) - result.x0);
  const Index ny = result.ny = static_cast<Index>(std::ceil((box.high.y + around) / pixel) - result.y0);
  result.distances.resize(std::size_t(nx) * ny);
  const Vec2 back{turn.x / scale, -turn.y / scale};
  const Vec2 step = rotated(back, {pixel, 0});
  Index left = nx, right = 0, bottom = ny, top = 0, deepest = 0;
  for (Index j = 0; j < ny; ++j) {
    Vec2 p = rotated(back, pixel * Vec2{result.x0 + 0.5, result.y0 + 0.5 + j});
    for (Index i = 0; i < nx; ++i, p = p + step) {
      const float d = static_cast<float>(shape.field.estimate(p) * scale - grow);
      result.distances[std::size_t(j) * nx + i] = d;
      if (d < result.distances[deepest])
        deepest = j * nx + i;
      if (d < 0) {
        left = std::min(left, i), right = std::max(right, i);
        bottom = std::min(bottom, j), top = std::max(top, j);
      }
    }
  }
  if (left > right) {
    result.distances[deepest] = -1;
    left = right = deepest % nx;
    bottom = top = deepest / nx;
  }
  result.left = left, result.right = right, result.bottom = bottom, result.top = top;
  return result;
}

/// The pixels of a grown, scaled and turned shape.
///
/// \param grow   every pixel whose centre is nearer than that is in, in texels
/// \param pixel  its side in texels
inline void make_mask(const Packing_shape& shape, double scale, Vec2 turn, double grow, double pixel,
                      Raster_mask& mask, std::uint64_t& work)
{
  constexpr Index ring = Raster_mask::ring_width;
  const Pixel_distances pixels = pixel_distances(shape, scale, turn, grow, pixel);
  work += 10 * std::uint64_t(pixels.nx) * pixels.ny;
  mask.width = pixels.right - pixels.left + 1;
  mask.height = pixels.top - pixels.bottom + 1;
  mask.origin = {-pixels.x0 - pixels.left, -pixels.y0 - pixels.bottom};
  mask.runs.clear();
  mask.ring_pixels = 0;
  const Index words = mask.ring_words();
  mask.ring.assign(std::size_t(words) * (mask.height + 2 * ring), 0);
  for (Index j = 0; j < mask.height + 2 * ring; ++j) {
    Index begin = 0;
    bool is_in = false;
    for (Index i = 0; i < mask.width + 2 * ring; ++i) {
      const float d = pixels.at(pixels.left + i - ring, pixels.bottom + j - ring);
      if (d >= 0 && d < 1.6 * pixel) {
        mask.ring[std::size_t(j) * words + i / 64] |= std::uint64_t(1) << (i % 64);
        ++mask.ring_pixels;
      }
      if (d < 0 && !is_in)
        begin = i;
      if (d >= 0 && is_in)
        mask.runs.push_back({j - ring, begin - ring, i - ring});
      is_in = d < 0;
    }
  }
  std::sort(mask.runs.begin(), mask.runs.end(), [](const auto& a, const auto& b) {
    const Index l = a.end - a.begin, m = b.end - b.begin;
    return l != m ? l > m : a.row != b.row ? a.row < b.row : a.begin < b.begin;
  });
}

} // namespace Atlas::internal

#endif
