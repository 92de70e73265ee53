// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_DISTORTION_ENERGY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_DISTORTION_ENERGY_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace Atlas::internal {

/// What an isotropic energy says of one triangle. The map is z -> f z + g conj(z) there; r = |f|, s = |g|,
/// and the singular values are x = r + s and y = r - s.
struct Triangle_energy
{
  double value;
  double dr, ds;                     ///< derivatives
  double krr, krs, kss;              ///< a positive semidefinite stand-in for the second derivatives
  double tangential_f, tangential_g; ///< dr / r and ds / s, the curvatures across, not below zero
};

/// From derivatives and second derivatives by x and y, of which the positive semidefinite part is taken, and
/// (dx - dy) / s, which the energies give without the division.
inline Triangle_energy triangle_energy(double x, double y, double value, double dx, double dy, double kxx,
                                       double kxy, double kyy, double dxy_over_s)
{
  const double mean = (kxx + kyy) / 2, half = (kxx - kyy) / 2,
               radius = kxy == 0 ? std::abs(half) : std::hypot(half, kxy);
  if (const double least = mean - radius; least < 0 && radius > 0) {
    // Subtract the negative eigenvalue times the projector on its eigenvector, (1 - (K - mean) / radius) / 2.
    kxx -= least * (1 - half / radius) / 2;
    kyy -= least * (1 + half / radius) / 2;
    kxy += least * kxy / radius / 2;
  }
  Triangle_energy result;
  result.value = value;
  result.dr = dx + dy;
  result.ds = dx - dy;
  result.krr = std::max(0., kxx + 2 * kxy + kyy);
  result.krs = kxx - kyy;
  result.kss = std::max(0., kxx - 2 * kxy + kyy);
  result.tangential_f = std::max(0., 2 * result.dr / (x + y));
  result.tangential_g = std::max(0., dxy_over_s);
  return result;
}

/// \brief Symmetric Dirichlet energy, sum of the squares of the singular values and of their inverses (Smith
/// and Schaefer 2015).
struct Symmetric_dirichlet
{
  static constexpr double isometry = 4;

  static double value(double r2, double s2)
  {
    const double det = r2 - s2;
    return det > 0 ? 2 * (r2 + s2) * (1 + 1 / (det * det)) : std::numeric_limits<double>::infinity();
  }

  /// h(x) = x^2 + x^-2. In place of h'' stands the secant h'(x) / (x - 1), the curvature of the parabola with
  /// this slope and its minimum at 1: it is what SLIM (Rabinovich et al. 2017) takes, is equal to h'' at 1,
  /// and leads strongly compressed triangles to 1 at once, where Newton's method needs many steps.
  static Triangle_energy derivatives(double x, double y)
  {
    const auto slope = [](double z) { return 2 * z - 2 / (z * z * z); };
    const auto secant = [](double z) { return 2 * (z + 1) * (z * z + 1) / (z * z * z); };
    const double xy = x * y;
    return triangle_energy(x, y, x * x + y * y + 1 / (x * x) + 1 / (y * y), slope(x), slope(y), secant(x), 0,
                           secant(y), 4 + 4 * (x * x + xy + y * y) / (xy * xy * xy));
  }
};

/// \brief MIPS, the ratio of the singular values and its inverse: Hormann and Greiner 2000.
struct Mips
{
  static constexpr double isometry = 2;

  static double value(double r2, double s2)
  {
    return r2 > s2 ? 2 * (r2 + s2) / (r2 - s2) : std::numeric_limits<double>::infinity();
  }

  static Triangle_energy derivatives(double x, double y)
  {
    const double x2 = x * x, y2 = y * y, xy = x * y;
    return triangle_energy(x, y, x / y + y / x, 1 / y - y / x2, 1 / x - x / y2, 2 * y / (x2 * x),
                           -1 / x2 - 1 / y2, 2 * x / (y2 * y), 2 / xy + 2 * (x2 + xy + y2) / (xy * xy));
  }
};

/// \brief Half the sum of the squared inverse singular values, plus the determinant. Over all scales its mean
/// is least where it is 2 L2, the L2 stretch of Sander et al. 2001, which does not depend on scale:
/// minimising the one minimises the other.
struct Stretch
{
  static constexpr double isometry = 2;

  static double value(double r2, double s2)
  {
    const double det = r2 - s2;
    return det > 0 ? (r2 + s2) / (det * det) + det : std::numeric_limits<double>::infinity();
  }

  /// The secants are half of those of the symmetric Dirichlet energy, for the same reason; at 1 they are not
  /// below the second derivatives.
  static Triangle_energy derivatives(double x, double y)
  {
    const auto secant = [](double z) { return (z + 1) * (z * z + 1) / (z * z * z); };
    const double x2 = x * x, y2 = y * y, xy = x * y;
    return triangle_energy(x, y, (1 / x2 + 1 / y2) / 2 + xy, y - 1 / (x2 * x), x - 1 / (y2 * y), secant(x), 0,
                           secant(y), 2 * (x2 + xy + y2) / (xy * xy * xy) - 2);
  }
};

/// \brief (1 - w) times MIPS plus w times the energy of stretch, of which either has 2 for an isometry.
struct Conformal_stretch
{
  static constexpr double isometry = 2;

  double weight = 0.5; ///< w, in [0, 1]

  double value(double r2, double s2) const
  {
    return r2 > s2 ? (1 - weight) * Mips::value(r2, s2) + weight * Stretch::value(r2, s2)
                   : std::numeric_limits<double>::infinity();
  }

  /// Sums of positive semidefinite parts are so too.
  Triangle_energy derivatives(double x, double y) const
  {
    const Triangle_energy a = Mips::derivatives(x, y), b = Stretch::derivatives(x, y);
    const auto blend = [&](double Triangle_energy::*part) {
      return (1 - weight) * a.*part + weight * b.*part;
    };
    return {blend(&Triangle_energy::value),        blend(&Triangle_energy::dr),
            blend(&Triangle_energy::ds),           blend(&Triangle_energy::krr),
            blend(&Triangle_energy::krs),          blend(&Triangle_energy::kss),
            blend(&Triangle_energy::tangential_f), blend(&Triangle_energy::tangential_g)};
  }
};

/// \brief A power of an energy, in the same unit: e (E / e)^p, e being that of an isometry. Its least mean
/// trades a little of the mean of E for much less of the largest values.
template <typename Energy>
struct Power_of_energy
{
  static constexpr double isometry = Energy::isometry;

  Energy energy = {};
  unsigned exponent = 1; ///< p, at least 1

  double value(double r2, double s2) const
  {
    const double plain = energy.value(r2, s2);
    return exponent == 1 ? plain : isometry * power(plain / isometry, exponent);
  }

  /// The second derivatives are p (E / e)^(p-1) times those of E, plus the square of its gradient, which is
  /// positive semidefinite as well, times p (p - 1) / e (E / e)^(p-2).
  Triangle_energy derivatives(double x, double y) const
  {
    Triangle_energy d = energy.derivatives(x, y);
    if (exponent == 1)
      return d;
    const double ratio = d.value / isometry, lower = exponent * power(ratio, exponent - 2);
    const double outer = lower * ratio, bend = lower * (exponent - 1) / isometry;
    d.value = isometry * power(ratio, exponent);
    d.krr = outer * d.krr + bend * d.dr * d.dr;
    d.krs = outer * d.krs + bend * d.dr * d.ds;
    d.kss = outer * d.kss + bend * d.ds * d.ds;
    d.dr *= outer;
    d.ds *= outer;
    d.tangential_f *= outer;
    d.tangential_g *= outer;
    return d;
  }

private:
  static double power(double base, unsigned exponent)
  {
    double result = 1;
    for (; exponent > 0; exponent /= 2, base *= base)
      if (exponent % 2 == 1)
        result *= base;
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
double total_energy(const Energy& energy, const Chart& chart, const std::vector<Rest_triangle>& rest,
                    std::span<const Complex> u)
{
  double sum = 0;
  for (std::size_t t = 0; t < rest.size(); ++t) {
    const auto& corner = chart.triangles[t];
    const auto [f, g] = derivative(rest[t], u[corner[0]], u[corner[1]], u[corner[2]]);
    sum += rest[t].area * energy.value(std::norm(f), std::norm(g));
  }
  return sum;
}

} // namespace Atlas::internal

#endif
