// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_OUT_OF_CORE_CHOLESKY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_OUT_OF_CORE_CHOLESKY_H

#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <string>

namespace Atlas::internal {

/// Bytes for each vertex while the matrix is put together and put in order, before the factorization.
inline constexpr std::size_t bytes_for_assembly = 570;

/// A twentieth of the limit is left free.
inline constexpr std::size_t margin_share = 20;

/// What LSCM has in memory besides its factorization: the points of `Chart_geometry`, the matrix, five
/// vectors for the map and its refinement, and what allocators lose between blocks.
inline std::size_t bytes_besides_factorization(const LSCM_system& system)
{
  constexpr std::size_t point = 24, vectors = 5 * sizeof(std::complex<double>), lost = 24;
  return system.unknown.capacity() * (point + vectors + lost + sizeof(int)) +
         (system.first.capacity() + system.row.capacity()) * sizeof(int) +
         system.value.capacity() * sizeof(std::complex<double>);
}

/// The factorization with a factor in a file, where it is more than the limit for all of LSCM leaves room
/// for. With a limit that is too low it fails.
inline LSCM_solver_model<Basic_hermitian_multifrontal<Panels_in_file>>
out_of_core_cholesky(const LSCM_system& system, std::size_t memory_limit, const std::string& directory)
{
  const std::size_t others = bytes_besides_factorization(system);
  const bool is_enough = memory_limit >= std::max(others, bytes_for_assembly * system.unknown.size());
  const std::size_t margin = memory_limit / margin_share; // what allocators round up
  Panels_in_file panels(is_enough && memory_limit > others + margin ? memory_limit - others - margin : 0,
                        directory);
  return LSCM_solver_model<Basic_hermitian_multifrontal<Panels_in_file>>(
      Basic_hermitian_multifrontal<Panels_in_file>(std::move(panels)));
}

} // namespace Atlas::internal

#endif
