// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_ARAP_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_ARAP_PARAMETERIZER_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/ARAP_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>
#include <Atlas/parameterization/internal/distortion/distortion_energy.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>
#include <Atlas/parameterization/internal/sparse/fill_reducing_order.h>
#include <Atlas/parameterization/internal/sparse/multifrontal_cholesky.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

namespace Atlas {

namespace internal {

/// \brief The two alternating steps. The matrix is that of Dirichlet's energy.
class Local_global_solver
{
public:
  explicit Local_global_solver(const Chart_geometry& geometry)
      : chart_(geometry.chart()), rest_(rest_triangles(geometry, least_relative_height)),
        h_(Conformal_energy(geometry).matrix()), graph_{h_.first, h_.neighbor},
        symbolic_(graph_, approximate_minimum_degree(graph_)), cholesky_(symbolic_)
  {}

  /// The last column is stiffened a little, since translations have no energy.
  bool factorize()
  {
    return cholesky_.factorize(
        [&](Index c, auto add) {
          const double d = h_.diagonal[symbolic_.vertex(c)];
          add(0, 0, c + 1 == symbolic_.size() || !(d > 0) ? d + 1 : d);
        },
        [&](std::size_t k, auto add) { add(0, 0, h_.re[symbolic_.lower_source(k)]); },
        [](std::size_t) { return false; });
  }

  double area() const
  {
    double sum = 0;
    for (const Rest_triangle& triangle : rest_)
      sum += triangle.area;
    return sum;
  }

  /// The nearest rotation to z -> f z + g conj(z) is z -> f / |f| z. Returns the energy of u.
  double local_step(const std::vector<Complex>& u)
  {
    right_.assign(u.size(), 0);
    double energy = 0;
    for (std::size_t t = 0; t < rest_.size(); ++t) {
      const auto& corner = chart_.triangles[t];
      const auto [f, g] = derivative(rest_[t], u[corner[0]], u[corner[1]], u[corner[2]]);
      const double r = std::abs(f);
      const Complex rotation = r > 0 ? f / r : Complex(1);
      energy += 2 * rest_[t].area * (std::norm(f - rotation) + std::norm(g));
      // d/du of |f - rotation|^2 is conj(alpha) (f - rotation), alpha = conj(beta); the matrix is twice the
      // sum.
      for (int i = 0; i < 3; ++i)
        right_[corner[i]] += 2 * rest_[t].area * times(rest_[t].beta[i], rotation);
    }
    return energy;
  }

  bool global_step(std::vector<Complex>& u)
  {
    std::vector<Complex> x(u.size());
    for (Index c = 0; c < x.size(); ++c)
      x[c] = right_[symbolic_.vertex(c)];
    if (!cholesky_.solve(x))
      return false;
    for (Index c = 0; c < x.size(); ++c)
      u[symbolic_.vertex(c)] = x[c];
    return true;
  }

private:
  const Chart& chart_;
  std::vector<Rest_triangle> rest_;
  Conformal_matrix h_;
  Graph graph_;
  Supernodal_symbolic symbolic_;
  Multifrontal_cholesky<1> cholesky_;
  std::vector<Complex> right_;
};

} // namespace internal

ATLAS_INLINE ARAP_parameterizer::ARAP_parameterizer(std::size_t max_iterations, double tolerance)
    : max_iterations_(max_iterations), tolerance_(tolerance)
{
  internal::require(tolerance >= 0, "tolerance", "must be at least 0");
}

ATLAS_INLINE Chart_status ARAP_parameterizer::parameterize(Chart& chart, const Execution& execution) const
{
  if (const Chart_status status = LSCM_parameterizer<>().parameterize(chart, execution);
      status != Chart_status::valid)
    return status;
  const internal::Chart_geometry geometry(chart);
  internal::Local_global_solver solver(geometry);
  if (!solver.factorize())
    return Chart_status::solver_failed;
  std::vector<internal::Complex> u = internal::coordinates_of(geometry);
  const double area = solver.area();
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < max_iterations_ && execution.proceed(); ++i) {
    const double energy = solver.local_step(u);
    if (!(energy < before - tolerance_ * area))
      break;
    before = energy;
    if (!solver.global_step(u))
      return Chart_status::solver_failed;
  }
  internal::store_coordinates(geometry, u, internal::density_correction(geometry, u), chart);
  return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::valid;
}

} // namespace Atlas

#endif
