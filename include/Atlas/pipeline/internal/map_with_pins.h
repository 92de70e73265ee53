// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_MAP_WITH_PINS_H
#define ATLAS_PIPELINE_INTERNAL_MAP_WITH_PINS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/distortion/Descent.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <cmath>
#include <span>
#include <vector>

namespace Atlas::internal {

/// Lowers the symmetric Dirichlet energy of a chart without flips while the pins stay. The scale of the map
/// is the pins', so the chart in space is scaled to it.
inline void optimize_between_pins(Chart& chart, std::span<const LSCM_pin> pins, const Execution& execution)
{
  const double scale = std::sqrt(std::abs(area_uv(chart)) / area_3d(chart));
  if (!(scale > 0) || !std::isfinite(scale))
    return;
  Chart scaled = chart;
  for (Point_3& p : scaled.points)
    p = Point_3(scale * p.x(), scale * p.y(), scale * p.z());
  const Chart_geometry geometry(scaled);
  const Distortion_options options;
  Descent<Symmetric_dirichlet> descent(Symmetric_dirichlet(), options);
  typename Descent<Symmetric_dirichlet>::Minimizer minimizer(geometry, coordinates_of(geometry),
                                                             descent.mean());
  if (minimizer.has_flip() || !minimizer.is_border_simple())
    return;
  for (const LSCM_pin& pin : pins)
    minimizer.keep(pin.vertex);
  (void)descent(minimizer, 0, execution);
  store_coordinates(geometry, minimizer.coordinates(), 1, chart);
}

/// \brief The least squares conformal map with these pins, of which at least two are at different places.
/// \param is_optimized  whether distortion is lowered then
inline Chart_status map_with_pins(Chart& chart, const std::vector<LSCM_pin>& pins, bool is_optimized,
                                  const Execution& execution)
{
  const Chart_status status = LSCM_parameterizer<>(Eigen_LSCM_traits(pins)).parameterize(chart, execution);
  if (status == Chart_status::valid && is_optimized)
    optimize_between_pins(chart, pins, execution);
  return status;
}

} // namespace Atlas::internal

#endif
