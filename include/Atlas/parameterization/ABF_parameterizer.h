// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_ABF_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_ABF_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/parameterization/internal/angles/Angle_flattener.h>
#include <Atlas/parameterization/internal/angles/angle_layout.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <array>
#include <cmath>
#include <vector>

namespace Atlas {

/// \brief What angle-based flattening found out on the way.
struct ABF_record
{
  std::vector<std::array<double, 3>> angles; ///< per triangle its angles in the plane, in radians
  int iterations = 0;
  double energy = 0; ///< sum over the corners of (angle / angle asked for - 1)^2
  double violation =
      0; ///< the largest amount by which the angles around an inner vertex miss a condition, in
         ///< radians, or as the logarithm of how much a wheel of triangles does not close up
  bool has_converged = true; ///< `false`: the limit of iterations came first
};

/// \brief Angle-based flattening: ABF++ of Sheffer, Levy, Mogilnitsky and Bogomyakov, 2005.
///
/// The unknowns are the angles of the flattened triangles: as near as possible, relative to their size, to
/// those in space, subject to the conditions under which triangles with these angles make a planar
/// triangulation. Newton's method, each step a system in the inner vertices only; coordinates then follow
/// from the angles by least squares (section 2.2 of the paper), so that errors do not pile up. The border is
/// free. Against the paper: the third condition is taken as a logarithm (Zayer, Levy and Seidel 2007), and
/// where an angle would fall below half of what is asked for, a barrier takes the place of the paper's
/// repeated change of weights.
///
/// Angles are positive, so no triangle flips as long as the conditions can be met and double precision holds
/// the sizes that go with them: on deep tubes triangles shrink below it. Triangles without area count as if
/// they were very thin. The border may overlap: see `Bijective_parameterizer`. The area in the plane is that
/// in space.
///
/// Cost: 4 to 10 sparse factorizations of order two times the number of vertices on usual charts, and one
/// complex one.
class ABF_parameterizer
{
public:
  static constexpr int default_max_iterations = 100;
  /// The iteration ends when no angle changes by more than this part of itself, and no condition is missed
  /// by more than `condition_tolerance`.
  static constexpr double angle_tolerance = 1e-6;
  static constexpr double condition_tolerance = 1e-10;

  explicit ABF_parameterizer(int max_iterations = default_max_iterations) : max_iterations_(max_iterations) {}

  /// \return `not_a_disc` if the chart is none; `solver_failed` without finite solution. The coordinates are
  /// all zero then.
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    ABF_record record;
    return parameterize(chart, execution, record);
  }

  Chart_status parameterize(Chart& chart, const Execution& execution, ABF_record& record) const
  {
    record = {};
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    if (!topology(chart).is_disc())
      return Chart_status::not_a_disc;
    const internal::Chart_geometry geometry(chart);
    const std::array<Index, 2> pins = internal::far_apart_vertices(geometry);
    for (const double least_height : least_heights) {
      const std::vector<internal::Triangle_angles> angles =
          find_angles(geometry, least_height, execution, record);
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

private:
  /// Triangles are taken to have this height at least, as a part of their longest edge. A chart that is
  /// nothing but such triangles may need more of it for a layout in double precision.
  static constexpr double least_heights[] = {internal::least_relative_height, 1e-6, 1e-3};

  std::vector<internal::Triangle_angles> find_angles(const internal::Chart_geometry& geometry,
                                                     double least_height, const Execution& execution,
                                                     ABF_record& record) const
  {
    internal::Angle_flattener flattener(geometry, least_height);
    internal::Vertex_block_cholesky system(geometry.chart());
    record = {};
    record.has_converged = false;
    double change = 0;
    while (!record.has_converged && std::isfinite(change) && record.iterations < max_iterations_ &&
           execution.proceed()) {
      change = flattener.step(system);
      ++record.iterations;
      record.has_converged = change <= angle_tolerance && flattener.violation() <= condition_tolerance;
    }
    record.energy = flattener.energy();
    record.violation = flattener.violation();
    for (const internal::Triangle_angles& a : flattener.angles())
      record.angles.push_back({a[0], a[1], a[2]});
    return flattener.angles();
  }

  int max_iterations_;
};

} // namespace Atlas

#endif
