// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_ANGLES_TRIANGLE_ANGLES_H
#define ATLAS_PARAMETERIZATION_INTERNAL_ANGLES_TRIANGLE_ANGLES_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Atlas::internal {

/// \brief The three angles of a triangle in the plane, which sum to pi.
///
/// The largest follows from the two others, so that sines and cotangents keep their relative precision in
/// caps, whose largest angle is as good as pi.
class Triangle_angles
{
public:
  Triangle_angles() = default;
  explicit Triangle_angles(const Planar_triangle& shape)
  {
    for (int i = 0; i < 3; ++i) {
      const Complex &to_next = shape.w[(i + 2) % 3], &from_last = shape.w[(i + 1) % 3];
      angle_[i] = std::atan2(shape.double_area,
                             -(to_next.real() * from_last.real() + to_next.imag() * from_last.imag()));
    }
    complete();
  }

  double operator[](int i) const { return angle_[i]; }
  double sine(int i) const { return std::sin(i == largest_ ? sum_of_others() : angle_[i]); }
  double cotangent(int i) const
  {
    return i == largest_ ? -1 / std::tan(sum_of_others()) : 1 / std::tan(angle_[i]);
  }

  /// Adds steps that sum to zero; as much of them as leaves each angle a tenth of what it is.
  void add(const std::array<double, 3>& step)
  {
    double part = 1;
    for (int i = 0; i < 3; ++i)
      if (step[i] < -0.9 * angle_[i])
        part = std::min(part, -0.9 * angle_[i] / step[i]);
    for (int i = 0; i < 3; ++i)
      angle_[i] += part * step[i];
    complete();
  }

  /// A triangle with these angles, with a longest edge of length 1.
  Planar_triangle shape() const
  {
    const double scale = 1 / sine(largest_);
    std::array<double, 3> length;
    for (int i = 0; i < 3; ++i)
      length[i] = scale * sine(i);
    // The largest angle is on top: the others are at the ends of the longest edge.
    const int top = largest_, a = (top + 1) % 3, b = (top + 2) % 3;
    const double height = length[b] * std::sin(angle_[a]);
    Planar_triangle result;
    result.w[top] = Complex(length[top], 0);
    result.w[a] = Complex(-length[a] * std::cos(angle_[b]), height);
    result.w[b] = Complex(-length[b] * std::cos(angle_[a]), -height);
    result.double_area = length[top] * height;
    return result;
  }

private:
  double sum_of_others() const { return angle_[(largest_ + 1) % 3] + angle_[(largest_ + 2) % 3]; }

  void complete()
  {
    largest_ = 0;
    for (int i = 1; i < 3; ++i)
      if (angle_[i] > angle_[largest_])
        largest_ = i;
    angle_[largest_] = std::acos(-1.) - sum_of_others();
  }

  std::array<double, 3> angle_{};
  int largest_ = 0;
};

} // namespace Atlas::internal

#endif
