// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_LSCM_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_LSCM_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_traits.h>

#include <memory>
#include <span>
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

namespace internal {

/// LSCM with any solver. Without pins the record names those that were chosen, and the result is scaled.
Chart_status lscm(Chart& chart, std::vector<LSCM_pin> pins, LSCM_solver_interface& solver,
                  const Execution& execution, LSCM_record& record);

} // namespace internal

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
/// Cost: one sparse factorization, O(n^1.5) for a disc. For many solutions with different pins on one chart
/// see `Interactive_LSCM`.
template <LSCMTraits Traits = Eigen_LSCM_traits>
class LSCM_parameterizer
{
public:
  /// With these pins and this solver.
  explicit LSCM_parameterizer(Traits traits = {}) : traits_(std::move(traits)) {}

  /// \return `not_a_disc` for a chart without triangles; `solver_failed` if the system has no unique finite
  /// solution, as happens when the chart is not connected; the coordinates are then all zero
  /// \throws Invalid_argument if the traits give pins, and fewer than two, or all at one place, or one that
  /// is no vertex of the chart
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    LSCM_record record;
    return parameterize(chart, execution, record);
  }

  /// \copydoc parameterize
  /// \param record  pins, energy and residual; as by default without a solution
  Chart_status parameterize(Chart& chart, const Execution& execution, LSCM_record& record) const
  {
    auto solver = internal::lscm_solver(traits_);
    return internal::lscm(chart, traits_.pins(chart), solver, execution, record);
  }

private:
  Traits traits_;
};

/// \brief Least squares conformal maps of one chart with one pin set after another, on a single
/// factorization: for editors in which pins are set and dragged.
///
/// The maps are those of `LSCM_parameterizer` with the same pins, up to rounding. The matrix is factorized
/// once, with two vertices far apart held. Other pins are conditions on forces at pinned vertices: m pins
/// make a dense system of m + 2 equations.
///
/// Cost: as `LSCM_parameterizer` in the constructor; then, for m pins, one solve with the factor for each
/// vertex that was not pinned in the call before, one more for refinement, and O(m n + m^3). A solve with the
/// factor is O(n log n) for a disc, some percent of a factorization. Memory: the factor and m n complex
/// numbers.
class Interactive_LSCM
{
public:
  /// Factorizes with `Direct_LSCM_solver`.
  /// \param chart  its `uv` are not read
  /// \throws Invalid_argument if a triangle has a vertex that does not exist
  explicit Interactive_LSCM(Chart chart, const Execution& execution = Execution());

  /// Factorizes with a solver of one's choice: `Interactive_LSCM::with_solver<My_solver>(chart)`.
  template <LSCMSolver Solver>
  static Interactive_LSCM with_solver(Chart chart, const Execution& execution = Execution())
  {
    return Interactive_LSCM(std::move(chart), std::make_unique<internal::LSCM_solver_model<Solver>>(),
                            execution);
  }

  ~Interactive_LSCM();
  /// Moves the factorization.
  Interactive_LSCM(Interactive_LSCM&&) noexcept;
  /// Moves the factorization.
  Interactive_LSCM& operator=(Interactive_LSCM&&) noexcept;

  /// `valid` if there is a factorization; else why not, as `LSCM_parameterizer` tells.
  Chart_status status() const;

  /// The chart, with the coordinates of the last map in the unit of the model; all zero before the first.
  const Chart& chart() const;

  /// Maps the chart with these pins. Pinned vertices are exactly where they are told to be.
  /// \return `valid`; or why not, and the coordinates stay as they are: `solver_failed` also if fewer than
  /// two of the pinned vertices have triangles
  /// \throws Invalid_argument if there are fewer than two pins, if all are at one place, if a vertex is
  /// pinned twice or does not exist, if a coordinate is not finite
  Chart_status solve(std::span<const LSCM_pin> pins);

private:
  struct State;

  Interactive_LSCM(Chart chart, std::unique_ptr<internal::LSCM_solver_interface> solver,
                   const Execution& execution);

  std::unique_ptr<State> state_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/conformal/Interactive_LSCM_impl.h>
#include <Atlas/parameterization/internal/conformal/LSCM_parameterizer_impl.h>
#endif

#endif
