// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_FILL_POLYGON_H
#define ATLAS_IMAGE_INTERNAL_FILL_POLYGON_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace Atlas::internal {

/// Calls `plot(x, y)` for every pixel whose centre is inside the polygon by the even-odd rule, in a picture
/// of the given size. The polygon is in pixels, y downwards.
template <typename Plot>
void fill_polygon(std::span<const Point_2> polygon, std::size_t width, std::size_t height, Plot plot)
{
  double low = static_cast<double>(height), high = 0;
  for (const Point_2& p : polygon) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  const auto clamped = [](double value, std::size_t limit) {
    return static_cast<std::size_t>(std::clamp(std::ceil(value - 0.5), 0.0, static_cast<double>(limit)));
  };
  std::vector<double> crossings;
  for (std::size_t y = clamped(low, height); y < clamped(high, height); ++y) {
    const double centre = static_cast<double>(y) + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point_2 &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
      if ((p.y() <= centre) != (q.y() <= centre))
        crossings.push_back(p.x() + (centre - p.y()) / (q.y() - p.y()) * (q.x() - p.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      for (std::size_t x = clamped(crossings[i], width); x < clamped(crossings[i + 1], width); ++x)
        plot(x, y);
  }
}

/// Calls `plot(x, y)` for the pixels along a segment, given in pixels.
template <typename Plot>
void draw_segment(const Point_2& p, const Point_2& q, std::size_t width, std::size_t height, Plot plot)
{
  const double length = std::max(std::abs(q.x() - p.x()), std::abs(q.y() - p.y()));
  if (!(length < 4.0 * static_cast<double>(width + height)))
    return;
  const auto steps = static_cast<std::size_t>(std::ceil(length)) + 1;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(steps);
    const double x = std::floor(p.x() + t * (q.x() - p.x())), y = std::floor(p.y() + t * (q.y() - p.y()));
    if (x >= 0 && y >= 0 && x < static_cast<double>(width) && y < static_cast<double>(height))
      plot(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
  }
}

} // namespace Atlas::internal

#endif
