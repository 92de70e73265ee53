// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_SCHNYDER_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_SCHNYDER_PARAMETERIZER_IMPL_H

#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/internal/fixed_border/schnyder_realizer.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas {

ATLAS_INLINE Chart_status Schnyder_parameterizer::parameterize(Chart& chart, const Execution&) const
{
  internal::check_chart(chart);
  chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
  if (!topology(chart).is_disc())
    return Chart_status::not_a_disc;
  // One vertex outside, joined to the whole border, makes a sphere of the disc.
  std::vector<std::array<Index, 3>> triangles = chart.triangles;
  const internal::Injectivity_checker checker(chart);
  const std::vector<Index>& border = checker.borders().front();
  const Index outside = static_cast<Index>(chart.number_of_vertices());
  const Index outer = static_cast<Index>(triangles.size());
  for (std::size_t i = 0; i < border.size(); ++i)
    triangles.push_back({border[(i + 1) % border.size()], border[i], outside});
  std::vector<internal::Complex> u;
  if (!internal::Schnyder_realizer(triangles, chart.number_of_vertices() + 1, outer).draw(u))
    return Chart_status::not_a_disc;
  u.pop_back();
  const internal::Chart_geometry geometry(chart);
  const double scale = internal::density_correction(geometry, u);
  internal::store_coordinates(geometry, u, scale > 0 ? std::exp2(std::round(std::log2(scale))) : 1, chart);
  return Chart_status::valid;
}

} // namespace Atlas

#endif
