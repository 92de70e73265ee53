// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_LSCM_TRAITS_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_LSCM_TRAITS_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/conjugate_gradients.h>
#include <Atlas/parameterization/internal/conformal/hermitian_ldlt.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace Atlas {

namespace internal {

ATLAS_INLINE void check_pins(std::span<const LSCM_pin> pins)
{
  require(pins.size() >= 2, "pins", "must be two at least, or none for those that are chosen");
  for (const LSCM_pin& pin : pins)
    require(std::isfinite(pin.uv.x()) && std::isfinite(pin.uv.y()), "pins", "must have finite coordinates");
  require(std::any_of(pins.begin(), pins.end(), [&](const LSCM_pin& p) { return p.uv != pins[0].uv; }),
          "pins", "must not all be at one place, or the whole chart would be");
  std::vector<Index> vertices;
  for (const LSCM_pin& pin : pins)
    vertices.push_back(pin.vertex);
  std::sort(vertices.begin(), vertices.end());
  require(std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end(), "pins",
          "must name each vertex only once");
}

ATLAS_INLINE void check_pins(std::span<const LSCM_pin> pins, std::size_t number_of_vertices)
{
  for (const LSCM_pin& pin : pins)
    require(pin.vertex < number_of_vertices, "pins", "must be vertices of the chart");
  check_pins(pins);
}

/// From so many unknowns on dense fronts win over their overhead.
inline constexpr std::size_t least_multifrontal_system = 4000;

} // namespace internal

ATLAS_INLINE bool Direct_LSCM_solver::factorize(const LSCM_system& system, const Execution& execution)
{
  if (system.size() >= internal::least_multifrontal_system)
    chosen_ = std::make_unique<internal::LSCM_solver_model<internal::Hermitian_multifrontal>>();
  else
    chosen_ = std::make_unique<internal::LSCM_solver_model<internal::Hermitian_LDLT>>();
  return chosen_->factorize(system, execution);
}

ATLAS_INLINE bool Direct_LSCM_solver::solve(std::span<std::complex<double>> b)
{
  return chosen_ && chosen_->solve(b);
}

ATLAS_INLINE bool Conjugate_gradient_LSCM_solver::factorize(const LSCM_system& system,
                                                            const Execution& execution)
{
  chosen_ = std::make_unique<internal::LSCM_solver_model<internal::Conjugate_gradients>>();
  return chosen_->factorize(system, execution);
}

ATLAS_INLINE bool Conjugate_gradient_LSCM_solver::solve(std::span<std::complex<double>> b)
{
  return chosen_ && chosen_->solve(b);
}

} // namespace Atlas

#endif
