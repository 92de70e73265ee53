// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_LSCM_SYSTEM_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_LSCM_SYSTEM_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/conformal_system.h>

#include <cmath>

namespace Atlas {

ATLAS_INLINE LSCM_system lscm_system(const Chart& chart, std::span<const LSCM_pin> pins)
{
  for (const LSCM_pin& pin : pins)
    internal::require(pin.vertex < chart.number_of_vertices(), "pins", "must be vertices of the chart");
  const internal::Chart_geometry geometry(chart);
  return internal::lscm_system(internal::Conformal_energy(geometry), pins);
}

ATLAS_INLINE std::vector<LSCM_system::Row> LSCM_system::least_squares_rows() const
{
  const internal::Chart_geometry geometry(*chart);
  std::vector<Row> rows(geometry.number_of_triangles());
  for (Index t = 0; t < rows.size(); ++t) {
    const internal::Planar_triangle shape = geometry.planar(t);
    const double root = std::sqrt(shape.double_area);
    for (int i = 0; i < 3; ++i) {
      rows[t].unknown[i] = unknown[chart->triangles[t][i]];
      rows[t].entry[i] = shape.w[i] / root;
    }
  }
  return rows;
}

} // namespace Atlas

#endif
