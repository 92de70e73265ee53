// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_CHART_GEOMETRY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_CHART_GEOMETRY_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/errors.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// The product without the checks for infinities that the standard asks of complex numbers.
inline Complex times(const Complex& a, const Complex& b)
{
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Throws `Invalid_argument` unless all vertices of the triangles exist. O(n).
inline void check_chart(const Chart& chart)
{
  for (const auto& corner : chart.triangles)
    for (const Index v : corner)
      require(v < chart.number_of_vertices(), "chart",
              "must have no triangle with a vertex that does not exist");
}

/// The same for a chart that comes with coordinates: there must be one for each vertex.
inline void check_flat_chart(const Chart& chart)
{
  check_chart(chart);
  require(chart.uv.size() == chart.number_of_vertices(), "chart", "must have coordinates for each vertex");
}

/// Triangles whose height is a smaller part of their longest edge are flattened as if they were this high:
/// below it double precision cannot tell them from segments.
inline constexpr double least_relative_height = 1e-9;

/// \brief A triangle laid into the plane counterclockwise, as its three edges: `w[i]` runs from corner i+1 to
/// corner i+2 (the W_i of the LSCM paper, section 2.4). They sum to zero.
struct Planar_triangle
{
  std::array<Complex, 3> w;
  double double_area; ///< d_T of the paper; always positive
};

/// \brief The geometry of a chart in a unit that keeps squares of lengths and areas in range, whatever the
/// unit of the model.
class Chart_geometry
{
public:
  using Vector = std::array<double, 3>;

  explicit Chart_geometry(const Chart& chart) : chart_(chart), points_(chart.points.size())
  {
    for (std::size_t i = 0; i < points_.size(); ++i)
      points_[i] = {chart.points[i].x(), chart.points[i].y(), chart.points[i].z()};
    if (points_.empty())
      return;
    // The first so that differences cannot overflow; the second for charts far from the origin.
    rescale(largest_coordinate());
    rescale(largest_extent());
  }

  const Chart& chart() const { return chart_; }
  std::size_t number_of_vertices() const { return points_.size(); }
  std::size_t number_of_triangles() const { return chart_.triangles.size(); }
  const Vector& point(Index v) const { return points_[v]; }

  /// Converts a length to the unit of the model.
  double to_model(double length) const { return std::ldexp(length, exponent_); }
  double from_model(double length) const { return std::ldexp(length, -exponent_); }

  double distance(Index v, Index w) const { return std::sqrt(squared_length(edge(v, w))); }

  /// Twice the area; zero for degenerate triangles.
  double double_area(Index t) const
  {
    const auto& [a, b, c] = chart_.triangles[t];
    return std::sqrt(squared_length(cross(edge(a, b), edge(a, c))));
  }

  /// Whether the three corners are in one place.
  bool is_point(Index t) const
  {
    const auto& [a, b, c] = chart_.triangles[t];
    return points_[a] == points_[b] && points_[a] == points_[c];
  }

  /// The triangle in the plane, on its longest edge. Degenerate triangles get the height
  /// `least_height` times their longest edge; three equal points make an equilateral one of size 1.
  Planar_triangle planar(Index t, double least_height = least_relative_height) const
  {
    const auto& corner = chart_.triangles[t];
    std::array<double, 3> squared;
    for (int i = 0; i < 3; ++i)
      squared[i] = squared_length(edge(corner[(i + 1) % 3], corner[(i + 2) % 3]));
    const int k = static_cast<int>(std::max_element(squared.begin(), squared.end()) - squared.begin());
    const int ka = (k + 1) % 3, kb = (k + 2) % 3;
    Planar_triangle result;
    if (!(squared[k] > 0)) {
      const double h = std::sqrt(0.75);
      result.w = {Complex(1, 0), Complex(-0.5, h), Complex(-0.5, -h)};
      result.double_area = h;
      return result;
    }
    const double length = std::sqrt(squared[k]);
    const Vector base = edge(corner[ka], corner[kb]), left = edge(corner[ka], corner[k]),
                 right = edge(corner[kb], corner[k]);
    const double height =
        std::max(std::sqrt(squared_length(cross(left, right))) / length, least_height * length);
    // The foot of the height is measured from its nearer end: short edges keep their relative precision.
    double from_a = dot(base, left) / length, from_b = -dot(base, right) / length;
    if (from_a < from_b)
      from_b = length - from_a;
    else
      from_a = length - from_b;
    result.w[k] = Complex(length, 0);
    result.w[ka] = Complex(-from_b, height);
    result.w[kb] = Complex(-from_a, -height);
    result.double_area = length * height;
    return result;
  }

  static double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static double squared_length(const Vector& a) { return dot(a, a); }
  static Vector cross(const Vector& a, const Vector& b)
  {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  Vector edge(Index from, Index to) const
  {
    const Vector &p = points_[from], &q = points_[to];
    return {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  }

private:
  /// Multiplies by the power of two that brings `size` into [1, 2). Exact.
  void rescale(double size)
  {
    if (!(size > 0) || !std::isfinite(size))
      return;
    const int exponent = std::ilogb(size);
    for (Vector& p : points_)
      for (double& x : p)
        x = std::ldexp(x, -exponent);
    exponent_ += exponent;
  }

  double largest_coordinate() const
  {
    double largest = 0;
    for (const Vector& p : points_)
      for (const double x : p)
        largest = std::max(largest, std::abs(x));
    return largest;
  }

  double largest_extent() const
  {
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax_element(
          points_.begin(), points_.end(), [i](const Vector& p, const Vector& q) { return p[i] < q[i]; });
      largest = std::max(largest, (*high)[i] - (*low)[i]);
    }
    return largest;
  }

  const Chart& chart_;
  std::vector<Vector> points_;
  int exponent_ = 0;
};

} // namespace Atlas::internal

#endif
