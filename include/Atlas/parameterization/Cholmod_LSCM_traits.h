// SPDX-License-Identifier: MIT
// This header needs CHOLMOD of SuiteSparse, whose core is LGPL and whose supernodal part, used here for large
// charts, is GPL. Nothing else in Atlas includes it.
#ifndef ATLAS_PARAMETERIZATION_CHOLMOD_LSCM_TRAITS_H
#define ATLAS_PARAMETERIZATION_CHOLMOD_LSCM_TRAITS_H

#include <Atlas/parameterization/LSCM_traits.h>

#include <Eigen/CholmodSupport>

#include <complex>
#include <span>

namespace Atlas {

/// \brief Complex L L* of CHOLMOD, which chooses order and method.
class Cholmod_LSCM_solver
{
public:
  /// See \ref LSCMTraits.
  bool factorize(const LSCM_system& system, const Execution&)
  {
    const auto n = static_cast<Eigen::Index>(system.size());
    cholmod_.compute(Eigen::Map<const Matrix>(n, n, static_cast<Eigen::Index>(system.value.size()),
                                              system.first.data(), system.row.data(), system.value.data()));
    return cholmod_.info() == Eigen::Success;
  }

  /// See \ref LSCMTraits.
  bool solve(std::span<std::complex<double>> b)
  {
    Eigen::Map<Eigen::VectorXcd> map(b.data(), static_cast<Eigen::Index>(b.size()));
    map = cholmod_.solve(map.eval()).eval();
    return cholmod_.info() == Eigen::Success;
  }

private:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;

  Eigen::CholmodDecomposition<Matrix> cholmod_;
};

/// \brief LSCM by CHOLMOD, for comparison and for those who have it with a fast BLAS.
using Cholmod_LSCM_traits = Basic_LSCM_traits<Cholmod_LSCM_solver>;

} // namespace Atlas

#endif
