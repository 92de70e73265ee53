// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_MULTIGRID_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_MULTIGRID_H

#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/border_strip.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>
#include <Atlas/parameterization/internal/conformal/preconditioned_iteration.h>
#include <Atlas/parameterization/internal/conformal/similarity_patches.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// \brief A two-grid cycle: Chebyshev smoothing of the fine system, its exact solution in a strip along the
/// border, the coarse system of `Similarity_patches` by its factor; then the strip and smoothing again.
/// Hermitian positive definite, as conjugate gradients need it.
class Two_grid
{
public:
  bool factorize(const LSCM_system& system, const Execution& execution)
  {
    system_ = &system;
    {
      const Graph graph = neighbors(system);
      if (!execution.proceed() || !strip_.factorize(system, graph, execution))
        return false;
      patches_.emplace(system, graph);
    }
    return execution.proceed() && coarse_.factorize(patches_->coarse(), execution);
  }

  void apply(const std::vector<Complex>& r, std::vector<Complex>& z)
  {
    std::fill(z.begin(), z.end(), Complex(0));
    smooth(r, z);
    correct_strip(r, z);
    subtract_product(*system_, z, r, residual_);
    patches_->restrict(residual_, forces_);
    (void)coarse_.solve(forces_);
    patches_->prolong(forces_, z);
    correct_strip(r, z);
    smooth(r, z);
  }

private:
  static constexpr int smoothing_steps = 4;
  static constexpr double smoothed_share =
      40; ///< eigenvalues from the largest down to this part are smoothed
  /// Of H over its diagonal: a triangle adds w w* / (2 d) to H, whose eigenvalue over its own diagonal is 3.
  static constexpr double largest_eigenvalue = 3;

  void correct_strip(const std::vector<Complex>& r, std::vector<Complex>& z)
  {
    subtract_product(*system_, z, r, residual_);
    strip_.correct(residual_, z);
  }

  double diagonal(std::size_t i) const
  {
    return system_->value[static_cast<std::size_t>(system_->first[i])].real();
  }

  /// Chebyshev's iteration on the upper part of the spectrum.
  void smooth(const std::vector<Complex>& r, std::vector<Complex>& z)
  {
    const double low = largest_eigenvalue / smoothed_share, middle = (largest_eigenvalue + low) / 2,
                 half = (largest_eigenvalue - low) / 2;
    double rho = half / middle;
    step_.assign(r.size(), 0);
    for (int k = 0; k < smoothing_steps; ++k) {
      subtract_product(*system_, z, r, residual_);
      const double next = k == 0 ? rho : 1 / (2 * middle / half - rho);
      const double keep = k == 0 ? 0 : next * rho, gain = k == 0 ? 1 / middle : 2 * next / half;
      for (std::size_t i = 0; i < z.size(); ++i) {
        step_[i] = keep * step_[i] + gain / diagonal(i) * residual_[i];
        z[i] += step_[i];
      }
      rho = next;
    }
  }

  const LSCM_system* system_ = nullptr;
  std::optional<Similarity_patches> patches_;
  Border_strip strip_;
  Hermitian_multifrontal coarse_;
  std::vector<Complex> residual_, forces_, step_;
};

} // namespace Atlas::internal

#endif
