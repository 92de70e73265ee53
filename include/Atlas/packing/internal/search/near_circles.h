// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SEARCH_NEAR_CIRCLES_H
#define ATLAS_PACKING_INTERNAL_SEARCH_NEAR_CIRCLES_H

#include <Atlas/core/Kernel.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The pairs of circles that meet, in order, but for pairs of circles from number `movable` on: sweeps to the
/// right, in horizontal strips of about the height of a circle, up to `height`. A pair is found in the lowest
/// strip that has both. Near-linear unless most circles are much larger than the others.
inline std::vector<std::pair<Index, Index>> near_circles(const std::vector<Vec2>& centres,
                                                         const std::vector<double>& radii, double height,
                                                         std::size_t movable)
{
  const auto n = static_cast<Index>(centres.size());
  const double strips = std::ceil(std::sqrt(n)), per_texel = strips / height;
  const auto strip_at = [&](double y) {
    return static_cast<Index>(std::clamp(y * per_texel, 0.0, strips - 1));
  };
  const auto lowest = [&](Index i) { return strip_at(centres[i].y - radii[i]); };
  std::vector<std::vector<std::pair<double, Index>>> by_left(static_cast<std::size_t>(strips));
  for (Index i = 0; i < n; ++i)
    for (Index k = lowest(i); k <= strip_at(centres[i].y + radii[i]); ++k)
      by_left[k].emplace_back(centres[i].x - radii[i], i);
  std::vector<std::pair<Index, Index>> result;
  for (Index k = 0; k < by_left.size(); ++k) {
    std::vector<std::pair<double, Index>>& strip = by_left[k];
    std::sort(strip.begin(), strip.end());
    for (std::size_t a = 0; a < strip.size(); ++a) {
      const Index i = strip[a].second;
      const double right = centres[i].x + radii[i];
      for (std::size_t b = a + 1; b < strip.size() && strip[b].first <= right; ++b) {
        const Index j = strip[b].second;
        const Vec2 d = centres[i] - centres[j];
        const double r = radii[i] + radii[j];
        if (dot(d, d) <= r * r && std::max(lowest(i), lowest(j)) == k && std::min(i, j) < movable)
          result.emplace_back(std::min(i, j), std::max(i, j));
      }
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

} // namespace Atlas::internal

#endif
