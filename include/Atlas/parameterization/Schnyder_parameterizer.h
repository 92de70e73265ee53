// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_SCHNYDER_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_SCHNYDER_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/parameterization/internal/fixed_border/schnyder_realizer.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas {

/// \brief A straight-line drawing of the chart on an integer grid: Schnyder 1990.
///
/// Built without floating-point arithmetic from the connectivity alone, so one-to-one for every disc, also
/// where Tutte's map shrinks below double precision. Shapes are as bad as can be: it is the last start for an
/// optimiser. Scaled by a power of two, to the chart's area within a factor of 4. Linear time but for the
/// sorting of edges.
class Schnyder_parameterizer
{
public:
  /// \return `valid`, or `not_a_disc`; the coordinates are then all zero
  Chart_status parameterize(Chart& chart, const Execution&) const
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    internal::Injectivity_checker checker(chart);
    if (!topology(chart).is_disc())
      return Chart_status::not_a_disc;
    // One vertex outside, joined to the whole border, makes a sphere of the disc.
    std::vector<std::array<Index, 3>> triangles = chart.triangles;
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
};

} // namespace Atlas

#endif
