// SPDX-License-Identifier: MIT
// This header needs CHOLMOD of SuiteSparse, whose core is LGPL and whose supernodal part, used here for large
// charts, is GPL. Nothing else in Atlas includes it.
#ifndef ATLAS_PARAMETERIZATION_CHOLMOD_LSCM_TRAITS_H
#define ATLAS_PARAMETERIZATION_CHOLMOD_LSCM_TRAITS_H

#include <Atlas/parameterization/LSCM_traits.h>

#include <Eigen/CholmodSupport>

#include <vector>

namespace Atlas {

namespace internal {

/// Complex L L* of CHOLMOD, which chooses order and method.
class Cholmod_solver
{
public:
  bool factorize(const LSCM_system& system, const Execution&)
  {
    cholmod_.compute(free_block<double>(system.energy.matrix(), system.column, system.number_of_columns));
    return cholmod_.info() == Eigen::Success;
  }

  bool solve(std::vector<Complex>& b) const
  {
    Eigen::Map<Eigen::VectorXcd> map(b.data(), static_cast<Eigen::Index>(b.size()));
    map = cholmod_.solve(map.eval()).eval();
    return cholmod_.info() == Eigen::Success;
  }

private:
  Eigen::CholmodDecomposition<Eigen::SparseMatrix<std::complex<double>>> cholmod_;
};

} // namespace internal

/// \brief LSCM by CHOLMOD, for comparison and for those who have it with a fast BLAS.
using Cholmod_LSCM_traits = Basic_LSCM_traits<internal::Cholmod_solver>;

} // namespace Atlas

#endif
