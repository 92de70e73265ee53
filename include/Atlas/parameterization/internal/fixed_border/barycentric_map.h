// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_BARYCENTRIC_MAP_H
#define ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_BARYCENTRIC_MAP_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// Puts a border loop counterclockwise on the unit circle. Each edge gets an arc in proportion to its length,
/// but `least_share` of the mean arc at least, so that no two vertices meet; 1 makes all arcs equal.
inline void place_on_circle(const Chart_geometry& geometry, const std::vector<Index>& border,
                            double least_share, std::vector<Complex>& u)
{
  const std::size_t n = border.size();
  std::vector<double> arc(n);
  double perimeter = 0;
  for (std::size_t i = 0; i < n; ++i)
    perimeter += arc[i] = geometry.distance(border[i], border[(i + 1) % n]);
  const double least = least_share * perimeter / static_cast<double>(n);
  double total = 0;
  for (double& a : arc)
    total += a = least_share < 1 && perimeter > 0 ? std::max(a, least) : 1;
  double angle = 0;
  for (std::size_t i = 0; i < n; ++i) {
    u[border[i]] = std::polar(1., angle);
    angle += 2 * std::acos(-1.) * arc[i] / total;
  }
}

/// The system sum over the neighbours w of weight(v, w) (u_w - u_v) = 0 for the free vertices v.
struct Barycentric_system
{
  std::vector<int> column;
  std::vector<Eigen::Triplet<double>> matrix;
  Eigen::MatrixX2d right;
  int columns = 0;

  /// \param entries  (v, w, weight) in any order, repeated pairs are summed
  Barycentric_system(std::size_t n, const std::vector<bool>& is_fixed,
                     const std::vector<Eigen::Triplet<double>>& entries, const std::vector<Complex>& u)
      : column(n, -1)
  {
    for (std::size_t v = 0; v < n; ++v)
      if (!is_fixed[v])
        column[v] = columns++;
    right = Eigen::MatrixX2d::Zero(columns, 2);
    for (const auto& e : entries) {
      const int r = column[e.row()], c = column[e.col()];
      if (r < 0)
        continue;
      matrix.emplace_back(r, r, e.value());
      if (c < 0)
        right.row(r) += e.value() * Eigen::RowVector2d(u[e.col()].real(), u[e.col()].imag());
      else
        matrix.emplace_back(r, c, -e.value());
    }
  }

  /// Solves with a sparse solver of Eigen and writes the free vertices' u.
  template <typename Solver>
  bool solve(std::vector<Complex>& u) const
  {
    if (columns == 0)
      return true;
    Eigen::SparseMatrix<double> a(columns, columns);
    a.setFromTriplets(matrix.begin(), matrix.end());
    Solver solver;
    solver.compute(a);
    if (solver.info() != Eigen::Success)
      return false;
    const Eigen::MatrixX2d x = solver.solve(right);
    if (!x.allFinite())
      return false;
    for (std::size_t v = 0; v < column.size(); ++v)
      if (column[v] >= 0)
        u[v] = {x(column[v], 0), x(column[v], 1)};
    return true;
  }
};

/// The border vertices keep their u. With symmetric positive weights the map is one-to-one if the border is
/// convex (Tutte 1963, Floater 1997).
inline bool solve_symmetric(std::size_t n, const std::vector<bool>& is_fixed,
                            const std::vector<Eigen::Triplet<double>>& entries, std::vector<Complex>& u)
{
  return Barycentric_system(n, is_fixed, entries, u)
      .solve<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>(u);
}

inline bool solve_unsymmetric(std::size_t n, const std::vector<bool>& is_fixed,
                              const std::vector<Eigen::Triplet<double>>& entries, std::vector<Complex>& u)
{
  return Barycentric_system(n, is_fixed, entries, u).solve<Eigen::SparseLU<Eigen::SparseMatrix<double>>>(u);
}

} // namespace Atlas::internal

#endif
