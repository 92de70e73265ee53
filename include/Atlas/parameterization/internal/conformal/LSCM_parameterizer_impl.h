// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_LSCM_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_LSCM_PARAMETERIZER_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_system.h>
#include <Atlas/parameterization/internal/conformal/pins.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

namespace Atlas::internal {

ATLAS_INLINE Chart_status lscm(Chart& chart, std::vector<LSCM_pin> pins, LSCM_solver_interface& solver,
                               const Execution& execution, LSCM_record& record)
{
  check_chart(chart);
  const bool has_user_pins = !pins.empty();
  if (has_user_pins)
    check_pins(pins, chart.number_of_vertices());
  chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
  record = {};
  if (chart.triangles.empty())
    return Chart_status::not_a_disc;
  const Chart_geometry geometry(chart);
  const Conformal_energy energy(geometry);
  record.pins = has_user_pins ? std::move(pins) : default_pins(geometry);
  std::vector<Complex> u = pinned(geometry, record.pins);
  const LSCM_system system = lscm_system(energy, record.pins);
  if (system.size() > 0 && !(solver.factorize(system, execution) &&
                             minimize_energy(energy, system, solver, execution, u, record.residual)))
    return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::solver_failed;
  const double area = area_in_plane(chart, u);
  record.energy = area > 0 ? energy.value(u) / area : 0;
  store_coordinates(geometry, u, has_user_pins ? 1 : density_correction(geometry, u), chart);
  return Chart_status::valid;
}

} // namespace Atlas::internal

#endif
