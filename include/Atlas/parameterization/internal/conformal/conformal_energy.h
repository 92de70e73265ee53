// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_CONFORMAL_ENERGY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_CONFORMAL_ENERGY_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace Atlas::internal {

/// \brief A Hermitian matrix whose imaginary parts are multiples of 1/2, in rows: `neighbor`, `re` and
/// `half_turns` (twice the imaginary part) of row v are at [first[v], first[v+1]), sorted by neighbour.
struct Conformal_matrix
{
  std::vector<std::size_t> first;
  std::vector<Index> neighbor;
  std::vector<double> re;
  std::vector<std::int8_t> half_turns;
  std::vector<double> diagonal;

  std::size_t size() const { return diagonal.size(); }
  Complex entry(std::size_t k) const { return {re[k], 0.5 * half_turns[k]}; }
};

/// \brief The conformal energy of a chart, the paper's C(U) / 2 with d_T twice the area:
/// sum over the triangles of |W1 U1 + W2 U2 + W3 U3|^2 / (4 d_T), which is Dirichlet energy minus area.
class Conformal_energy
{
public:
  explicit Conformal_energy(const Chart_geometry& geometry) : geometry_(geometry) {}

  const Chart_geometry& geometry() const { return geometry_; }
  std::size_t size() const { return geometry_.number_of_vertices(); }

  /// Sum over the triangles, each by the defect of the Cauchy-Riemann equation.
  double value(std::span<const Complex> u) const
  {
    double sum = 0;
    for (Index t = 0; t < geometry_.number_of_triangles(); ++t) {
      const Planar_triangle shape = geometry_.planar(t);
      sum += std::norm(defect(shape, t, u)) / (4 * shape.double_area);
    }
    return sum;
  }

  /// r = -H u, summed through the triangles from differences of u, which is far more precise than a product
  /// with the assembled matrix where u varies slowly.
  void residual(std::span<const Complex> u, std::vector<Complex>& r) const
  {
    r.assign(size(), Complex(0));
    for (Index t = 0; t < geometry_.number_of_triangles(); ++t) {
      const Planar_triangle shape = geometry_.planar(t);
      const Complex rho = defect(shape, t, u) / (2 * shape.double_area);
      for (int i = 0; i < 3; ++i)
        r[geometry_.chart().triangles[t][i]] -= times(std::conj(shape.w[i]), rho);
    }
  }

  /// H with energy = U* H U / 2. Off the diagonal the real parts are minus half the cotangents (from cross
  /// products, not edge lengths, which lose caps); the imaginary parts, one half per halfedge, cancel exactly
  /// inside. O(n).
  Conformal_matrix matrix() const
  {
    const std::size_t n = size();
    const auto& triangles = geometry_.chart().triangles;
    std::vector<std::size_t> place(n + 1, 0);
    for (const auto& corner : triangles)
      for (const Index v : corner)
        place[v + 1] += 2;
    for (std::size_t v = 0; v < n; ++v)
      place[v + 1] += place[v];
    std::vector<Entry> entries(place[n]);
    for (Index t = 0; t < triangles.size(); ++t) {
      const Planar_triangle shape = geometry_.planar(t);
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const Complex &a = shape.w[i], &b = shape.w[j];
        const double re = (a.real() * b.real() + a.imag() * b.imag()) / (2 * shape.double_area);
        const Index v = triangles[t][i], w = triangles[t][j];
        entries[place[v]++] = {w, 1, re};
        entries[place[w]++] = {v, -1, re};
      }
    }
    return merged(entries, place);
  }

private:
  struct Entry
  {
    Index neighbor;
    std::int32_t half_turns;
    double re;
  };

  Complex defect(const Planar_triangle& shape, Index t, std::span<const Complex> u) const
  {
    const auto& corner = geometry_.chart().triangles[t];
    const Complex u0 = u[corner[0]];
    return times(shape.w[1], u[corner[1]] - u0) + times(shape.w[2], u[corner[2]] - u0);
  }

  /// Sums entries of the same place. `end[v]` is one past the last entry of row v.
  static Conformal_matrix merged(std::vector<Entry>& entries, const std::vector<std::size_t>& end)
  {
    const std::size_t n = end.size() - 1;
    Conformal_matrix h;
    h.first.assign(n + 1, 0);
    h.diagonal.assign(n, 0);
    h.neighbor.reserve(entries.size() / 2 + n);
    h.re.reserve(entries.size() / 2 + n);
    h.half_turns.reserve(entries.size() / 2 + n);
    for (std::size_t v = 0; v < n; ++v) {
      const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(v == 0 ? 0 : end[v - 1]),
                 stop = entries.begin() + static_cast<std::ptrdiff_t>(end[v]);
      std::stable_sort(begin, stop, [](const Entry& a, const Entry& b) { return a.neighbor < b.neighbor; });
      for (auto e = begin; e != stop;) {
        const Index w = e->neighbor;
        double re = 0;
        int half_turns = 0;
        for (; e != stop && e->neighbor == w; ++e) {
          re += e->re;
          half_turns += e->half_turns;
        }
        if (w == v)
          continue; // a triangle that repeats a vertex
        h.neighbor.push_back(w);
        h.re.push_back(re);
        h.half_turns.push_back(static_cast<std::int8_t>(std::clamp(half_turns, -127, 127)));
        h.diagonal[v] -= re;
      }
      h.first[v + 1] = h.neighbor.size();
    }
    return h;
  }

  const Chart_geometry& geometry_;
};

} // namespace Atlas::internal

#endif
