// SPDX-License-Identifier: MIT
#ifndef ATLAS_PLANAR_INTERNAL_VECTORS_H
#define ATLAS_PLANAR_INTERNAL_VECTORS_H

#include <cmath>
#include <complex>

namespace Atlas::internal {

/// Points of the plane where maps are conformal: u + iv.
using Complex = std::complex<double>;

/// A vector or point of the plane in plain doubles: what runs in inner loops.
struct Vec2
{
  double x = 0, y = 0;

  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend bool operator==(Vec2 a, Vec2 b) = default;
};
inline double dot(Vec2 a, Vec2 b)
{
  return a.x * b.x + a.y * b.y;
}
inline double cross(Vec2 a, Vec2 b)
{
  return a.x * b.y - a.y * b.x;
}
inline double length(Vec2 a)
{
  return std::sqrt(dot(a, a));
}
/// `v` turned by the unit complex number `r`.
inline Vec2 rotated(Vec2 r, Vec2 v)
{
  return {r.x * v.x - r.y * v.y, r.y * v.x + r.x * v.y};
}

inline Complex to_complex(Vec2 v)
{
  return {v.x, v.y};
}
inline Vec2 to_vector(const Complex& z)
{
  return {z.real(), z.imag()};
}

} // namespace Atlas::internal

#endif
