// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_ENERGY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_ENERGY_H

#include <Atlas/parameterization/internal/chart_geometry.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace Atlas::internal {

/// What an isotropic energy says of one triangle. The map is z -> f z + g conj(z) there; r = |f|, s = |g|,
/// and the singular values are r + s and r - s.
struct Triangle_energy
{
  double value;
  double dr, ds;           ///< derivatives
  double krr, krs, kss;    ///< a positive semidefinite stand-in for the second derivatives
  double tangential_f = 0; ///< dr / r and ds / s, the curvatures across, not below zero
  double tangential_g = 0;
};

/// \brief Symmetric Dirichlet energy, sum of the squares of the singular values and of their inverses: 4 for
/// an isometry (Smith and Schaefer 2015).
struct Symmetric_dirichlet
{
  static double value(double r2, double s2)
  {
    const double det = r2 - s2;
    return det > 0 ? 2 * (r2 + s2) * (1 + 1 / (det * det)) : std::numeric_limits<double>::infinity();
  }

  /// h(x) = x^2 + x^-2. In place of h'' stands the secant h'(x) / (x - 1), the curvature of the parabola with
  /// this slope and its minimum at 1: it is what SLIM (Rabinovich et al. 2017) takes, is equal to h'' at 1,
  /// and leads strongly compressed triangles to 1 at once, where Newton's method needs many steps.
  static Triangle_energy derivatives(double r, double s)
  {
    const double x = r + s, y = r - s;
    const auto slope = [](double z) { return 2 * z - 2 / (z * z * z); };
    const auto secant = [](double z) { return 2 * (z + 1) * (z * z + 1) / (z * z * z); };
    const double hx = slope(x), hy = slope(y), kx = secant(x), ky = secant(y);
    Triangle_energy result;
    result.value = x * x + y * y + 1 / (x * x) + 1 / (y * y);
    result.dr = hx + hy;
    result.ds = hx - hy;
    result.krr = result.kss = kx + ky;
    result.krs = kx - ky;
    result.tangential_f = std::max(0., result.dr / r);
    // (h'(x) - h'(y)) / s = 2 (2 + 2 (x^2 + x y + y^2) / (x y)^3), without the division by s
    const double xy = x * y;
    result.tangential_g = 4 + 4 * (x * x + xy + y * y) / (xy * xy * xy);
    return result;
  }
};

/// \brief A triangle's rest shape as the map from vertex positions to (f, g): f = sum conj(beta_j) u_j,
/// g = sum beta_j u_j, with beta_j = i W_j / (2 d) in the LSCM paper's terms.
struct Rest_triangle
{
  std::array<Complex, 3> beta;
  double area;
};

inline std::vector<Rest_triangle> rest_triangles(const Chart_geometry& geometry, double least_height)
{
  std::vector<Rest_triangle> rest(geometry.number_of_triangles());
  for (Index t = 0; t < rest.size(); ++t) {
    const Planar_triangle shape = geometry.planar(t, least_height);
    for (int i = 0; i < 3; ++i)
      rest[t].beta[i] = Complex(-shape.w[i].imag(), shape.w[i].real()) / (2 * shape.double_area);
    rest[t].area = shape.double_area / 2;
  }
  return rest;
}

/// f and g of a triangle with the corners a, b, c in the plane.
inline std::array<Complex, 2> derivative(const Rest_triangle& rest, const Complex& a, const Complex& b,
                                         const Complex& c)
{
  const Complex ab = b - a, ac = c - a;
  return {times(std::conj(rest.beta[1]), ab) + times(std::conj(rest.beta[2]), ac),
          times(rest.beta[1], ab) + times(rest.beta[2], ac)};
}

/// The energy of a map, each triangle weighted by its area in space; infinite if a triangle is flipped.
template <typename Energy>
double total_energy(const Chart& chart, const std::vector<Rest_triangle>& rest, std::span<const Complex> u)
{
  double sum = 0;
  for (std::size_t t = 0; t < rest.size(); ++t) {
    const auto& corner = chart.triangles[t];
    const auto [f, g] = derivative(rest[t], u[corner[0]], u[corner[1]], u[corner[2]]);
    sum += rest[t].area * Energy::value(std::norm(f), std::norm(g));
  }
  return sum;
}

} // namespace Atlas::internal

#endif
