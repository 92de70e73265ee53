// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_CONJUGATE_GRADIENTS_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_CONJUGATE_GRADIENTS_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace Atlas::internal {

/// \brief Least squares by conjugate gradients on the 2n' x 2(n-p) matrix A of the LSCM paper, equation 4,
/// never forming A^T A.
///
/// A is the complex M_f written with real numbers. It is applied here triangle by triangle in complex
/// numbers: the same products, inner products and iterates, with half of the work.
class Conjugate_gradients
{
public:
  bool factorize(const LSCM_system& system, const Execution& execution)
  {
    execution_ = execution;
    triangles_ = system.least_squares_rows();
    diagonal_.assign(system.size(), 0);
    for (const LSCM_system::Row& triangle : triangles_)
      for (int i = 0; i < 3; ++i)
        if (const int c = triangle.unknown[i]; c >= 0)
          diagonal_[static_cast<std::size_t>(c)] += std::norm(triangle.entry[i]);
    return true;
  }

  /// A^T A is twice the matrix of the energy, so (A^T A) x = 2 b. Stops at the tolerance or when the
  /// iterations are used up; the caller sees how far it came by the residual. `false` once cancelled.
  bool solve(std::span<Complex> b)
  {
    std::vector<Complex> x(b.size()), r(b.begin(), b.end()), z(b.size()), p(b.size()), q(b.size());
    for (Complex& residual : r)
      residual *= 2;
    const double goal = tolerance * tolerance * squared_norm(r);
    double rz = precondition(r, z);
    p = z;
    for (std::size_t i = 0; i < most_iterations * 2 * b.size() && squared_norm(r) > goal; ++i) {
      const double alpha = rz / apply(p, q);
      for (std::size_t c = 0; c < b.size(); ++c) {
        x[c] += alpha * p[c];
        r[c] -= alpha * q[c];
      }
      const double next = precondition(r, z), beta = next / rz;
      for (std::size_t c = 0; c < b.size(); ++c)
        p[c] = z[c] + beta * p[c];
      rz = next;
      if (i % iterations_between_questions == 0 && !execution_.proceed())
        return false;
    }
    std::copy(x.begin(), x.end(), b.begin());
    return std::all_of(x.begin(), x.end(),
                       [](const Complex& c) { return std::isfinite(c.real()) && std::isfinite(c.imag()); });
  }

private:
  static constexpr double tolerance = 1e-8;          ///< of the residual, relative to the right-hand side
  static constexpr std::size_t most_iterations = 10; ///< for each real unknown
  static constexpr std::size_t iterations_between_questions = 64;

  /// q = A^T A p; returns |A p|^2.
  double apply(const std::vector<Complex>& p, std::vector<Complex>& q) const
  {
    std::fill(q.begin(), q.end(), Complex(0));
    double sum = 0;
    for (const LSCM_system::Row& triangle : triangles_) {
      Complex defect = 0;
      for (int i = 0; i < 3; ++i)
        if (const int c = triangle.unknown[i]; c >= 0)
          defect += times(triangle.entry[i], p[static_cast<std::size_t>(c)]);
      sum += std::norm(defect);
      for (int i = 0; i < 3; ++i)
        if (const int c = triangle.unknown[i]; c >= 0)
          q[static_cast<std::size_t>(c)] += times(std::conj(triangle.entry[i]), defect);
    }
    return sum;
  }

  /// z = r over the diagonal; returns the inner product of the two.
  double precondition(const std::vector<Complex>& r, std::vector<Complex>& z) const
  {
    double sum = 0;
    for (std::size_t c = 0; c < r.size(); ++c) {
      z[c] = r[c] / diagonal_[c];
      sum += r[c].real() * z[c].real() + r[c].imag() * z[c].imag();
    }
    return sum;
  }

  static double squared_norm(const std::vector<Complex>& r)
  {
    double sum = 0;
    for (const Complex& c : r)
      sum += std::norm(c);
    return sum;
  }

  Execution execution_; ///< of the call of factorize()
  std::vector<LSCM_system::Row> triangles_;
  std::vector<double> diagonal_; ///< of A^T A, the same for the real and the imaginary part
};

} // namespace Atlas::internal

#endif
