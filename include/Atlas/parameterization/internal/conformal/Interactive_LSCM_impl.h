// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_INTERACTIVE_LSCM_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_INTERACTIVE_LSCM_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/conformal/conformal_system.h>
#include <Atlas/parameterization/internal/conformal/pins.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace Atlas {

/// With p and q held far apart, K is the block of H of the other vertices, the one that is factorized. Every
/// map of least energy with forces (H u)_j = lambda_j at pinned vertices j, and none elsewhere, is
///
///     u = sum of lambda_j k_j + alpha w + c,   k_j = K^-1 e_j (0 at p and q),
///
/// w being LSCM's map with p at 0 and q at 1, if the forces have no sum and s alpha = sum of conj(w_j)
/// lambda_j, where s = w* H w is twice the energy of w. On a developable chart s is 0, which does no harm.
/// The places of the pins are as many equations as there are forces.
struct Interactive_LSCM::State
{
  State(Chart&& c, std::unique_ptr<internal::LSCM_solver_interface>&& solver_, const Execution& execution)
      : chart((internal::check_chart(c), std::move(c))), geometry(chart), energy(geometry),
        solver(std::move(solver_))
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    if (chart.triangles.empty())
      return;
    const std::vector<LSCM_pin> held = internal::default_pins(geometry);
    system = internal::lscm_system(energy, held);
    w.assign(chart.number_of_vertices(), 0);
    w[held[1].vertex] = 1;
    double residual = 0;
    status = Chart_status::valid;
    if (system.size() > 0 && !(solver->factorize(system, execution) &&
                               internal::minimize_energy(energy, system, *solver, execution, w, residual)))
      status = execution.is_cancelled() ? Chart_status::cancelled : Chart_status::solver_failed;
    s = 2 * energy.value(w);
    is_held = {held[0].vertex, held[1].vertex};
  }

  /// Whether the vertex has triangles, and so a place in the equations.
  bool has_triangles(Index v) const { return system.unknown[v] >= 0 || v == is_held[0] || v == is_held[1]; }

  /// Replaces b by K^-1 b, which is 0 at the vertices that are not unknowns.
  bool apply_inverse(std::vector<internal::Complex>& b)
  {
    std::vector<internal::Complex> part = internal::gather(system, b);
    if (!part.empty() && !solver->solve(part))
      return false;
    std::fill(b.begin(), b.end(), 0);
    internal::scatter_add(system, part, 1, b);
    return true;
  }

  /// Has k_j for these vertices, and no others, in `response`.
  bool find_responses(const std::vector<Index>& pinned)
  {
    std::map<Index, std::vector<internal::Complex>> found;
    for (const Index j : pinned) {
      if (const auto old = response.find(j); old != response.end()) {
        found.insert(response.extract(old));
        continue;
      }
      std::vector<internal::Complex> k(chart.number_of_vertices(), 0);
      k[j] = 1;
      if (!apply_inverse(k))
        return false;
      found.emplace(j, std::move(k));
    }
    response = std::move(found);
    return true;
  }

  /// The matrix of the equations for the forces, alpha and c.
  Eigen::MatrixXcd equations(const std::vector<Index>& pinned) const
  {
    const auto m = static_cast<Eigen::Index>(pinned.size());
    Eigen::MatrixXcd a = Eigen::MatrixXcd::Zero(m + 2, m + 2);
    for (Eigen::Index j = 0; j < m; ++j) {
      const Index v = pinned[static_cast<std::size_t>(j)];
      for (Eigen::Index i = 0; i < m; ++i)
        a(i, j) = response.at(v)[pinned[static_cast<std::size_t>(i)]];
      a(j, m) = w[v];
      a(m, j) = -std::conj(w[v]);
      a(j, m + 1) = a(m + 1, j) = 1;
    }
    a(m, m) = s;
    return a;
  }

  /// Adds to u the map that moves the pinned vertices by `move` and has the forces b at the others.
  bool add_map(const std::vector<Index>& pinned, const Eigen::FullPivLU<Eigen::MatrixXcd>& lu,
               const std::vector<internal::Complex>& move, std::vector<internal::Complex> b,
               std::vector<internal::Complex>& u)
  {
    const auto m = static_cast<Eigen::Index>(pinned.size());
    Eigen::VectorXcd right(m + 2);
    right[m] = internal::inner_product(w, b);
    right[m + 1] = 0;
    for (const internal::Complex& z : b)
      right[m + 1] -= z;
    if (std::any_of(b.begin(), b.end(), [](const internal::Complex& z) { return z != 0.; }) &&
        !apply_inverse(b))
      return false;
    for (Eigen::Index i = 0; i < m; ++i)
      right[i] = move[static_cast<std::size_t>(i)] - b[pinned[static_cast<std::size_t>(i)]];
    const Eigen::VectorXcd x = lu.solve(right);
    for (std::size_t v = 0; v < u.size(); ++v)
      if (has_triangles(static_cast<Index>(v)))
        u[v] += b[v] + x[m] * w[v] + x[m + 1];
    for (Eigen::Index j = 0; j < m; ++j) {
      const std::vector<internal::Complex>& k = response.at(pinned[static_cast<std::size_t>(j)]);
      for (std::size_t v = 0; v < u.size(); ++v)
        u[v] += x[j] * k[v];
    }
    return internal::all_finite(u);
  }

  /// The map, and one step of refinement whose forces are summed through the triangles.
  bool solve(std::span<const LSCM_pin> pins, std::vector<internal::Complex>& u)
  {
    std::vector<Index> pinned;
    std::vector<internal::Complex> move;
    for (const LSCM_pin& pin : pins)
      if (has_triangles(pin.vertex)) {
        pinned.push_back(pin.vertex);
        move.push_back(internal::image(geometry, pin));
      }
    if (pinned.size() < 2 || !find_responses(pinned))
      return false;
    const Eigen::FullPivLU<Eigen::MatrixXcd> lu(equations(pinned));
    u.assign(chart.number_of_vertices(), 0);
    std::vector<internal::Complex> b(u.size(), 0);
    if (!add_map(pinned, lu, move, b, u))
      return false;
    energy.residual(u, b);
    for (std::size_t i = 0; i < pinned.size(); ++i) {
      b[pinned[i]] = 0;
      move[i] -= u[pinned[i]];
    }
    if (!add_map(pinned, lu, move, std::move(b), u))
      return false;
    for (const LSCM_pin& pin : pins)
      u[pin.vertex] = internal::image(geometry, pin);
    return true;
  }

  Chart chart;
  internal::Chart_geometry geometry;
  internal::Conformal_energy energy;
  LSCM_system system;
  std::unique_ptr<internal::LSCM_solver_interface> solver;
  Chart_status status = Chart_status::not_a_disc;
  std::array<Index, 2> is_held{no_index, no_index};
  std::vector<internal::Complex> w;
  double s = 0;
  std::map<Index, std::vector<internal::Complex>> response; ///< k_j of the vertices j that were pinned last
};

ATLAS_INLINE Interactive_LSCM::Interactive_LSCM(Chart chart, const Execution& execution)
    : Interactive_LSCM(std::move(chart), std::make_unique<internal::LSCM_solver_model<Direct_LSCM_solver>>(),
                       execution)
{}

ATLAS_INLINE Interactive_LSCM::Interactive_LSCM(Chart chart,
                                                std::unique_ptr<internal::LSCM_solver_interface> solver,
                                                const Execution& execution)
    : state_(std::make_unique<State>(std::move(chart), std::move(solver), execution))
{}

ATLAS_INLINE Interactive_LSCM::~Interactive_LSCM() = default;
ATLAS_INLINE Interactive_LSCM::Interactive_LSCM(Interactive_LSCM&&) noexcept = default;
ATLAS_INLINE Interactive_LSCM& Interactive_LSCM::operator=(Interactive_LSCM&&) noexcept = default;

ATLAS_INLINE Chart_status Interactive_LSCM::status() const
{
  return state_->status;
}

ATLAS_INLINE const Chart& Interactive_LSCM::chart() const
{
  return state_->chart;
}

ATLAS_INLINE Chart_status Interactive_LSCM::solve(std::span<const LSCM_pin> pins)
{
  internal::check_pins(pins, state_->chart.number_of_vertices());
  if (state_->status != Chart_status::valid)
    return state_->status;
  std::vector<internal::Complex> u;
  if (!state_->solve(pins, u))
    return Chart_status::solver_failed;
  internal::store_coordinates(state_->geometry, u, 1, state_->chart);
  return Chart_status::valid;
}

} // namespace Atlas

#endif
