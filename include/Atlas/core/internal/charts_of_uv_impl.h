// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_CHARTS_OF_UV_IMPL_H
#define ATLAS_CORE_INTERNAL_CHARTS_OF_UV_IMPL_H

#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/halfedges.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas {

ATLAS_INLINE Segmentation charts_of_uv(const Surface& surface, std::span<const Point_2> uv)
{
  const std::size_t n = surface.number_of_triangles();
  const auto at = [&](Index h) -> const Point_2& { return uv[surface.corner[h]]; };
  const auto is_finite = [&](Index h) { return std::isfinite(at(h).x()) && std::isfinite(at(h).y()); };
  Segmentation result{{}, std::vector<std::uint8_t>(3 * n, 0), 0};
  for (Index h = 0; h < 3 * n; ++h) {
    const Index o = surface.opposite[h];
    result.cut[h] = o != no_index && (at(h) != at(next_halfedge(o)) || at(next_halfedge(h)) != at(o));
  }
  const auto has_coordinates = [&](Index t) {
    return is_finite(3 * t) && is_finite(3 * t + 1) && is_finite(3 * t + 2);
  };
  internal::Components charts = internal::connected_components(surface.opposite, has_coordinates,
                                                               [&](Index h) { return !result.cut[h]; });
  result.chart = std::move(charts.of_triangle);
  result.number_of_charts = charts.count;
  return result;
}

} // namespace Atlas

#endif
