// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_ITERATIVE_SOLVERS_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_ITERATIVE_SOLVERS_H

#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>
#include <Atlas/parameterization/internal/conformal/preconditioned_iteration.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The factor rounded to single precision, as a preconditioner.
class Rounded_cholesky
{
public:
  bool factorize(const LSCM_system& system, const Execution& execution)
  {
    return cholesky_.factorize(system, execution);
  }
  void apply(const std::vector<Complex>& r, std::vector<Complex>& z)
  {
    std::copy(r.begin(), r.end(), z.begin());
    (void)cholesky_.solve(z);
  }

private:
  Basic_hermitian_multifrontal<Panels_in_single_precision> cholesky_;
};

/// Conjugate gradients with such a preconditioner.
template <typename Preconditioner>
class Preconditioned_iteration final : public LSCM_iteration
{
public:
  bool factorize(const LSCM_system& system, const Execution& execution) override
  {
    system_ = &system;
    execution_ = execution;
    return preconditioner_.factorize(system, execution);
  }

  bool solve(std::span<Complex> b) override
  {
    return conjugate_gradients(
        *system_,
        [&](const std::vector<Complex>& r, std::vector<Complex>& z) { preconditioner_.apply(r, z); }, b,
        execution_, record);
  }

private:
  const LSCM_system* system_ = nullptr;
  Execution execution_;
  Preconditioner preconditioner_;
};

} // namespace Atlas::internal

#endif
