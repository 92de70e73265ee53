// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_PRECONDITIONED_ITERATION_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_PRECONDITIONED_ITERATION_H

#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/conformal_system.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// y = H x, from the lower triangle.
inline void multiply(const LSCM_system& system, std::span<const Complex> x, std::vector<Complex>& y)
{
  y.assign(x.size(), 0);
  for (std::size_t c = 0; c < x.size(); ++c) {
    auto k = static_cast<std::size_t>(system.first[c]);
    const auto end = static_cast<std::size_t>(system.first[c + 1]);
    Complex sum = system.value[k].real() * x[c];
    for (++k; k < end; ++k) {
      const auto r = static_cast<std::size_t>(system.row[k]);
      const Complex& h = system.value[k];
      if (h.imag() == 0) { // all but the border
        y[r] += h.real() * x[c];
        sum += h.real() * x[r];
      } else {
        y[r] += times(h, x[c]);
        sum += times(std::conj(h), x[r]);
      }
    }
    y[c] += sum;
  }
}

inline double norm(std::span<const Complex> x)
{
  double sum = 0;
  for (const Complex& z : x)
    sum += std::norm(z);
  return std::sqrt(sum);
}

/// The real part of the inner product.
inline double real_product(std::span<const Complex> a, std::span<const Complex> b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i].real() * b[i].real() + a[i].imag() * b[i].imag();
  return sum;
}

/// r = b - H x.
inline void subtract_product(const LSCM_system& system, const std::vector<Complex>& x,
                             std::span<const Complex> b, std::vector<Complex>& r)
{
  multiply(system, x, r);
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] = b[i] - r[i];
}

inline double largest_diagonal(const LSCM_system& system)
{
  double largest = 0;
  for (std::size_t c = 0; c < system.size(); ++c)
    largest = std::max(largest, system.value[static_cast<std::size_t>(system.first[c])].real());
  return largest;
}

inline constexpr double iteration_tolerance = 1e-8;
inline constexpr std::size_t most_iterations = 1000;
inline constexpr int most_fresh_starts = 3;

/// \brief Conjugate gradients on H x = b. `precondition(r, z)` sets z to an approximate solution of H z = r,
/// by a Hermitian positive definite operator or nearly so: directions are made conjugate by the difference of
/// residuals (Polak and Ribiere), which forgives an operator that changes a little.
///
/// Ends when the residual is at most `iteration_tolerance` times b, both in the norm of the components and in
/// that of the preconditioner, which is about the norm of the energy. The residual of recurrence is replaced
/// by the true one then, and iteration goes on if that is larger.
/// \param b  replaced by the solution
/// \return `false` if the tolerance is not reached, though rounding of H x would allow it
template <typename Precondition>
bool conjugate_gradients(const LSCM_system& system, Precondition&& precondition, std::span<Complex> b,
                         const Execution& execution, LSCM_iteration_record& record)
{
  const std::size_t n = b.size();
  std::vector<Complex> x(n), r(b.begin(), b.end()), z(n), p(n), hp, before;
  const double size = norm(b);
  double first = 0, last = 1;
  int fresh_starts = 0;
  record = {};
  if (!(size > 0))
    return std::isfinite(size);
  for (bool is_fresh = true; record.iterations < most_iterations && execution.proceed();) {
    precondition(std::as_const(r), z);
    const double product = real_product(r, z), change = is_fresh ? 0 : real_product(before, z);
    first = std::max(first, product);
    const bool is_small =
        product <= iteration_tolerance * iteration_tolerance * first && norm(r) <= iteration_tolerance * size;
    if (is_small || !(product > 0) || !std::isfinite(product)) {
      if (is_fresh || fresh_starts == most_fresh_starts)
        break;
      subtract_product(system, x, b, r);
      ++fresh_starts;
      is_fresh = true;
      continue;
    }
    const double beta = is_fresh ? 0 : std::max(0., (product - change) / last);
    for (std::size_t i = 0; i < n; ++i)
      p[i] = z[i] + beta * p[i];
    multiply(system, p, hp);
    const double alpha = real_product(r, p) / real_product(p, hp);
    before = r;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * hp[i];
    }
    last = product;
    is_fresh = false;
    ++record.iterations;
  }
  subtract_product(system, x, b, r);
  record.residual = norm(r) / size;
  const double attainable = 1e-14 * norm(x) / size * largest_diagonal(system);
  std::copy(x.begin(), x.end(), b.begin());
  return record.residual <= std::max(iteration_tolerance, attainable);
}

} // namespace Atlas::internal

#endif
