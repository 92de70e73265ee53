// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_BARYCENTRIC_MAP_H
#define ATLAS_PARAMETERIZATION_INTERNAL_BARYCENTRIC_MAP_H

#include <Atlas/parameterization/internal/chart_geometry.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

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

/// Solves for the inner vertices so that sum over the neighbours w of weight(v, w) (u_w - u_v) = 0. The
/// border vertices keep their u. `weight` must be symmetric and positive for the map to be one-to-one (Tutte
/// 1963, Floater 1997). One real factorization, two right-hand sides. \param entries  the weights of
/// halfedges: (v, w, weight) in any order, repeated pairs are summed
inline bool solve_symmetric(std::size_t n, const std::vector<bool>& is_fixed,
                            const std::vector<Eigen::Triplet<double>>& entries, std::vector<Complex>& u)
{
  std::vector<int> column(n, -1);
  int columns = 0;
  for (std::size_t v = 0; v < n; ++v)
    if (!is_fixed[v])
      column[v] = columns++;
  if (columns == 0)
    return true;
  std::vector<Eigen::Triplet<double>> lower;
  Eigen::MatrixX2d b = Eigen::MatrixX2d::Zero(columns, 2);
  for (const auto& e : entries) {
    const int r = column[e.row()], c = column[e.col()];
    if (r < 0)
      continue;
    lower.emplace_back(r, r, e.value());
    if (c < 0)
      b.row(r) += e.value() * Eigen::RowVector2d(u[e.col()].real(), u[e.col()].imag());
    else if (c < r)
      lower.emplace_back(r, c, -e.value());
  }
  Eigen::SparseMatrix<double> matrix(columns, columns);
  matrix.setFromTriplets(lower.begin(), lower.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(matrix);
  if (ldlt.info() != Eigen::Success)
    return false;
  const Eigen::MatrixX2d x = ldlt.solve(b);
  if (!x.allFinite())
    return false;
  for (std::size_t v = 0; v < n; ++v)
    if (column[v] >= 0)
      u[v] = {x(column[v], 0), x(column[v], 1)};
  return true;
}

} // namespace Atlas::internal

#endif
