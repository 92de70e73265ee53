// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_DISTORTION_MINIMIZER_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_DISTORTION_MINIMIZER_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/distortion/border_barrier.h>
#include <Atlas/parameterization/internal/distortion/distortion_energy.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>
#include <Atlas/parameterization/internal/sparse/Vertex_block_cholesky.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Thinner triangles are optimised as if they were this high, relative to their longest edge, so that they
/// have area left when their coordinates are rounded to single precision.
inline constexpr double least_optimized_height = 1e-4;

/// How many steps a chart may take: smooth ones take a few at any size, rough ones would take hundreds to
/// gain little. So large charts get as many as bound the product with their vertices.
inline std::size_t affordable_steps(std::size_t vertices, std::size_t max_steps)
{
  constexpr std::size_t vertices_of_steps = 1'000'000, least = 8;
  return std::min(max_steps, std::max(least, vertices_of_steps / std::max<std::size_t>(vertices, 1)));
}

/// \brief Minimises an isotropic distortion energy over the maps of a chart without flips, by Newton's method
/// with positive semidefinite blocks. Once the border is simple it stays so.
template <typename Energy>
class Distortion_minimizer
{
public:
  Distortion_minimizer(const Chart_geometry& geometry, std::vector<Complex> u, const Energy& energy)
      : function_(energy), geometry_(geometry), chart_(geometry.chart()),
        rest_(rest_triangles(geometry, least_optimized_height)), checker_(chart_),
        barrier_(geometry, checker_.borders()), u_(std::move(u)), gradient_(u_.size()),
        is_fixed_(u_.size(), 0)
  {
    for (const Rest_triangle& rest : rest_)
      area_ += rest.area;
    has_flip_ = checker_.has_flip(u_);
    is_simple_ = checker_.is_border_simple(u_);
    energy_ = total(u_);
  }

  bool has_flip() const { return has_flip_; }
  bool is_border_simple() const { return is_simple_; }
  const std::vector<std::vector<Index>>& borders() const { return checker_.borders(); }
  bool is_guarded() const { return is_guarded_; }
  const std::vector<Complex>& coordinates() const { return u_; }

  /// The energy without the barrier, per unit of area.
  double mean_energy() const { return total_energy(function_, chart_, rest_, u_) / area_; }

  /// One step; `false` if there is none that lowers the energy. `decrease` is relative to the energy.
  bool step(double& decrease)
  {
    if (!is_guarded_ && try_step(decrease))
      return true;
    // The border came to touch itself: from the last map without contact go on with the barrier.
    if (!is_guarded_ && is_simple_ && !is_guarded_by_failure_)
      return false;
    is_guarded_ = true;
    energy_ = total(u_);
    return try_step(decrease);
  }

  /// Steps until one lowers the energy by less than `tolerance` of it, or the mean is at most `target`.
  /// \return how many there were
  std::size_t minimize(std::size_t max_steps, double tolerance, double target, const Execution& execution)
  {
    max_steps = affordable_steps(u_.size(), max_steps);
    std::size_t steps = 0;
    double decrease = 1;
    while (steps < max_steps && decrease > tolerance && !(target > 0 && mean_energy() <= target) &&
           execution.proceed() && step(decrease))
      ++steps;
    return steps;
  }

  /// Minimises another energy from now on.
  void change_energy(const Energy& energy)
  {
    function_ = energy;
    energy_ = total(u_);
  }

  /// Keeps the border from touching itself from now on, if it does not yet.
  void guard()
  {
    is_guarded_ = is_simple_;
    energy_ = total(u_);
  }

  /// Lets border vertices stay where they are from now on.
  void keep_border()
  {
    for (const std::vector<Index>& border : checker_.borders())
      for (const Index v : border)
        is_fixed_[v] = 1;
  }

  /// Lets a vertex stay where it is from now on.
  void keep(Index v) { is_fixed_[v] = 1; }

  /// Draws vertices to places from now on: the energy has a spring for each, this stiff.
  void pull(std::vector<std::pair<Index, Complex>> places, double stiffness)
  {
    pulled_ = std::move(places);
    stiffness_ = stiffness;
    energy_ = total(u_);
  }

  /// Goes on from another map if that is as valid and has less energy.
  bool adopt(std::vector<Complex> u)
  {
    if (!(total_energy(function_, chart_, rest_, u) < total_energy(function_, chart_, rest_, u_)) ||
        checker_.has_flip(u))
      return false;
    const bool is_simple = checker_.is_border_simple(u);
    if (is_simple_ && !is_simple)
      return refit();
    u_ = std::move(u);
    is_simple_ = is_simple;
    energy_ = total(u_);
    return true;
  }

  /// The factor at which scaling no longer lowers the symmetric Dirichlet energy.
  double best_scale() const
  {
    double lengths = 0, inverses = 0;
    for (std::size_t t = 0; t < rest_.size(); ++t) {
      const auto& corner = chart_.triangles[t];
      const auto [f, g] = derivative(rest_[t], u_[corner[0]], u_[corner[1]], u_[corner[2]]);
      const double squares = std::norm(f) + std::norm(g), det = std::norm(f) - std::norm(g);
      lengths += rest_[t].area * squares;
      inverses += rest_[t].area * squares / (det * det);
    }
    const double factor = std::sqrt(std::sqrt(inverses / lengths));
    return std::isfinite(factor) && factor > 0 ? factor : 1;
  }

  /// Multiplies the coordinates, unless rounding would spoil the map.
  void scale(double factor)
  {
    std::vector<Complex> scaled = u_;
    for (Complex& z : scaled)
      z *= factor;
    if (!checker_.has_flip(scaled) && (!is_simple_ || checker_.is_border_simple(scaled))) {
      u_ = std::move(scaled);
      energy_ = total(u_);
    }
  }

private:
  static constexpr double regularization = 1e-9; ///< share of the mean diagonal
  static constexpr double sufficient = 1e-4;     ///< of the decrease that the gradient promises
  static constexpr int halvings = 40;

  /// The border tree must have been fitted to u, which the test for a simple border does.
  double total(std::span<const Complex> u) const
  {
    return smooth_part(u) + (is_guarded_ ? barrier_.value(checker_.tree(), u) : 0);
  }

  /// The distortion and the springs.
  double smooth_part(std::span<const Complex> u) const
  {
    double springs = 0;
    for (const auto& pulled : pulled_)
      springs += stiffness_ * std::norm(u[pulled.first] - pulled.second);
    return total_energy(function_, chart_, rest_, u) + springs;
  }

  bool try_step(double& decrease)
  {
    std::vector<Complex> direction;
    if (!newton_direction(direction))
      return false;
    double slope = 0;
    for (std::size_t v = 0; v < u_.size(); ++v)
      slope += gradient_[v].real() * direction[v].real() + gradient_[v].imag() * direction[v].imag();
    if (!(slope < 0))
      return false;
    std::vector<Complex> next(u_.size());
    double length = std::min(1., 0.9 * longest_step(direction));
    is_guarded_by_failure_ = false;
    for (int i = 0; i < halvings; ++i, length /= 2) {
      for (std::size_t v = 0; v < u_.size(); ++v)
        next[v] = u_[v] + length * direction[v];
      const double distortion = smooth_part(next);
      if (!(distortion <= energy_ + sufficient * length * slope) || checker_.has_flip(next))
        continue;
      const bool is_simple = checker_.is_border_simple(next);
      if (is_simple_ && !is_simple) {
        is_guarded_by_failure_ = true;
        if (!is_guarded_)
          return refit();
        continue;
      }
      const double sum = is_guarded_ ? distortion + barrier_.value(checker_.tree(), next) : distortion;
      if (!(sum <= energy_ + sufficient * length * slope))
        continue;
      decrease = (energy_ - sum) / energy_;
      u_ = std::move(next);
      is_simple_ = is_simple;
      energy_ = sum;
      return true;
    }
    return refit();
  }

  /// Fits the border tree to the current map again; always `false`.
  bool refit()
  {
    (void)checker_.is_border_simple(u_);
    return false;
  }

  bool newton_direction(std::vector<Complex>& direction)
  {
    assemble();
    system_->regularize(regularization);
    direction.resize(u_.size());
    for (std::size_t v = 0; v < u_.size(); ++v)
      direction[v] = -gradient_[v];
    return system_->solve(direction);
  }

  void assemble()
  {
    if (!system_) // many a chart needs no step
      system_.emplace(chart_);
    system_->set_zero();
    std::fill(gradient_.begin(), gradient_.end(), Complex(0));
    for (Index t = 0; t < rest_.size(); ++t)
      assemble(t);
    for (const auto& pulled : pulled_) {
      gradient_[pulled.first] += 2 * stiffness_ * (u_[pulled.first] - pulled.second);
      system_->add(pulled.first, {2 * stiffness_, 0, 0, 2 * stiffness_});
    }
    if (is_guarded_)
      barrier_.add(checker_.tree(), u_, gradient_, *system_);
  }

  /// In the frames turned by the arguments of f and g the energy changes with the lengths r and s (coupled)
  /// and with the components across (not coupled). Each gives one or two squares of linear forms.
  void assemble(Index t)
  {
    const auto& corner = chart_.triangles[t];
    const Rest_triangle& rest = rest_[t];
    const auto [f, g] = derivative(rest, u_[corner[0]], u_[corner[1]], u_[corner[2]]);
    // Square roots: `std::abs` takes several times as long, and guards against overflow that cannot be here.
    const double r = std::sqrt(std::norm(f)), s = std::sqrt(std::norm(g));
    const Complex ef = f / r, eg = s > 0 ? g / s : Complex(1);
    const Triangle_energy d = function_.derivatives(r + s, r - s);

    // Cholesky factor of the radial 2x2 matrix: l00 (y_r + l10 y_s)^2 + l11 y_s^2.
    const double l10 = d.krr > 0 ? d.krs / d.krr : 0, l11 = std::max(0., d.kss - d.krs * l10);
    const std::array<double, 4> weight{std::sqrt(rest.area * d.krr), std::sqrt(rest.area * l11),
                                       std::sqrt(rest.area * d.tangential_f),
                                       std::sqrt(rest.area * d.tangential_g)};
    std::array<std::array<Complex, 4>, 3> form{};
    for (int j = 0; j < 3; ++j) {
      if (is_fixed_[corner[j]])
        continue; // neither a gradient nor an equation: the regularized solution is no step
      const Complex of_f = times(ef, rest.beta[j]), of_g = times(eg, std::conj(rest.beta[j]));
      form[j] = {weight[0] * (of_f + l10 * of_g), weight[1] * of_g,
                 weight[2] * Complex(-of_f.imag(), of_f.real()),
                 weight[3] * Complex(-of_g.imag(), of_g.real())};
      gradient_[corner[j]] += rest.area * (d.dr * of_f + d.ds * of_g);
    }
    for (int j = 0; j < 3; ++j) {
      system_->add(corner[j], product(form[j], form[j]));
      system_->add(t, j, product(form[j], form[(j + 1) % 3]));
    }
  }

  static Vertex_block_cholesky::Block product(const std::array<Complex, 4>& a,
                                              const std::array<Complex, 4>& b)
  {
    Vertex_block_cholesky::Block block{0, 0, 0, 0};
    for (int m = 0; m < 4; ++m) {
      block[0] += a[m].real() * b[m].real();
      block[1] += a[m].real() * b[m].imag();
      block[2] += a[m].imag() * b[m].real();
      block[3] += a[m].imag() * b[m].imag();
    }
    return block;
  }

  /// How far one can go along the direction before a triangle loses its area (Smith and Schaefer 2015).
  double longest_step(const std::vector<Complex>& direction) const
  {
    const auto cross = [](const Complex& p, const Complex& q) {
      return p.real() * q.imag() - p.imag() * q.real();
    };
    double longest = std::numeric_limits<double>::infinity();
    for (const auto& corner : chart_.triangles) {
      const Complex p = u_[corner[1]] - u_[corner[0]], q = u_[corner[2]] - u_[corner[0]];
      const Complex dp = direction[corner[1]] - direction[corner[0]],
                    dq = direction[corner[2]] - direction[corner[0]];
      // area(x) = a x^2 + b x + c, c > 0
      const double a = cross(dp, dq), b = cross(dp, q) + cross(p, dq), c = cross(p, q);
      const double discriminant = b * b - 4 * a * c;
      if (discriminant < 0 || (a >= 0 && b >= 0))
        continue;
      // The smaller positive root, in the form without cancellation.
      const double root = 2 * c / (-b + std::sqrt(discriminant));
      if (root > 0)
        longest = std::min(longest, root);
    }
    return longest;
  }

  Energy function_;
  const Chart_geometry& geometry_;
  const Chart& chart_;
  std::vector<Rest_triangle> rest_;
  Injectivity_checker checker_;
  std::optional<Vertex_block_cholesky> system_; ///< from the first step on
  Border_barrier barrier_;
  std::vector<Complex> u_, gradient_;
  std::vector<std::uint8_t> is_fixed_; ///< per vertex
  std::vector<std::pair<Index, Complex>> pulled_;
  double stiffness_ = 0, area_ = 0, energy_ = 0;
  bool has_flip_, is_simple_, is_guarded_ = false, is_guarded_by_failure_ = false;
};

} // namespace Atlas::internal

#endif
