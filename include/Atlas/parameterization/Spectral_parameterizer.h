// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_SPECTRAL_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_SPECTRAL_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_traits.h>

namespace Atlas {

namespace internal {

/// Spectral conformal parameterization with any solver.
Chart_status spectral_map(Chart& chart, LSCM_solver_interface& solver, const Execution& execution);

} // namespace internal

/// \brief Conformal maps without pins: Mullen, Tong, Alliez and Desbrun, Spectral conformal parameterization,
/// 2008.
///
/// Finds the least conformal energy among the maps whose border vertices have mean 0 and variance 1: the
/// smallest positive generalized eigenvalue of H x = lambda B x, B being 1 on the border. Inverse iteration
/// on LSCM's own factor: the vertex pinned at 0 takes away the constants, the other pin is eliminated as a
/// last unknown. Distortion does not gather at pins, as it does with LSCM. The result has the area of the
/// chart; where LSCM is exact, so is this.
///
/// Cost: LSCM's factorization and a few solves: at most 30, until the eigenvalue changes by less than 1e-9 of
/// itself.
///
/// \tparam Solver  of the system that LSCM has with two pins
template <LSCMSolver Solver = Direct_LSCM_solver>
class Spectral_parameterizer
{
public:
  /// \return `not_a_disc` for a chart without triangles; `solver_failed` if the system has no unique finite
  /// solution, as for a chart that is not connected or has no border
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    internal::LSCM_solver_model<Solver> solver;
    return internal::spectral_map(chart, solver, execution);
  }
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/conformal/Spectral_parameterizer_impl.h>
#endif

#endif
