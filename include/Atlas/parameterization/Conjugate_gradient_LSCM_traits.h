// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_CONJUGATE_GRADIENT_LSCM_TRAITS_H
#define ATLAS_PARAMETERIZATION_CONJUGATE_GRADIENT_LSCM_TRAITS_H

#include <Atlas/parameterization/LSCM_traits.h>

#include <Eigen/SparseCore>

#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas {

namespace internal {

/// \brief Least squares by conjugate gradients on the real 2n' x 2(n-p) matrix A of the LSCM paper, equation
/// 4, never forming A^T A.
class Conjugate_gradient_solver
{
public:
  bool factorize(const LSCM_system& system, const Execution&)
  {
    const Chart_geometry& geometry = system.energy.geometry();
    const auto rows = static_cast<Eigen::Index>(geometry.number_of_triangles()),
               columns = static_cast<Eigen::Index>(system.number_of_columns);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(12 * geometry.number_of_triangles());
    for (Index t = 0; t < geometry.number_of_triangles(); ++t) {
      const Planar_triangle shape = geometry.planar(t);
      const double root = std::sqrt(shape.double_area);
      for (int i = 0; i < 3; ++i) {
        const Index column = system.column[geometry.chart().triangles[t][i]];
        if (column == no_index)
          continue;
        const Complex m = shape.w[i] / root;
        const int r = static_cast<int>(t), c = static_cast<int>(column);
        const int r2 = r + static_cast<int>(rows), c2 = c + static_cast<int>(columns);
        entries.emplace_back(r, c, m.real());
        entries.emplace_back(r, c2, -m.imag());
        entries.emplace_back(r2, c, m.imag());
        entries.emplace_back(r2, c2, m.real());
      }
    }
    matrix_.resize(2 * rows, 2 * columns);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    return true;
  }

  /// A^T A is twice the matrix of the energy, so (A^T A) x = 2 b. Stops at the tolerance or when the
  /// iterations are used up; the caller sees how far it came by the residual.
  bool solve(std::vector<Complex>& b) const
  {
    const auto n = static_cast<Eigen::Index>(b.size());
    Eigen::VectorXd right(2 * n), diagonal(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      right[i] = 2 * b[i].real();
      right[n + i] = 2 * b[i].imag();
    }
    for (Eigen::Index j = 0; j < 2 * n; ++j)
      diagonal[j] = matrix_.col(j).squaredNorm();
    const Eigen::VectorXd x = iterate(right, diagonal);
    for (Eigen::Index i = 0; i < n; ++i)
      b[i] = {x[i], x[n + i]};
    return x.allFinite();
  }

private:
  static constexpr double tolerance = 1e-12; ///< of the residual, relative to the right-hand side

  Eigen::VectorXd iterate(Eigen::VectorXd r, const Eigen::VectorXd& diagonal) const
  {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(r.size());
    const double goal = tolerance * r.norm();
    Eigen::VectorXd z = r.cwiseQuotient(diagonal), p = z;
    double rz = r.dot(z);
    for (Eigen::Index i = 0; i < 10 * r.size() && r.norm() > goal; ++i) {
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

} // namespace internal

/// \brief The solver of the LSCM paper: conjugate gradients on the real matrix A of its equation 4, with the
/// diagonal as preconditioner.
///
/// For study: the condition of LSCM grows with the square of the number of vertices, so that direct solvers
/// win at every size.
using Conjugate_gradient_LSCM_traits = Basic_LSCM_traits<internal::Conjugate_gradient_solver>;

} // namespace Atlas

#endif
