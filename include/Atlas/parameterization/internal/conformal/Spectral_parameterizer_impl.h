// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_SPECTRAL_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_SPECTRAL_PARAMETERIZER_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/Spectral_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_system.h>
#include <Atlas/parameterization/internal/geometry/border.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <array>
#include <cmath>
#include <vector>

namespace Atlas::internal {

/// \brief Solves H y = b for b orthogonal to the constants, up to a constant in y, on the factor of LSCM with
/// the vertices p and q pinned: y is 0 at p, and its value at q is eliminated last.
class Conformal_inverse
{
public:
  Conformal_inverse(const Conformal_energy& energy, const std::array<Index, 2>& pins,
                    LSCM_solver_interface& solver)
      : energy_(energy), q_(pins[1]),
        system_(
            lscm_system(energy, std::array<LSCM_pin, 2>{{{pins[0], Point_2(0, 0)}, {q_, Point_2(0, 0)}}})),
        solver_(solver)
  {}

  bool prepare(const Execution& execution)
  {
    std::vector<Complex> unit(energy_.size(), 0), product;
    unit[q_] = 1;
    energy_.residual(unit, product);
    for (Complex& z : product)
      z = -z;
    h_qq_ = product[q_].real();
    h_q_ = gather(system_, product);
    if (!solver_.factorize(system_, execution))
      return false;
    w_ = h_q_;
    if (!solver_.solve(w_))
      return false;
    schur_ = h_qq_ - inner_product(h_q_, w_).real();
    return true;
  }

  /// The Schur complement is twice LSCM's energy with the pins at distance 1; below this it is rounding.
  bool is_developable() const { return !(schur_ > 1e-11 * h_qq_); }

  /// The map of LSCM with p at 0 and q at 1.
  std::vector<Complex> lscm() const
  {
    std::vector<Complex> x(energy_.size(), 0);
    x[q_] = 1;
    scatter_add(system_, w_, -1, x);
    return x;
  }

  bool apply(const std::vector<Complex>& b, std::vector<Complex>& y) const
  {
    std::vector<Complex> z = gather(system_, b);
    if (!solver_.solve(z))
      return false;
    const Complex y_q = (b[q_] - inner_product(h_q_, z)) / schur_;
    y.assign(energy_.size(), 0);
    y[q_] = y_q;
    scatter_add(system_, z, 1, y);
    scatter_add(system_, w_, -y_q, y);
    return true;
  }

private:
  const Conformal_energy& energy_;
  Index q_;
  LSCM_system system_;
  LSCM_solver_interface& solver_;
  std::vector<Complex> h_q_, w_;
  double h_qq_ = 0, schur_ = 0;
};

/// Border mean 0 and border variance 1; the inverse of the old variance.
inline double normalize_border(const std::vector<bool>& border, std::vector<Complex>& x)
{
  Complex mean = 0;
  double count = 0, variance = 0;
  for (std::size_t v = 0; v < x.size(); ++v)
    if (border[v]) {
      mean += x[v];
      ++count;
    }
  for (Complex& z : x)
    z -= mean / count;
  for (std::size_t v = 0; v < x.size(); ++v)
    if (border[v])
      variance += std::norm(x[v]);
  for (Complex& z : x)
    z /= std::sqrt(variance);
  return 1 / std::sqrt(variance);
}

/// Inverse iteration from x on.
inline void find_eigenvector(const Conformal_inverse& inverse, const std::vector<bool>& border,
                             std::vector<Complex>& x, const Execution& execution)
{
  constexpr int max_iterations = 30;
  constexpr double tolerance = 1e-9; // relative change of the eigenvalue
  normalize_border(border, x);
  double eigenvalue = 0;
  std::vector<Complex> b, y;
  for (int i = 0; i < max_iterations && !execution.is_cancelled(); ++i) {
    b = x;
    for (std::size_t v = 0; v < b.size(); ++v)
      if (!border[v])
        b[v] = 0;
    if (!inverse.apply(b, y))
      return;
    const double next = normalize_border(border, y);
    x = y;
    if (std::abs(next - eigenvalue) <= tolerance * next)
      return;
    eigenvalue = next;
  }
}

ATLAS_INLINE Chart_status spectral_map(Chart& chart, LSCM_solver_interface& solver,
                                       const Execution& execution)
{
  check_chart(chart);
  chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
  if (chart.triangles.empty())
    return Chart_status::not_a_disc;
  const Chart_geometry geometry(chart);
  const Conformal_energy energy(geometry);
  Conformal_inverse inverse(energy, far_apart_vertices(geometry), solver);
  if (!inverse.prepare(execution))
    return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::solver_failed;
  std::vector<Complex> x = inverse.lscm();
  if (!inverse.is_developable())
    find_eigenvector(inverse, border_vertices(chart), x, execution);
  if (!all_finite(x))
    return Chart_status::solver_failed;
  store_coordinates(geometry, x, density_correction(geometry, x), chart);
  return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::valid;
}

} // namespace Atlas::internal

#endif
