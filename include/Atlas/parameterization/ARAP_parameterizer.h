// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_ARAP_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_ARAP_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>

#include <cstddef>

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
  static constexpr std::size_t default_max_iterations = 200; ///< of local and global steps
  static constexpr double default_tolerance = 1e-6; ///< relative decrease of the energy at which they end

  /// \param tolerance  the iteration ends when it lowers the energy by less than this part of the area
  /// \throws Invalid_argument unless the tolerance is at least 0
  explicit ARAP_parameterizer(std::size_t max_iterations = default_max_iterations,
                              double tolerance = default_tolerance);

  /// \return what `LSCM_parameterizer` returns; `solver_failed` also if the factorization fails
  Chart_status parameterize(Chart& chart, const Execution& execution) const;

private:
  std::size_t max_iterations_;
  double tolerance_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/distortion/ARAP_parameterizer_impl.h>
#endif

#endif
