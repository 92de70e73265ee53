// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_CONJUGATE_GRADIENTS_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_CONJUGATE_GRADIENTS_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_traits.h>

#include <Eigen/SparseCore>

#include <complex>
#include <span>
#include <vector>

namespace Atlas::internal {

/// \brief Least squares by conjugate gradients on the real 2n' x 2(n-p) matrix A of the LSCM paper, equation
/// 4, never forming A^T A.
class Conjugate_gradients
{
public:
  bool factorize(const LSCM_system& system, const Execution&)
  {
    const std::vector<LSCM_system::Row> triangles = system.least_squares_rows();
    const int rows = static_cast<int>(triangles.size()), columns = static_cast<int>(system.size());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(12 * triangles.size());
    for (int r = 0; r < rows; ++r)
      for (int i = 0; i < 3; ++i) {
        const LSCM_system::Row& triangle = triangles[static_cast<std::size_t>(r)];
        const int c = triangle.unknown[i];
        if (c < 0)
          continue;
        const std::complex<double> m = triangle.entry[i];
        entries.emplace_back(r, c, m.real());
        entries.emplace_back(r, c + columns, -m.imag());
        entries.emplace_back(r + rows, c, m.imag());
        entries.emplace_back(r + rows, c + columns, m.real());
      }
    matrix_.resize(2 * rows, 2 * columns);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    return true;
  }

  /// A^T A is twice the matrix of the energy, so (A^T A) x = 2 b. Stops at the tolerance or when the
  /// iterations are used up; the caller sees how far it came by the residual.
  bool solve(std::span<std::complex<double>> b)
  {
    const auto n = static_cast<Eigen::Index>(b.size());
    const Eigen::Map<Eigen::VectorXcd> z(b.data(), n);
    Eigen::VectorXd right(2 * n), diagonal(2 * n);
    right << 2 * z.real(), 2 * z.imag();
    for (Eigen::Index j = 0; j < 2 * n; ++j)
      diagonal[j] = matrix_.col(j).squaredNorm();
    const Eigen::VectorXd x = iterate(right, diagonal);
    for (Eigen::Index i = 0; i < n; ++i)
      b[static_cast<std::size_t>(i)] = {x[i], x[n + i]};
    return x.allFinite();
  }

private:
  static constexpr double tolerance = 1e-12; ///< of the residual, relative to the right-hand side
  static constexpr int most_iterations = 10; ///< for each real unknown

  Eigen::VectorXd iterate(Eigen::VectorXd r, const Eigen::VectorXd& diagonal) const
  {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(r.size());
    const double goal = tolerance * r.norm();
    Eigen::VectorXd z = r.cwiseQuotient(diagonal), p = z;
    double rz = r.dot(z);
    for (Eigen::Index i = 0; i < most_iterations * r.size() && r.norm() > goal; ++i) {
      const Eigen::VectorXd ap = matrix_ * p;
      const double alpha = rz / ap.squaredNorm();
      x += alpha * p;
      r -= alpha * (matrix_.transpose() * ap);
      z = r.cwiseQuotient(diagonal);
      const double next = r.dot(z);
      p = z + next / rz * p;
      rz = next;
    }
    return x;
  }

  Eigen::SparseMatrix<double> matrix_;
};

} // namespace Atlas::internal

#endif
