// SPDX-License-Identifier: MIT
// Are predicates exact on this machine? WebAssembly rounds to nearest and nothing else. Orientations of
// points that are nearly on a line or a plane, and intervals, are compared with rational numbers.
#include <Atlas/core/Kernel.h>

#include <CGAL/Interval_nt.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>

using Exact = boost::multiprecision::cpp_rational;
using Atlas::Point_2;
using Atlas::Point_3;

namespace {

int failures = 0;
std::mt19937_64 random_bits(20);

void expect(bool is_right, const char* what)
{
  if (!is_right && ++failures <= 20)
    std::printf("wrong: %s\n", what);
}

double uniform(double low, double high)
{
  return low + (high - low) * double(random_bits() >> 11) * 0x1p-53;
}

/// The number up to a few steps away.
double near(double x)
{
  const double end = random_bits() % 2 ? INFINITY : -INFINITY;
  for (std::uint64_t i = random_bits() % 3; i > 0; --i)
    x = std::nextafter(x, end);
  return x;
}

int sign(const Exact& x)
{
  return x.sign();
}

Exact determinant(const Exact (&a)[2], const Exact (&b)[2])
{
  return a[0] * b[1] - a[1] * b[0];
}

int exact_orientation(const Point_2& p, const Point_2& q, const Point_2& r)
{
  const Exact a[] = {Exact(q.x()) - Exact(p.x()), Exact(q.y()) - Exact(p.y())};
  const Exact b[] = {Exact(r.x()) - Exact(p.x()), Exact(r.y()) - Exact(p.y())};
  return sign(determinant(a, b));
}

int exact_orientation(const Point_3& p, const Point_3& q, const Point_3& r, const Point_3& s)
{
  Exact m[3][3];
  const Point_3* const points[] = {&q, &r, &s};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      m[i][k] = Exact((*points[i])[k]) - Exact(p[k]);
  return sign(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
              m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
              m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
}

double on_grid(double x)
{
  return std::round(x * 0x1p24) * 0x1p-24;
}

/// Points of the grid of 2^-24 that a page's coordinates are on: on a line, or a step of the grid off it.
void check_grid(int n, int (&seen)[3])
{
  for (int i = 0; i < n; ++i) {
    const double x = on_grid(uniform(-1, 1)), y = on_grid(uniform(-1, 1)),
                 times = double(random_bits() % 7) - 3;
    const double off = (double(random_bits() % 3) - 1) * 0x1p-24;
    const Point_2 p(on_grid(uniform(0, 1)), on_grid(uniform(0, 1))), q(p.x() + x, p.y() + y);
    const Point_2 r(p.x() + times * x + off, p.y() + times * y);
    const int exact = exact_orientation(p, q, r);
    ++seen[exact + 1];
    expect(int(CGAL::orientation(p, q, r)) == exact, "orientation on the grid");
    expect(int(CGAL::orientation(q, p, r)) == -exact, "orientation on the grid, turned");
  }
}

/// Any doubles, a few steps off a line.
void check_plane(int n, int (&seen)[3])
{
  for (int i = 0; i < n; ++i) {
    const double scale = std::ldexp(1, int(random_bits() % 80) - 40), x = uniform(-1, 1), y = uniform(-1, 1);
    const Point_2 p(scale * x, scale * y), q(near(scale * x / 2), near(scale * y / 2)),
        r(near(-scale * x), near(-scale * y));
    const int exact = exact_orientation(p, q, r);
    ++seen[exact + 1];
    expect(int(CGAL::orientation(p, q, r)) == exact, "orientation in the plane");
  }
}

void check_space(int n, int (&seen)[3])
{
  for (int i = 0; i < n; ++i) {
    const bool is_flat = random_bits() % 2; // exactly, for sums of numbers of the grid are exact
    const double a = is_flat ? 1 : uniform(-1, 1), b = is_flat ? 2 : uniform(-1, 1);
    const auto on_plane = [&] {
      const double x = on_grid(uniform(-1, 1)), y = on_grid(uniform(-1, 1)), z = a * x + b * y;
      return Point_3(x, y, is_flat ? z : near(z));
    };
    const Point_3 p = on_plane(), q = on_plane(), r = on_plane(), s = on_plane();
    const int exact = exact_orientation(p, q, r, s);
    ++seen[exact + 1];
    expect(int(CGAL::orientation(p, q, r, s)) == exact, "orientation in space");
  }
}

/// The result lies in the interval of rounded operations.
void check_intervals(int n)
{
  using Interval = CGAL::Interval_nt<>;
  const auto has = [](const Interval& interval, const Exact& x) {
    return Exact(interval.inf()) <= x && x <= Exact(interval.sup());
  };
  for (int i = 0; i < n; ++i) {
    const double a = uniform(-1, 1), b = uniform(-1, 1), c = uniform(1, 2);
    const Interval x(a), y(b), z(c);
    expect(has(x + y, Exact(a) + Exact(b)), "sum");
    expect(has(x - y, Exact(a) - Exact(b)), "difference");
    expect(has(x * y, Exact(a) * Exact(b)), "product");
    expect(has(x / z, Exact(a) / Exact(c)), "quotient");
    expect(has(x * z - y * z, (Exact(a) - Exact(b)) * Exact(c)), "difference of products");
    const Interval root = CGAL::sqrt(z);
    expect(Exact(root.inf()) * Exact(root.inf()) <= Exact(c) &&
               Exact(c) <= Exact(root.sup()) * Exact(root.sup()),
           "root");
  }
}

} // namespace

int main()
{
  int grid[3] = {}, plane[3] = {}, space[3] = {};
  check_grid(20000, grid);
  check_plane(20000, plane);
  check_space(20000, space);
  check_intervals(20000);
  // Nearly flat is what filters cannot decide; of each case there have to be many.
  for (const int* const seen : {grid, plane, space})
    for (int i = 0; i < 3; ++i)
      expect(seen[i] >= 500, "the points that were tried: there must be many of each case");
  std::printf("grid %d/%d/%d, plane %d/%d/%d, space %d/%d/%d; %d wrong\n", grid[0], grid[1], grid[2],
              plane[0], plane[1], plane[2], space[0], space[1], space[2], failures);
  return failures != 0;
}
