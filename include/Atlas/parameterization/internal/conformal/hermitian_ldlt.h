// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_HERMITIAN_LDLT_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_HERMITIAN_LDLT_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_traits.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <complex>
#include <span>

namespace Atlas::internal {

/// Sparse Hermitian LDL* of Eigen, with approximate minimum degree: the fastest for some thousand vertices.
class Hermitian_LDLT
{
public:
  bool factorize(const LSCM_system& system, const Execution&)
  {
    const auto n = static_cast<Eigen::Index>(system.size());
    ldlt_.compute(Eigen::Map<const Matrix>(n, n, static_cast<Eigen::Index>(system.value.size()),
                                           system.first.data(), system.row.data(), system.value.data()));
    return ldlt_.info() == Eigen::Success;
  }

  bool solve(std::span<std::complex<double>> b)
  {
    Eigen::Map<Eigen::VectorXcd> map(b.data(), static_cast<Eigen::Index>(b.size()));
    map = ldlt_.solve(map.eval()).eval();
    return true;
  }

private:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;

  Eigen::SimplicialLDLT<Matrix> ldlt_;
};

} // namespace Atlas::internal

#endif
