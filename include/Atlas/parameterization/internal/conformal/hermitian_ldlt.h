// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_HERMITIAN_LDLT_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_HERMITIAN_LDLT_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <complex>
#include <vector>

namespace Atlas::internal {

/// The lower triangle of the block of the free vertices.
template <typename NumberType>
Eigen::SparseMatrix<std::complex<NumberType>>
free_block(const Conformal_matrix& h, const std::vector<Index>& column, std::size_t number_of_columns)
{
  using Matrix = Eigen::SparseMatrix<std::complex<NumberType>>;
  const auto order = static_cast<Eigen::Index>(number_of_columns);
  Matrix matrix(order, order);
  // Columns in increasing order of vertices have increasing rows, since free numbers increase with vertices.
  matrix.reserve(static_cast<Eigen::Index>(h.neighbor.size() / 2 + h.size()));
  for (std::size_t v = 0; v < h.size(); ++v) {
    const Index c = column[v];
    if (c == no_index)
      continue;
    matrix.startVec(c);
    matrix.insertBack(c, c) = static_cast<NumberType>(h.diagonal[v]);
    for (std::size_t k = h.first[v]; k < h.first[v + 1]; ++k)
      if (const Index r = column[h.neighbor[k]]; r != no_index && r > c) // entry (r, c) = conj of (v, w)
        matrix.insertBack(r, c) = std::complex<NumberType>(std::conj(h.entry(k)));
  }
  matrix.finalize();
  return matrix;
}

/// Sparse Hermitian LDL* of Eigen, with approximate minimum degree: the fastest for some thousand vertices.
template <typename NumberType>
class Hermitian_LDLT
{
public:
  template <typename System>
  bool factorize(const System& system, const Execution&)
  {
    ldlt_.compute(free_block<NumberType>(system.energy.matrix(), system.column, system.number_of_columns));
    return ldlt_.info() == Eigen::Success;
  }

  bool solve(std::vector<Complex>& b) const
  {
    Eigen::Map<Eigen::VectorXcd> map(b.data(), static_cast<Eigen::Index>(b.size()));
    map = ldlt_.solve(map.template cast<std::complex<NumberType>>().eval())
              .template cast<std::complex<double>>()
              .eval();
    return true;
  }

private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<std::complex<NumberType>>> ldlt_;
};

} // namespace Atlas::internal

#endif
