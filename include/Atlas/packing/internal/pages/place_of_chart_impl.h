// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PLACE_OF_CHART_IMPL_H
#define ATLAS_PACKING_INTERNAL_PAGES_PLACE_OF_CHART_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/packing/pack_charts.h>

#include <CGAL/Bbox_2.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>

namespace Atlas {

namespace internal {

/// What a corner may be off by, relative to the extent of a chart, to have the place of another.
inline constexpr double similarity_tolerance = 1e-6;

/// Calls `body(p, q)` for each corner of a chart: its point, and the other one.
template <typename Body>
void for_corners(const Surface& surface, const Chart& chart, std::span<const Point_2> uv, Body body)
{
  for (std::size_t t = 0; t < chart.triangles.size(); ++t)
    for (Index i = 0; i < 3; ++i) {
      const Point_2& p = chart.uv[chart.triangles[t][i]];
      const Point_2& q = uv[surface.corner[3 * chart.source[t] + i]];
      body(std::complex(p.x(), p.y()), std::complex(q.x(), q.y()));
    }
}

} // namespace internal

ATLAS_INLINE std::optional<Placement> place_of_chart(const Surface& surface, const Chart& chart,
                                                     std::span<const Point_2> uv)
{
  if (uv.empty() || chart.triangles.empty())
    return std::nullopt;
  const auto n = static_cast<double>(3 * chart.triangles.size());
  std::complex<double> mean_p = 0, mean_q = 0, product = 0;
  internal::for_corners(surface, chart, uv, [&](auto p, auto q) { mean_p += p / n, mean_q += q / n; });
  double square = 0;
  internal::for_corners(surface, chart, uv, [&](auto p, auto q) {
    product += std::conj(p - mean_p) * (q - mean_q);
    square += std::norm(p - mean_p);
  });
  if (!(square > 0) || !std::isfinite(std::abs(product)) || product == 0.0)
    return std::nullopt;
  const std::complex<double> factor = product / square, shift = mean_q - factor * mean_p;
  double farthest = 0, error = 0;
  internal::for_corners(surface, chart, uv, [&](auto p, auto q) {
    farthest = std::max(farthest, std::abs(q - mean_q));
    error = std::max(error, std::abs(factor * (p - mean_p) - (q - mean_q)));
  });
  if (!(error <= internal::similarity_tolerance * farthest))
    return std::nullopt;
  return Placement{factor.real(), factor.imag(), shift.real(), shift.imag()};
}

ATLAS_INLINE std::optional<Placement> place_on_tile(const Placement& place, const Chart& chart, double side)
{
  CGAL::Bbox_2 box;
  for (const Point_2& p : chart.uv)
    box += place(p).bbox();
  const double u = std::floor((box.xmin() + box.xmax()) / 2), v = std::floor((box.ymin() + box.ymax()) / 2);
  constexpr double columns = 10, rows = 900; // of tiles; the last row lacks its last tile
  if (!(u >= 0 && u < columns && v >= 0 && v < rows && u + columns * v < max_pages))
    return std::nullopt;
  constexpr double slack = 1e-6; // of rounding
  if (!(box.xmin() >= u - slack && box.xmax() <= u + 1 + slack && box.ymin() >= v - slack &&
        box.ymax() <= v + 1 + slack))
    return std::nullopt; // what is packed has to lie on its page
  return Placement{side * place.a,
                   side * place.b,
                   side * (place.x - u),
                   side * (place.y - v),
                   static_cast<Index>(u + columns * v),
                   place.is_mirrored};
}

} // namespace Atlas

#endif
