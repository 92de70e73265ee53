// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_LSCM_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_LSCM_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_system.h>
#include <Atlas/parameterization/LSCM_traits.h>

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
    internal::LSCM_solver_model<typename Traits::Solver> solver;
    return internal::lscm(chart, traits_.pins(chart), solver, execution, record);
  }

private:
  Traits traits_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/conformal/LSCM_parameterizer_impl.h>
#endif

#endif
