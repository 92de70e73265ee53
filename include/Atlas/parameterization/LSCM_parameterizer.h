// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_LSCM_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_LSCM_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief What LSCM found out on the way.
struct LSCM_record
{
  std::vector<LSCM_pin> pins; ///< in the unit of the model, before the final scaling
  double energy = 0;          ///< conformal energy over area of the chart in the plane; 0 is conformal
  double residual = 0;        ///< largest component of the last refinement step over the chart's extent
};

/// \brief Least squares conformal maps: Levy, Petitjean, Ray and Maillot, 2002, section 2.
///
/// Minimises the paper's C(U) = sum over the triangles of |W1 U1 + W2 U2 + W3 U3|^2 / d_T, as the Hermitian
/// n x n system that results when u + iv is one complex unknown. The border is free; two pinned vertices make
/// the minimum unique. One refinement step whose residual is summed through the triangles gives (nearly)
/// full precision whatever the solver.
///
/// Without pins from the traits the result is scaled so that the chart's area in the plane is its area in
/// space. LSCM is one-to-one on most charts, but not on all, against section 2.6 of the paper: see
/// `Bijective_parameterizer`. Triangles without area count as if they were very thin, so that all coordinates
/// are finite and neighbours do not suffer.
///
/// Cost: one sparse factorization, O(n^1.5) for a disc.
template <LSCMTraits Traits = Eigen_LSCM_traits>
class LSCM_parameterizer
{
public:
  explicit LSCM_parameterizer(Traits traits = {}) : traits_(std::move(traits)) {}

  /// \return `solver_failed` if the system has no unique finite solution, as happens when the chart is not
  /// connected; the coordinates are then all zero
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    LSCM_record record;
    return parameterize(chart, execution, record);
  }

  Chart_status parameterize(Chart& chart, const Execution& execution, LSCM_record& record) const
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    record = {};
    if (chart.triangles.empty())
      return Chart_status::not_a_disc;
    const internal::Chart_geometry geometry(chart);
    const internal::Conformal_energy energy(geometry);
    record.pins = traits_.pins(chart);
    const bool has_user_pins = !record.pins.empty();
    if (!has_user_pins)
      record.pins = default_pins(geometry);
    std::vector<internal::Complex> u = pinned(geometry, record.pins);
    if (!solve(energy, record, u, execution))
      return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::solver_failed;
    store(geometry, u, !has_user_pins, chart, record);
    return Chart_status::valid;
  }

private:
  /// Two far-apart border vertices, as far from each other in the plane as in space.
  static std::vector<LSCM_pin> default_pins(const internal::Chart_geometry& geometry)
  {
    const auto [first, second] = internal::far_apart_vertices(geometry);
    double distance = geometry.distance(first, second);
    if (!(distance > 0))
      distance = 1;
    return {{first, Point_2(0, 0)}, {second, Point_2(geometry.to_model(distance), 0)}};
  }

  static std::vector<internal::Complex> pinned(const internal::Chart_geometry& geometry,
                                               const std::vector<LSCM_pin>& pins)
  {
    CGAL_precondition_msg(pins.size() >= 2, "LSCM needs two pins at least");
    std::vector<internal::Complex> u(geometry.number_of_vertices());
    for (const LSCM_pin& pin : pins) {
      CGAL_precondition(pin.vertex < u.size());
      u[pin.vertex] = {geometry.from_model(pin.uv.x()), geometry.from_model(pin.uv.y())};
    }
    return u;
  }

  /// The first solve is a refinement step too: it starts from the pins with zeros elsewhere.
  static bool solve(const internal::Conformal_energy& energy, LSCM_record& record,
                    std::vector<internal::Complex>& u, const Execution& execution)
  {
    const LSCM_system system = internal::lscm_system(energy, record.pins);
    if (system.number_of_columns == 0)
      return true;
    typename Traits::Solver solver;
    if (!solver.factorize(system, execution))
      return false;
    std::vector<internal::Complex> residual, step(system.number_of_columns);
    constexpr int steps = 2;
    for (int i = 0; i < steps; ++i) {
      energy.residual(u, residual);
      for (std::size_t v = 0; v < u.size(); ++v)
        if (system.column[v] != no_index)
          step[system.column[v]] = residual[v];
      if (execution.is_cancelled() || !solver.solve(step))
        return false;
      double largest_step = 0, extent = 0;
      for (std::size_t v = 0; v < u.size(); ++v) {
        if (system.column[v] != no_index) {
          u[v] += step[system.column[v]];
          largest_step = std::max(largest_step, std::abs(step[system.column[v]]));
        }
        if (!std::isfinite(u[v].real()) || !std::isfinite(u[v].imag()))
          return false;
        extent = std::max(extent, std::abs(u[v]));
      }
      record.residual = extent > 0 ? largest_step / extent : 0;
    }
    return true;
  }

  static void store(const internal::Chart_geometry& geometry, const std::vector<internal::Complex>& u,
                    bool is_scaled, Chart& chart, LSCM_record& record)
  {
    const double area = internal::area_in_plane(chart, u);
    record.energy = area > 0 ? internal::Conformal_energy(geometry).value(u) / area : 0;
    const double scale = is_scaled ? internal::density_correction(geometry, u) : 1;
    internal::store_coordinates(geometry, u, scale, chart);
  }

  Traits traits_;
};

} // namespace Atlas

#endif
