// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_LSCM_TRAITS_H
#define ATLAS_PARAMETERIZATION_LSCM_TRAITS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_system.h>

#include <complex>
#include <concepts>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief What LSCM leaves open: the solver of its sparse system, and the pins.
///
/// `pins()` returns the vertices whose images are given: at least two, at two different places at least; or
/// none, which stands for two border vertices far apart, and for a result that is scaled to the chart's own
/// area.
template <typename T>
concept LSCMTraits = LSCMSolver<typename T::Solver> && requires(const T& traits, const Chart& chart)
{
  {
    traits.pins(chart)
    } -> std::convertible_to<std::vector<LSCM_pin>>;
};

namespace internal {

/// Throws `Invalid_argument` unless the pins have finite images at two places at least, each vertex once.
void check_pins(std::span<const LSCM_pin> pins);

/// The same, and the vertices must be less than the given number.
void check_pins(std::span<const LSCM_pin> pins, std::size_t number_of_vertices);

} // namespace internal

/// \brief Traits with a solver of one's choice.
template <LSCMSolver Solver_>
class Basic_LSCM_traits
{
public:
  using Solver = Solver_;

  Basic_LSCM_traits() = default;
  /// Pins for the one chart that will be flattened.
  /// \throws Invalid_argument if there are pins, but fewer than two; if all are at one place; if a vertex is
  /// pinned twice; if a coordinate is not finite
  explicit Basic_LSCM_traits(std::vector<LSCM_pin> pins) : pins_(std::move(pins))
  {
    if (!pins_.empty())
      internal::check_pins(pins_);
  }

  const std::vector<LSCM_pin>& pins(const Chart&) const { return pins_; }

private:
  std::vector<LSCM_pin> pins_;
};

/// \brief Factorizes: Eigen's complex LDL* for charts of up to some thousand vertices, for larger ones a
/// multifrontal Cholesky factorization that is complex only where the border is.
class Direct_LSCM_solver
{
public:
  bool factorize(const LSCM_system& system, const Execution& execution);
  bool solve(std::span<std::complex<double>> b);

private:
  std::unique_ptr<internal::LSCM_solver_interface> chosen_;
};

/// \brief Conjugate gradients on the real least squares matrix A of the LSCM paper, equation 4, with the
/// diagonal of A^T A as preconditioner. A^T A itself is never formed.
///
/// Stops when the residual is 1e-12 of the right-hand side, or after ten times as many iterations as there
/// are real unknowns.
class Conjugate_gradient_LSCM_solver
{
public:
  bool factorize(const LSCM_system& system, const Execution& execution);
  bool solve(std::span<std::complex<double>> b);

private:
  std::unique_ptr<internal::LSCM_solver_interface> chosen_;
};

/// \brief The default: direct solvers that need nothing but Eigen.
using Eigen_LSCM_traits = Basic_LSCM_traits<Direct_LSCM_solver>;

/// \brief The solver of the LSCM paper.
///
/// For study: the condition of LSCM grows with the square of the number of vertices, so that direct solvers
/// win at every size.
using Conjugate_gradient_LSCM_traits = Basic_LSCM_traits<Conjugate_gradient_LSCM_solver>;

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/conformal/LSCM_traits_impl.h>
#endif

#endif
