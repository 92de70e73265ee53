// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_ANGLES_ANGLE_LAYOUT_H
#define ATLAS_PARAMETERIZATION_INTERNAL_ANGLES_ANGLE_LAYOUT_H

#include <Atlas/parameterization/internal/angles/Triangle_angles.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// \brief Lays triangles of given angles into the plane all at once: the similarities that fit best in the
/// sense of least squares, the LSCM-like reconstruction of Sheffer et al. 2005, section 2.2.
///
/// Minimises the sum over the triangles of |w1 u1 + w2 u2 + w3 u3|^2 / d_T, where w are the edges of the
/// triangle with these angles. If the angles meet all conditions the minimum is zero; and small errors are
/// spread out instead of piling up from triangle to triangle.
class Angle_layout
{
public:
  Angle_layout(const Chart& chart, const std::vector<Triangle_angles>& angles)
      : chart_(chart), column_(chart.number_of_vertices(), -1)
  {
    shapes_.reserve(angles.size());
    for (const Triangle_angles& a : angles)
      shapes_.push_back(a.shape());
  }

  /// Finds u from two vertices whose u is given.
  /// \return `false` if there is no finite solution
  bool solve(const std::array<Index, 2>& pins, std::vector<Complex>& u)
  {
    number_columns(pins);
    Eigen::SimplicialLDLT<Matrix> ldlt;
    ldlt.compute(matrix());
    if (ldlt.info() != Eigen::Success)
      return false;
    constexpr int steps = 3; // the first from zero, the others refine
    for (int i = 0; i < steps; ++i) {
      const Eigen::VectorXcd change = ldlt.solve(residual(u));
      if (!change.allFinite())
        return false;
      for (std::size_t v = 0; v < u.size(); ++v)
        if (column_[v] >= 0)
          u[v] += change[column_[v]];
    }
    return true;
  }

private:
  using Matrix = Eigen::SparseMatrix<Complex>;

  void number_columns(const std::array<Index, 2>& pins)
  {
    for (const auto& corner : chart_.triangles)
      for (const Index v : corner)
        column_[v] = 0;
    for (const Index v : pins)
      column_[v] = -1;
    columns_ = 0;
    for (int& c : column_)
      if (c >= 0)
        c = columns_++;
  }

  /// The lower triangle of sum conj(w_i) w_j / (2 d_T). Imaginary parts are one half for each halfedge, so
  /// that they cancel exactly inside.
  Matrix matrix() const
  {
    std::vector<Eigen::Triplet<Complex>> entries;
    entries.reserve(6 * shapes_.size());
    for (std::size_t t = 0; t < shapes_.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const Complex &a = shapes_[t].w[i], &b = shapes_[t].w[j];
        const double re = (a.real() * b.real() + a.imag() * b.imag()) / (2 * shapes_[t].double_area);
        const int r = column_[chart_.triangles[t][i]], c = column_[chart_.triangles[t][j]];
        // The diagonal is minus the sum of the row.
        if (r >= 0)
          entries.emplace_back(r, r, -re);
        if (c >= 0)
          entries.emplace_back(c, c, -re);
        if (r >= 0 && c >= 0 && r != c)
          entries.emplace_back(std::max(r, c), std::min(r, c), Complex(re, r > c ? 0.5 : -0.5));
      }
    Matrix result(columns_, columns_);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  /// Minus the gradient, through the triangles, from differences of u.
  Eigen::VectorXcd residual(const std::vector<Complex>& u) const
  {
    Eigen::VectorXcd result = Eigen::VectorXcd::Zero(columns_);
    for (std::size_t t = 0; t < shapes_.size(); ++t) {
      const auto& [a, b, c] = chart_.triangles[t];
      const auto& w = shapes_[t].w;
      const Complex rho =
          (times(w[1], u[b] - u[a]) + times(w[2], u[c] - u[a])) / (2 * shapes_[t].double_area);
      for (int i = 0; i < 3; ++i)
        if (const int r = column_[chart_.triangles[t][i]]; r >= 0)
          result[r] -= times(std::conj(w[i]), rho);
    }
    return result;
  }

  const Chart& chart_;
  std::vector<Planar_triangle> shapes_;
  std::vector<int> column_;
  int columns_ = 0;
};

} // namespace Atlas::internal

#endif
