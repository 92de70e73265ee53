// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_ARAP_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_ARAP_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/distortion/distortion_energy.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>
#include <Atlas/parameterization/internal/sparse/fill_reducing_order.h>
#include <Atlas/parameterization/internal/sparse/multifrontal_cholesky.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief As rigid as possible: Liu, Zhang, Xu, Gotsman and Gortler, A local/global approach to mesh
/// parameterization, 2008.
///
/// Alternates between the rotation nearest to each triangle's map and the vertices that fit these rotations
/// best, from LSCM on. The energy, sum of (x - 1)^2 + (y - 1)^2 over the singular values weighted by area,
/// never rises. Flips are possible. One real factorization; a solve per iteration.
class ARAP_parameterizer
{
public:
  static constexpr std::size_t default_max_iterations = 200;
  static constexpr double default_tolerance = 1e-6;

  /// \param tolerance  the iteration ends when it lowers the energy by less than this part of the area
  explicit ARAP_parameterizer(std::size_t max_iterations = default_max_iterations,
                              double tolerance = default_tolerance)
      : max_iterations_(max_iterations), tolerance_(tolerance)
  {}

  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    if (const Chart_status status = LSCM_parameterizer<>().parameterize(chart, execution);
        status != Chart_status::valid)
      return status;
    const internal::Chart_geometry geometry(chart);
    const internal::Conformal_matrix h = internal::Conformal_energy(geometry).matrix();
    const internal::Graph graph{h.first, h.neighbor};
    const internal::Supernodal_symbolic symbolic(graph, internal::approximate_minimum_degree(graph));
    internal::Multifrontal_cholesky<1> cholesky(symbolic);
    if (!factorize(h, symbolic, cholesky))
      return Chart_status::solver_failed;

    const std::vector<internal::Rest_triangle> rest =
        internal::rest_triangles(geometry, internal::least_relative_height);
    std::vector<internal::Complex> u(chart.number_of_vertices());
    for (std::size_t v = 0; v < u.size(); ++v)
      u[v] = {geometry.from_model(chart.uv[v].x()), geometry.from_model(chart.uv[v].y())};
    double area = 0, before = std::numeric_limits<double>::infinity();
    for (const internal::Rest_triangle& triangle : rest)
      area += triangle.area;
    std::vector<internal::Complex> right;
    for (std::size_t i = 0; i < max_iterations_ && execution.proceed(); ++i) {
      const double energy = local_step(chart, rest, u, right);
      if (!(energy < before - tolerance_ * area))
        break;
      before = energy;
      if (!global_step(symbolic, cholesky, right, u))
        return Chart_status::solver_failed;
    }
    internal::store_coordinates(geometry, u, internal::density_correction(geometry, u), chart);
    return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::valid;
  }

private:
  /// The Dirichlet matrix; the last column is stiffened a little, since translations have no energy.
  static bool factorize(const internal::Conformal_matrix& h, const internal::Supernodal_symbolic& symbolic,
                        internal::Multifrontal_cholesky<1>& cholesky)
  {
    return cholesky.factorize(
        [&](Index c, auto add) {
          const double d = h.diagonal[symbolic.vertex(c)];
          add(0, 0, c + 1 == symbolic.size() || !(d > 0) ? d + 1 : d);
        },
        [&](std::size_t k, auto add) { add(0, 0, h.re[symbolic.lower_source(k)]); },
        [](std::size_t) { return false; });
  }

  /// The nearest rotation to z -> f z + g conj(z) is z -> f / |f| z. Returns the energy of u.
  static double local_step(const Chart& chart, const std::vector<internal::Rest_triangle>& rest,
                           const std::vector<internal::Complex>& u, std::vector<internal::Complex>& right)
  {
    right.assign(u.size(), 0);
    double energy = 0;
    for (std::size_t t = 0; t < rest.size(); ++t) {
      const auto& corner = chart.triangles[t];
      const auto [f, g] = internal::derivative(rest[t], u[corner[0]], u[corner[1]], u[corner[2]]);
      const double r = std::abs(f);
      const internal::Complex rotation = r > 0 ? f / r : internal::Complex(1);
      energy += 2 * rest[t].area * (std::norm(f - rotation) + std::norm(g));
      // d/du of |f - rotation|^2 is conj(alpha) (f - rotation), alpha = conj(beta); the matrix is twice the
      // sum.
      for (int i = 0; i < 3; ++i)
        right[corner[i]] += 2 * rest[t].area * internal::times(rest[t].beta[i], rotation);
    }
    return energy;
  }

  static bool global_step(const internal::Supernodal_symbolic& symbolic,
                          const internal::Multifrontal_cholesky<1>& cholesky,
                          const std::vector<internal::Complex>& right, std::vector<internal::Complex>& u)
  {
    std::vector<internal::Complex> x(u.size());
    for (Index c = 0; c < x.size(); ++c)
      x[c] = right[symbolic.vertex(c)];
    if (!cholesky.solve(x))
      return false;
    for (Index c = 0; c < x.size(); ++c)
      u[symbolic.vertex(c)] = x[c];
    return true;
  }

  std::size_t max_iterations_;
  double tolerance_;
};

} // namespace Atlas

#endif
