// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERACTIVE_LSCM_H
#define ATLAS_PARAMETERIZATION_INTERACTIVE_LSCM_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_system.h>
#include <Atlas/parameterization/LSCM_traits.h>

#include <memory>
#include <span>
#include <utility>

namespace Atlas {

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
  Interactive_LSCM(Interactive_LSCM&&) noexcept;
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
#endif

#endif
