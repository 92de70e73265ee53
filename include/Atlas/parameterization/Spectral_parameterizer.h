// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_SPECTRAL_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_SPECTRAL_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Conformal maps without pins: Mullen, Tong, Alliez and Desbrun, Spectral conformal parameterization,
/// 2008.
///
/// Finds the least conformal energy among the maps whose border vertices have mean 0 and variance 1: the
/// smallest positive generalized eigenvalue of H x = lambda B x, B being 1 on the border. Inverse iteration
/// on LSCM's own factor: the vertex pinned at 0 takes away the constants, the other pin is eliminated as a
/// last unknown. Distortion does not gather at pins, as it does with LSCM. The result has the area of the
/// chart; where LSCM is exact, so is this.
///
/// Cost: LSCM's factorization and a few solves.
template <LSCMTraits Traits = Eigen_LSCM_traits>
class Spectral_parameterizer
{
public:
  static constexpr int max_iterations = 30;
  static constexpr double tolerance = 1e-9; ///< relative change of the eigenvalue

  /// \return `solver_failed` as `LSCM_parameterizer` does, also for a chart without border
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    if (chart.triangles.empty())
      return Chart_status::not_a_disc;
    const internal::Chart_geometry geometry(chart);
    const internal::Conformal_energy energy(geometry);
    const auto [p, q] = internal::far_apart_vertices(geometry);
    Inverse inverse(energy, p, q);
    if (!inverse.prepare(execution))
      return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::solver_failed;
    const std::vector<bool> border = internal::border_vertices(chart);
    Vector x = inverse.lscm();
    if (!inverse.is_developable())
      iterate(inverse, border, x, execution);
    for (const internal::Complex& z : x)
      if (!std::isfinite(z.real()) || !std::isfinite(z.imag()))
        return Chart_status::solver_failed;
    internal::store_coordinates(geometry, x, internal::density_correction(geometry, x), chart);
    return execution.is_cancelled() ? Chart_status::cancelled : Chart_status::valid;
  }

private:
  using Vector = std::vector<internal::Complex>;

  /// H y = b for b orthogonal to the constants, up to a constant in y.
  class Inverse
  {
  public:
    Inverse(const internal::Conformal_energy& energy, Index p, Index q)
        : energy_(energy), q_(q),
          system_(internal::lscm_system(energy, {{p, Point_2(0, 0)}, {q, Point_2(0, 0)}}))
    {}

    bool prepare(const Execution& execution)
    {
      Vector unit(energy_.size(), 0), product;
      unit[q_] = 1;
      energy_.residual(unit, product);
      for (internal::Complex& z : product)
        z = -z;
      h_qq_ = product[q_].real();
      h_q_ = gather(product);
      if (!solver_.factorize(system_, execution))
        return false;
      w_ = h_q_;
      if (!solver_.solve(w_))
        return false;
      schur_ = h_qq_ - dot(h_q_, w_).real();
      return true;
    }

    /// The Schur complement is twice LSCM's energy with the pins at distance 1; below this it is rounding.
    bool is_developable() const { return !(schur_ > 1e-11 * h_qq_); }

    Vector lscm() const
    {
      Vector x(energy_.size(), 0);
      x[q_] = 1;
      scatter(w_, -1, x);
      return x;
    }

    bool apply(const Vector& b, Vector& y) const
    {
      Vector z = gather(b);
      if (!solver_.solve(z))
        return false;
      const internal::Complex y_q = (b[q_] - dot(h_q_, z)) / schur_;
      y.assign(energy_.size(), 0);
      y[q_] = y_q;
      scatter(z, 1, y);
      scatter(w_, -y_q, y);
      return true;
    }

  private:
    static internal::Complex dot(const Vector& a, const Vector& b)
    {
      internal::Complex sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::conj(a[i]) * b[i];
      return sum;
    }

    Vector gather(const Vector& x) const
    {
      Vector result(system_.number_of_columns);
      for (std::size_t v = 0; v < x.size(); ++v)
        if (system_.column[v] != no_index)
          result[system_.column[v]] = x[v];
      return result;
    }

    void scatter(const Vector& part, internal::Complex factor, Vector& x) const
    {
      for (std::size_t v = 0; v < x.size(); ++v)
        if (system_.column[v] != no_index)
          x[v] += factor * part[system_.column[v]];
    }

    const internal::Conformal_energy& energy_;
    Index q_;
    LSCM_system system_;
    typename Traits::Solver solver_;
    Vector h_q_, w_;
    double h_qq_ = 0, schur_ = 0;
  };

  /// Border mean 0 and border variance 1; the inverse of the old variance.
  static double normalize(const std::vector<bool>& border, Vector& x)
  {
    internal::Complex mean = 0;
    double count = 0, variance = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
      if (border[v]) {
        mean += x[v];
        ++count;
      }
    for (internal::Complex& z : x)
      z -= mean / count;
    for (std::size_t v = 0; v < x.size(); ++v)
      if (border[v])
        variance += std::norm(x[v]);
    for (internal::Complex& z : x)
      z /= std::sqrt(variance);
    return 1 / std::sqrt(variance);
  }

  static void iterate(const Inverse& inverse, const std::vector<bool>& border, Vector& x,
                      const Execution& execution)
  {
    normalize(border, x);
    double eigenvalue = 0;
    Vector b, y;
    for (int i = 0; i < max_iterations && !execution.is_cancelled(); ++i) {
      b = x;
      for (std::size_t v = 0; v < b.size(); ++v)
        if (!border[v])
          b[v] = 0;
      if (!inverse.apply(b, y))
        return;
      const double next = normalize(border, y);
      x = y;
      if (std::abs(next - eigenvalue) <= tolerance * next)
        return;
      eigenvalue = next;
    }
  }
};

} // namespace Atlas

#endif
