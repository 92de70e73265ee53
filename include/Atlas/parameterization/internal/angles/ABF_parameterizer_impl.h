// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_ANGLES_ABF_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_ANGLES_ABF_PARAMETERIZER_IMPL_H

#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/ABF_parameterizer.h>
#include <Atlas/parameterization/internal/angles/Angle_flattener.h>
#include <Atlas/parameterization/internal/angles/angle_layout.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <array>
#include <cmath>
#include <vector>

namespace Atlas {

namespace internal {

/// Triangles are taken to have this height at least, as a part of their longest edge. A chart that is nothing
/// but such triangles may need more of it for a layout in double precision.
inline constexpr double least_heights[] = {least_relative_height, 1e-6, 1e-3};

inline std::vector<Triangle_angles> find_angles(const Chart_geometry& geometry, double least_height,
                                                int max_iterations, const Execution& execution,
                                                ABF_record& record)
{
  Angle_flattener flattener(geometry, least_height);
  Vertex_block_cholesky system(geometry.chart());
  record = {};
  record.has_converged = false;
  double change = 0;
  while (!record.has_converged && std::isfinite(change) && record.iterations < max_iterations &&
         execution.proceed()) {
    change = flattener.step(system);
    ++record.iterations;
    record.has_converged = change <= ABF_parameterizer::angle_tolerance &&
                           flattener.violation() <= ABF_parameterizer::condition_tolerance;
  }
  record.energy = flattener.energy();
  record.violation = flattener.violation();
  for (const Triangle_angles& a : flattener.angles())
    record.angles.push_back({a[0], a[1], a[2]});
  return flattener.angles();
}

} // namespace internal

ATLAS_INLINE ABF_parameterizer::ABF_parameterizer(int max_iterations) : max_iterations_(max_iterations)
{
  internal::require(max_iterations >= 1, "max_iterations", "must be at least 1");
}

ATLAS_INLINE Chart_status ABF_parameterizer::parameterize(Chart& chart, const Execution& execution) const
{
  ABF_record record;
  return parameterize(chart, execution, record);
}

ATLAS_INLINE Chart_status ABF_parameterizer::parameterize(Chart& chart, const Execution& execution,
                                                          ABF_record& record) const
{
  internal::check_chart(chart);
  record = {};
  chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
  if (!topology(chart).is_disc())
    return Chart_status::not_a_disc;
  const internal::Chart_geometry geometry(chart);
  const std::array<Index, 2> pins = internal::far_apart_vertices(geometry);
  for (const double least_height : internal::least_heights) {
    const std::vector<internal::Triangle_angles> angles =
        internal::find_angles(geometry, least_height, max_iterations_, execution, record);
    if (execution.is_cancelled())
      return Chart_status::cancelled;
    std::vector<internal::Complex> u(chart.number_of_vertices());
    u[pins[1]] = 1;
    if (internal::Angle_layout(chart, angles).solve(pins, u)) {
      internal::store_coordinates(geometry, u, internal::density_correction(geometry, u), chart);
      return Chart_status::valid;
    }
  }
  return Chart_status::solver_failed;
}

} // namespace Atlas

#endif
