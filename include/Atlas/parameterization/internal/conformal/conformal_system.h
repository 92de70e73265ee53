// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_CONFORMAL_SYSTEM_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_CONFORMAL_SYSTEM_H

#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/conformal/conformal_energy.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace Atlas::internal {

/// Numbers the free vertices. A vertex without triangles has no equation; it stays where it is.
inline std::vector<int> number_unknowns(const Chart& chart, std::span<const LSCM_pin> pins)
{
  std::vector<int> unknown(chart.number_of_vertices(), -1);
  for (const auto& corner : chart.triangles)
    for (const Index v : corner)
      unknown[v] = 0;
  for (const LSCM_pin& pin : pins)
    unknown[pin.vertex] = -1;
  int count = 0;
  for (int& number : unknown)
    if (number >= 0)
      number = count++;
  return unknown;
}

/// The block of the energy's matrix of the free vertices.
inline LSCM_system lscm_system(const Conformal_energy& energy, std::span<const LSCM_pin> pins)
{
  const Conformal_matrix h = energy.matrix();
  LSCM_system system;
  system.chart = &energy.geometry().chart();
  system.unknown = number_unknowns(*system.chart, pins);
  system.row.reserve(h.neighbor.size() / 2 + h.size());
  system.value.reserve(h.neighbor.size() / 2 + h.size());
  system.first.push_back(0);
  // Rows of H are columns of its conjugate. Unknowns increase with vertices, so the rows are in order.
  for (std::size_t v = 0; v < h.size(); ++v) {
    const int c = system.unknown[v];
    if (c < 0)
      continue;
    system.row.push_back(c);
    system.value.emplace_back(h.diagonal[v]);
    for (std::size_t k = h.first[v]; k < h.first[v + 1]; ++k)
      if (const int r = system.unknown[h.neighbor[k]]; r > c) {
        system.row.push_back(r);
        system.value.push_back(std::conj(h.entry(k)));
      }
    system.first.push_back(static_cast<int>(system.row.size()));
  }
  return system;
}

/// The components of a vector over the vertices that belong to unknowns.
inline std::vector<Complex> gather(const LSCM_system& system, std::span<const Complex> x)
{
  std::vector<Complex> result(system.size());
  for (std::size_t v = 0; v < x.size(); ++v)
    if (system.unknown[v] >= 0)
      result[static_cast<std::size_t>(system.unknown[v])] = x[v];
  return result;
}

/// x += factor * part, at the vertices of the unknowns.
inline void scatter_add(const LSCM_system& system, std::span<const Complex> part, Complex factor,
                        std::vector<Complex>& x)
{
  for (std::size_t v = 0; v < x.size(); ++v)
    if (system.unknown[v] >= 0)
      x[v] += factor * part[static_cast<std::size_t>(system.unknown[v])];
}

/// Sum of conj(a) b.
inline Complex inner_product(std::span<const Complex> a, std::span<const Complex> b)
{
  Complex sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::conj(a[i]) * b[i];
  return sum;
}

inline bool is_finite(const Complex& z)
{
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

inline bool all_finite(std::span<const Complex> u)
{
  return std::all_of(u.begin(), u.end(), [](const Complex& z) { return is_finite(z); });
}

/// \brief Moves the free vertices of u to the least conformal energy, the others being where they are.
///
/// Both solves are refinement steps, whose right-hand side is summed through the triangles; the first starts
/// from what u is at free vertices.
/// \param residual  the largest component of the last step over the extent of u
/// \return `false` if there is no finite solution, or the run has been cancelled
inline bool minimize_energy(const Conformal_energy& energy, const LSCM_system& system,
                            LSCM_solver_interface& solver, const Execution& execution,
                            std::vector<Complex>& u, double& residual)
{
  std::vector<Complex> r;
  constexpr int steps = 2;
  for (int i = 0; i < steps; ++i) {
    energy.residual(u, r);
    std::vector<Complex> step = gather(system, r);
    if (execution.is_cancelled() || !solver.solve(step))
      return false;
    double largest_step = 0, extent = 0;
    for (std::size_t v = 0; v < u.size(); ++v) {
      if (const int k = system.unknown[v]; k >= 0) {
        u[v] += step[static_cast<std::size_t>(k)];
        largest_step = std::max(largest_step, std::abs(step[static_cast<std::size_t>(k)]));
      }
      if (!is_finite(u[v]))
        return false;
      extent = std::max(extent, std::abs(u[v]));
    }
    residual = extent > 0 ? largest_step / extent : 0;
  }
  return true;
}

} // namespace Atlas::internal

#endif
