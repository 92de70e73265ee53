// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_MAP_WITH_PINS_H
#define ATLAS_PIPELINE_INTERNAL_MAP_WITH_PINS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/pins.h>
#include <Atlas/parameterization/internal/distortion/Descent.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Minimises the symmetric Dirichlet energy of one chart.
using Pinned_descent = Descent<Symmetric_dirichlet>;

/// The chart in space as large as pins ask for.
inline Chart scaled_in_space(const Chart& chart, double scale)
{
  Chart scaled = chart;
  for (Point_3& p : scaled.points)
    p = Point_3(scale * p.x(), scale * p.y(), scale * p.z());
  return scaled;
}

/// Lowers the symmetric Dirichlet energy of a chart while the pins stay. Its own area would not do as the
/// scale: LSCM is large between some pins, and small at others.
/// \param scale  of the chart in space
/// \return false for a chart with flips or a border that meets itself, which is left alone
inline bool optimize_between_pins(Chart& chart, std::span<const LSCM_pin> pins, double scale,
                                  const Execution& execution)
{
  const Chart scaled = scaled_in_space(chart, scale);
  const Chart_geometry geometry(scaled);
  const Distortion_options options;
  Pinned_descent descent(Symmetric_dirichlet(), options);
  Pinned_descent::Minimizer minimizer(geometry, coordinates_of(geometry), descent.mean());
  if (minimizer.has_flip() || !minimizer.is_border_simple())
    return false;
  for (const LSCM_pin& pin : pins)
    minimizer.keep(pin.vertex);
  (void)descent(minimizer, 0, execution);
  store_coordinates(geometry, minimizer.coordinates(), 1, chart);
  return true;
}

/// Moves a chart to where its pinned vertices are nearest to their places, as large as these are apart.
/// \return the scale
inline double lay_at_pins(Chart& chart, std::span<const LSCM_pin> pins)
{
  const double count = static_cast<double>(pins.size());
  Complex from = 0, to = 0, turn = 0;
  for (const LSCM_pin& pin : pins) {
    from += Complex(chart.uv[pin.vertex].x(), chart.uv[pin.vertex].y()) / count;
    to += Complex(pin.uv.x(), pin.uv.y()) / count;
  }
  double squares_from = 0, squares_to = 0;
  for (const LSCM_pin& pin : pins) {
    const Complex a = Complex(chart.uv[pin.vertex].x(), chart.uv[pin.vertex].y()) - from,
                  b = Complex(pin.uv.x(), pin.uv.y()) - to;
    turn += std::conj(a) * b;
    squares_from += std::norm(a);
    squares_to += std::norm(b);
  }
  const double scale = std::sqrt(squares_to / squares_from);
  turn *= std::abs(turn) > 0 ? scale / std::abs(turn) : 0;
  for (Point_2& p : chart.uv) {
    const Complex z = turn * (Complex(p.x(), p.y()) - from) + to;
    p = Point_2(z.real(), z.imag());
  }
  return scale;
}

/// \brief Draws the pinned vertices of a chart without flips to their places by springs that become stiffer,
/// never over a flip or a contact of the border.
///
/// Finds maps where LSCM folds, and costs some tens of Newton steps.
inline void drag_to_pins(Chart& chart, std::span<const LSCM_pin> pins, double scale,
                         const Execution& execution)
{
  constexpr double softest = 1, stiffest = 1e9, factor = 10, tolerance = 1e-3; // of the area's own stiffness
  constexpr std::size_t steps = 30;
  const Chart scaled = scaled_in_space(chart, scale);
  const Chart_geometry geometry(scaled);
  const Distortion_options options;
  const Pinned_descent descent(Symmetric_dirichlet(), options);
  Pinned_descent::Minimizer minimizer(geometry, coordinates_of(geometry), descent.mean());
  if (minimizer.has_flip() || !minimizer.is_border_simple())
    return;
  std::vector<std::pair<Index, Complex>> places;
  for (const LSCM_pin& pin : pins)
    places.emplace_back(pin.vertex, image(geometry, pin));
  for (double stiffness = softest; stiffness <= stiffest && execution.proceed(); stiffness *= factor) {
    minimizer.pull(places, stiffness);
    (void)minimizer.minimize(steps, tolerance, 0, execution);
  }
  store_coordinates(geometry, minimizer.coordinates(), 1, chart);
  for (const LSCM_pin& pin : pins)
    chart.uv[pin.vertex] = pin.uv;
}

/// \brief The least squares conformal map with these pins, of which at least two are at different places.
/// \param chart         has a map without flips, of the same area as in space
/// \param is_optimized  whether distortion is lowered then; where that map folds, the chart is drawn to the
/// pins instead
inline Chart_status map_with_pins(Chart& chart, const std::vector<LSCM_pin>& pins, bool is_optimized,
                                  const Execution& execution)
{
  Chart flat = chart;
  const Chart_status status = LSCM_parameterizer<>(Eigen_LSCM_traits(pins)).parameterize(chart, execution);
  const double scale = lay_at_pins(flat, pins);
  if (!is_optimized || !(scale > 0) || !std::isfinite(scale) ||
      (status == Chart_status::valid && optimize_between_pins(chart, pins, scale, execution)))
    return status;
  drag_to_pins(flat, pins, scale, execution);
  (void)optimize_between_pins(flat, pins, scale, execution);
  chart = std::move(flat);
  return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::valid;
}

} // namespace Atlas::internal

#endif
