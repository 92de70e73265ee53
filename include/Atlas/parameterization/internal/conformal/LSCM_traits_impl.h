// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_LSCM_TRAITS_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_LSCM_TRAITS_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/conjugate_gradients.h>
#include <Atlas/parameterization/internal/conformal/hermitian_ldlt.h>
#include <Atlas/parameterization/internal/conformal/hermitian_multifrontal.h>
#include <Atlas/parameterization/internal/conformal/iterative_solvers.h>
#include <Atlas/parameterization/internal/conformal/multigrid.h>
#include <Atlas/parameterization/internal/conformal/out_of_core_cholesky.h>
#include <Atlas/parameterization/internal/conformal/pins.h>
#include <Atlas/parameterization/internal/geometry/graph_diameter.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
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

ATLAS_INLINE std::vector<LSCM_pin> diameter_pins(const Chart& chart, std::size_t most_visits)
{
  internal::check_chart(chart);
  if (chart.triangles.empty())
    return {};
  const internal::Chart_geometry geometry(chart);
  std::vector<bool> candidates = internal::border_vertices(chart);
  if (std::none_of(candidates.begin(), candidates.end(), [](bool is_on_border) { return is_on_border; }))
    candidates.assign(candidates.size(), true);
  const internal::Graph_diameter found =
      internal::Graph_diameter_search(geometry, candidates).run(most_visits);
  if (!(found.length > 0))
    return internal::default_pins(geometry);
  return {{found.first, Point_2(0, 0)}, {found.second, Point_2(geometry.to_model(found.length), 0)}};
}

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

ATLAS_INLINE bool Preconditioned_CG_LSCM_solver::factorize(const LSCM_system& system,
                                                           const Execution& execution)
{
  chosen_ = std::make_unique<internal::Preconditioned_iteration<internal::Rounded_cholesky>>();
  return chosen_->factorize(system, execution);
}

ATLAS_INLINE bool Preconditioned_CG_LSCM_solver::solve(std::span<std::complex<double>> b)
{
  return chosen_ && chosen_->solve(b);
}

ATLAS_INLINE bool Multigrid_LSCM_solver::factorize(const LSCM_system& system, const Execution& execution)
{
  chosen_ = std::make_unique<internal::Preconditioned_iteration<internal::Two_grid>>();
  return chosen_->factorize(system, execution);
}

ATLAS_INLINE bool Multigrid_LSCM_solver::solve(std::span<std::complex<double>> b)
{
  return chosen_ && chosen_->solve(b);
}

ATLAS_INLINE Out_of_core_LSCM_solver::Out_of_core_LSCM_solver(std::size_t memory_limit, std::string directory)
    : memory_limit_(memory_limit), directory_(std::move(directory))
{}

ATLAS_INLINE bool Out_of_core_LSCM_solver::factorize(const LSCM_system& system, const Execution& execution)
{
  auto solver = internal::out_of_core_cholesky(system, memory_limit_, directory_);
  chosen_ = std::make_unique<decltype(solver)>(std::move(solver));
  return chosen_->factorize(system, execution);
}

ATLAS_INLINE bool Out_of_core_LSCM_solver::solve(std::span<std::complex<double>> b)
{
  return chosen_ && chosen_->solve(b);
}

} // namespace Atlas

#endif
