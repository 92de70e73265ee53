// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_ANGLES_ANGLE_FLATTENER_H
#define ATLAS_PARAMETERIZATION_INTERNAL_ANGLES_ANGLE_FLATTENER_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/angles/Triangle_angles.h>
#include <Atlas/parameterization/internal/geometry/border.h>
#include <Atlas/parameterization/internal/sparse/Vertex_block_cholesky.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief What it costs that an angle is r times the one asked for: (r - 1)^2, and below one half a barrier
/// in addition, which keeps angles positive; three times continuously differentiable.
struct Angle_cost
{
  static constexpr double barrier = 0.5;

  static double first_derivative(double r)
  {
    const double gap = std::max(barrier - r, 0.); // the barrier is gap^3 / r
    return 2 * (r - 1) - (3 + gap / r) * gap * gap / r;
  }
  static double second_derivative(double r)
  {
    const double ratio = std::max(barrier - r, 0.) / r;
    return 2 + ratio * (6 + ratio * (6 + 2 * ratio));
  }
};

/// \brief The angles of a planar triangulation that are nearest to those of a disc in space.
///
/// Minimises the sum of `Angle_cost` over the corners, where an inner vertex asks for its angles in space
/// scaled so that they sum to 2 pi, subject to (Sheffer and de Sturler 2001, with the logarithm of their
/// third condition as in Zayer et al. 2007)
/// - the angles of a triangle sum to pi,
/// - those around an inner vertex to 2 pi,
/// - the sum of log sin a_next - log sin a_previous around an inner vertex is zero: the wheel closes up.
///
/// Every Newton step solves for the multipliers of the last two conditions only: a matrix with a block of 2x2
/// for each inner vertex and each edge (Sheffer et al. 2005, section 2.1). With logarithms the Hessian is
/// diagonal, and used as it is where it is positive. The first condition holds throughout, and is eliminated
/// in closed form: with the inverse Hessian D, what remains of a triangle is a sum over its pairs of corners
/// k, l of D_k D_l / (D_1 + D_2 + D_3) times differences, in which nothing cancels, whatever its shape.
class Angle_flattener
{
public:
  /// \param least_height  of a triangle, as a part of its longest edge: thinner ones count as that high
  Angle_flattener(const Chart_geometry& geometry, double least_height)
      : chart_(geometry.chart()), is_fixed_(border_vertices(chart_)), angles_(chart_.triangles.size()),
        target_(chart_.triangles.size()), inverse_hessian_(chart_.triangles.size()),
        multiplier_(chart_.number_of_vertices()), defect_(chart_.number_of_vertices())
  {
    std::vector<double> sum(chart_.number_of_vertices(), 0);
    for (Index t = 0; t < angles_.size(); ++t) {
      angles_[t] = Triangle_angles(geometry.planar(t, least_height));
      for (int i = 0; i < 3; ++i)
        sum[chart_.triangles[t][i]] += angles_[t][i];
    }
    for (Index t = 0; t < angles_.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const Index v = chart_.triangles[t][i];
        target_[t][i] = angles_[t][i] * (is_fixed_[v] ? 1 : full_turn() / sum[v]);
      }
    for (Index v = 0; v < sum.size(); ++v)
      if (sum[v] == 0) // no triangle has it
        is_fixed_[v] = true;
    measure();
  }

  const std::vector<Triangle_angles>& angles() const { return angles_; }

  /// The largest amount by which a condition is missed, in radians or as a logarithm.
  double violation() const { return violation_; }

  /// The sum over the corners of (angle / angle asked for - 1)^2.
  double energy() const
  {
    double sum = 0;
    for (Index t = 0; t < angles_.size(); ++t)
      for (int i = 0; i < 3; ++i)
        sum += std::pow(angles_[t][i] / target_[t][i] - 1, 2);
    return sum;
  }

  /// One Newton step.
  /// \return the largest relative change of an angle; infinite if the system could not be solved
  double step(Vertex_block_cholesky& system)
  {
    assemble(system);
    if (!system.solve(multiplier_))
      return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (Index t = 0; t < angles_.size(); ++t)
      largest = std::max(largest, update(t));
    measure();
    return largest;
  }

private:
  static double full_turn() { return 2 * std::acos(-1.); }

  /// What the multipliers of the three vertices contribute to the derivative by the angle of corner i: the
  /// real part of a multiplier belongs to the sum of the angles, the imaginary one to the wheel.
  double pull(Index t, int i) const
  {
    const auto& corner = chart_.triangles[t];
    return multiplier_[corner[i]].real() +
           angles_[t].cotangent(i) *
               (multiplier_[corner[(i + 2) % 3]].imag() - multiplier_[corner[(i + 1) % 3]].imag());
  }

  /// D_k D_l / (D_1 + D_2 + D_3) for the corners k, l other than i.
  static double pair_weight(const std::array<double, 3>& d, int i)
  {
    const double k = d[(i + 1) % 3], l = d[(i + 2) % 3];
    return std::min(k, l) * (std::max(k, l) / (d[0] + d[1] + d[2]));
  }

  double gradient(Index t, int i) const
  {
    return Angle_cost::first_derivative(angles_[t][i] / target_[t][i]) / target_[t][i];
  }

  /// Of the Lagrangian. The part of the conditions may be negative, and more than the rest.
  std::array<double, 3> inverse_hessian(Index t) const
  {
    std::array<double, 3> result;
    const auto& corner = chart_.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const double target = target_[t][i], sine = angles_[t].sine(i),
                   cost = Angle_cost::second_derivative(angles_[t][i] / target) / (target * target),
                   wheels =
                       (multiplier_[corner[(i + 1) % 3]].imag() - multiplier_[corner[(i + 2) % 3]].imag()) /
                       (sine * sine);
      result[i] = 1 / std::max(cost + wheels, least_curvature * cost);
    }
    return result;
  }

  void assemble(Vertex_block_cholesky& system)
  {
    system.set_zero();
    std::vector<Complex> right = defect_;
    for (Index t = 0; t < angles_.size(); ++t) {
      inverse_hessian_[t] = inverse_hessian(t);
      for (int i = 0; i < 3; ++i)
        add_pair(system, t, i, right);
    }
    for (Index v = 0; v < right.size(); ++v)
      if (is_fixed_[v])
        system.add(v, {1, 0, 0, 1});
    multiplier_ = std::move(right);
  }

  /// The share of the corners k, l other than i.
  void add_pair(Vertex_block_cholesky& system, Index t, int i, std::vector<Complex>& right) const
  {
    const auto& corner = chart_.triangles[t];
    const int k = (i + 1) % 3, l = (i + 2) % 3;
    const double weight = pair_weight(inverse_hessian_[t], i), slope = gradient(t, k) - gradient(t, l),
                 ck = angles_[t].cotangent(k), cl = angles_[t].cotangent(l);
    // Derivatives of the conditions at the three vertices by the angle k, minus those by the angle l.
    std::array<Complex, 3> j;
    j[i] = Complex(0, ck + cl);
    j[k] = Complex(1, -cl);
    j[l] = Complex(-1, -ck);
    for (int a = 0; a < 3; ++a)
      if (is_fixed_[corner[a]])
        j[a] = 0;
    for (int a = 0; a < 3; ++a) {
      const Complex p = j[a], q = j[(a + 1) % 3];
      right[corner[a]] -= weight * slope * p;
      system.add(corner[a], {weight * p.real() * p.real(), weight * p.real() * p.imag(),
                             weight * p.imag() * p.real(), weight * p.imag() * p.imag()});
      system.add(t, a,
                 {weight * p.real() * q.real(), weight * p.real() * q.imag(), weight * p.imag() * q.real(),
                  weight * p.imag() * q.imag()});
    }
  }

  double update(Index t)
  {
    std::array<double, 3> force, change{};
    for (int i = 0; i < 3; ++i)
      force[i] = gradient(t, i) + pull(t, i);
    for (int i = 0; i < 3; ++i) {
      const int k = (i + 1) % 3, l = (i + 2) % 3;
      const double move = pair_weight(inverse_hessian_[t], i) * (force[k] - force[l]);
      change[k] -= move;
      change[l] += move;
    }
    double largest = 0;
    for (int i = 0; i < 3; ++i)
      largest = std::max(largest, std::abs(change[i]) / angles_[t][i]);
    angles_[t].add(change);
    return largest;
  }

  /// How far the conditions around inner vertices are from being met.
  void measure()
  {
    std::vector<Complex> sum(chart_.number_of_vertices());
    for (Index t = 0; t < angles_.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const double log_sine = std::log(angles_[t].sine(i));
        sum[chart_.triangles[t][i]] += angles_[t][i];
        sum[chart_.triangles[t][(i + 2) % 3]] += Complex(0, log_sine);
        sum[chart_.triangles[t][(i + 1) % 3]] -= Complex(0, log_sine);
      }
    violation_ = 0;
    for (Index v = 0; v < sum.size(); ++v) {
      defect_[v] = is_fixed_[v] ? 0 : sum[v] - full_turn();
      violation_ = std::max({violation_, std::abs(defect_[v].real()), std::abs(defect_[v].imag())});
    }
  }

  /// The Hessian is at least this part of that of the cost alone.
  static constexpr double least_curvature = 0.1;

  const Chart& chart_;
  std::vector<bool> is_fixed_; ///< per vertex: has no conditions
  std::vector<Triangle_angles> angles_;
  std::vector<std::array<double, 3>> target_; ///< the angles asked for
  std::vector<std::array<double, 3>> inverse_hessian_;
  std::vector<Complex> multiplier_, defect_; ///< per vertex: of the sum of the angles, and of the wheel
  double violation_ = 0;
};

} // namespace Atlas::internal

#endif
