// SPDX-License-Identifier: MIT
#include <Atlas/validation/overlaps.h>

#include <boost/multiprecision/cpp_int.hpp>

#include "test_meshes.h"
#include <gtest/gtest.h>
#include <random>

namespace Atlas {
namespace {

using Pair = std::pair<Index, Index>;
using Rational = boost::multiprecision::cpp_rational;

std::vector<Index> no_neighbours(const std::vector<Triangle_uv>& triangles)
{
  return std::vector<Index>(3 * triangles.size(), no_index);
}

/// The area that two triangles have in common, by clipping in rational numbers: another definition of
/// overlap than the one under test.
Rational common_area(const Triangle_uv& s, const Triangle_uv& t)
{
  using Point = std::array<Rational, 2>;
  const auto cross = [](const Point& a, const Point& b, const Point& c) -> Rational {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  const auto polygon = [&](const Triangle_uv& u) {
    std::vector<Point> p;
    for (const Point_2& q : u)
      p.push_back({Rational(q.x()), Rational(q.y())});
    if (cross(p[0], p[1], p[2]) < 0)
      std::swap(p[1], p[2]);
    return p;
  };
  std::vector<Point> clipped = polygon(s);
  const std::vector<Point> window = polygon(t);
  if (cross(window[0], window[1], window[2]) == 0)
    return 0;
  for (int e = 0; e < 3; ++e) {
    const Point &a = window[e], &b = window[(e + 1) % 3];
    std::vector<Point> next;
    for (std::size_t i = 0; i < clipped.size(); ++i) {
      const Point &p = clipped[i], &q = clipped[(i + 1) % clipped.size()];
      const Rational u = cross(a, b, p), v = cross(a, b, q);
      if (u >= 0)
        next.push_back(p);
      if ((u > 0 && v < 0) || (u < 0 && v > 0)) {
        const Rational w = u / (u - v);
        next.push_back({p[0] + w * (q[0] - p[0]), p[1] + w * (q[1] - p[1])});
      }
    }
    clipped = next;
  }
  Rational sum = 0;
  for (std::size_t i = 2; i < clipped.size(); ++i)
    sum += cross(clipped[0], clipped[i - 1], clipped[i]);
  return sum;
}

std::vector<Pair> pairs_by_area(const std::vector<Triangle_uv>& triangles)
{
  std::vector<Pair> result;
  for (Index i = 0; i < triangles.size(); ++i)
    for (Index j = i + 1; j < triangles.size(); ++j)
      if (common_area(triangles[i], triangles[j]) > 0)
        result.push_back({i, j});
  return result;
}

Triangle_uv triangle(double ax, double ay, double bx, double by, double cx, double cy)
{
  return {Point_2(ax, ay), Point_2(bx, by), Point_2(cx, cy)};
}

bool overlap(const Triangle_uv& s, const Triangle_uv& t)
{
  const std::vector<Triangle_uv> both{s, t};
  const bool found = !find_overlaps(both).pairs.empty();
  EXPECT_EQ(found, !is_overlap_free(both, no_neighbours(both)));
  EXPECT_EQ(found, common_area(s, t) > 0);
  return found;
}

TEST(Overlaps, ContactIsNone)
{
  const Triangle_uv t = triangle(0, 0, 2, 0, 0, 2);
  EXPECT_FALSE(overlap(t, triangle(2, 0, 2, 2, 0, 2)));        // a common edge
  EXPECT_FALSE(overlap(t, triangle(0, 0, -1, 1, -1, -1)));     // a common vertex
  EXPECT_FALSE(overlap(t, triangle(1, 0, 2, -1, 0, -1)));      // a vertex inside an edge
  EXPECT_FALSE(overlap(t, triangle(1, 0, 3, 0, 2, -1)));       // edges along each other
  EXPECT_FALSE(overlap(t, triangle(0, 0, 0, 2, -3, 1)));       // along a vertical edge
  EXPECT_FALSE(overlap(t, triangle(5, 5, 6, 5, 5, 6)));        // far apart
  EXPECT_FALSE(overlap(t, triangle(0, 0, 1, 0.5, 0.5, 0.25))); // no interior
}

TEST(Overlaps, EveryKindIsFound)
{
  const Triangle_uv t = triangle(0, 0, 3, 0, 0, 3);
  EXPECT_TRUE(overlap(t, t));
  EXPECT_TRUE(overlap(t, triangle(0, 0, 0, 3, 3, 0)));          // the same, turned over
  EXPECT_TRUE(overlap(t, triangle(0.5, 0.5, 1, 0.5, 0.5, 1)));  // inside
  EXPECT_TRUE(overlap(t, triangle(2, 2, -1, 2, 2, -1)));        // a star: no vertex inside the other
  EXPECT_TRUE(overlap(t, triangle(0, 0, 3, 0, 1, 1)));          // on a common edge, same side
  EXPECT_TRUE(overlap(t, triangle(1, -1, 2, -1, 1.5, 1e-300))); // by a hair
  EXPECT_TRUE(overlap(t, triangle(-1, -1, 10, -1, -1, 10)));    // around
}

TEST(Overlaps, AgreeWithCommonAreasOnRandomTriangles)
{
  std::mt19937 random(1);
  std::size_t overlapping = 0, free = 0;
  for (int round = 0; round < 3000; ++round) {
    const int size = 2 + round % 7, range = 2 + round % 9;
    std::vector<Triangle_uv> triangles;
    for (int i = 0; i < size; ++i) {
      const auto point = [&] { return Point_2(random() % range, random() % range); };
      triangles.push_back({point(), point(), point()});
    }
    const std::vector<Pair> expected = pairs_by_area(triangles);
    const Overlaps found = find_overlaps(triangles);
    ASSERT_TRUE(found.is_complete);
    ASSERT_EQ(found.pairs, expected) << "round " << round;
    ASSERT_EQ(is_overlap_free(triangles, no_neighbours(triangles)), expected.empty()) << "round " << round;
    ++(expected.empty() ? free : overlapping);
  }
  EXPECT_GT(overlapping, 500u);
  EXPECT_GT(free, 500u);
}

/// Triangles of a grid of the unit square, each vertex moved a little, corners wherever that leaves them.
std::vector<Triangle_uv> shaken_grid(Index n, double strength, unsigned seed, std::vector<Index>& opposite)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-strength / n, strength / n);
  const test::Soup soup = test::planar_grid(n, n);
  std::vector<Point_2> points;
  for (const Point_3& p : soup.points)
    points.emplace_back(p.x() + shift(random), p.y() + shift(random));
  std::vector<Triangle_uv> triangles;
  for (const auto& t : soup.polygons)
    triangles.push_back({points[t[0]], points[t[1]], points[t[2]]});
  opposite = test::surface_of(soup).opposite;
  return triangles;
}

TEST(Overlaps, SweepOverTheBorderAgreesWithAllPairs)
{
  std::size_t free = 0, overlapping = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::vector<Index> opposite;
    const std::vector<Triangle_uv> triangles = shaken_grid(2 + seed % 9, 0.1 + 0.004 * seed, seed, opposite);
    const bool is_free = find_overlaps(triangles).pairs.empty();
    ASSERT_EQ(is_overlap_free(triangles, opposite), is_free) << seed;
    ASSERT_EQ(is_overlap_free(triangles, no_neighbours(triangles)), is_free) << seed;
    ++(is_free ? free : overlapping);
  }
  EXPECT_GT(overlapping, 50u);
  EXPECT_GT(free, 50u);
}

TEST(Overlaps, DoNotDependOnThreads)
{
  std::vector<Index> opposite;
  const std::vector<Triangle_uv> triangles = shaken_grid(60, 1.2, 7, opposite);
  const Overlaps one = find_overlaps(triangles, Execution(1)), four = find_overlaps(triangles, Execution(4));
  EXPECT_GT(one.pairs.size(), 1000u);
  EXPECT_EQ(one.pairs, four.pairs);
  const Overlaps few = find_overlaps(triangles, Execution(1), 100);
  EXPECT_FALSE(few.is_complete);
  EXPECT_EQ(few.pairs.size(), 100u);
  EXPECT_EQ(few.pairs, find_overlaps(triangles, Execution(4), 100).pairs);
}

TEST(Overlaps, AMillionTrianglesInOneSpot)
{
  const std::vector<Triangle_uv> triangles(1'000'000, triangle(0, 0, 1, 0, 0, 1));
  const Overlaps found = find_overlaps(triangles, Execution(0), 100'000);
  EXPECT_FALSE(found.is_complete);
  EXPECT_EQ(found.pairs.size(), 100'000u);
  EXPECT_FALSE(is_overlap_free(triangles, no_neighbours(triangles)));
}

/// Needles side by side along a slanted line: all boxes overlap each other, no two triangles do.
TEST(Overlaps, NeedlesWhoseBoxesAllOverlap)
{
  const Index n = 18'000;
  std::vector<Triangle_uv> needles;
  for (Index i = 0; i < n; ++i) {
    const double a = double(i) / n, b = (i + 0.5) / n;
    needles.push_back(triangle(a, -a, b, -b, a + 100, 100 - a));
  }
  EXPECT_TRUE(is_overlap_free(needles, no_neighbours(needles)));
  const Overlaps none = find_overlaps(needles, Execution(0));
  EXPECT_TRUE(none.pairs.empty());
  EXPECT_FALSE(none.is_complete); // gave up, and says so
  needles[n / 2] = triangle(0.5, -0.5, 0.5 + 2.0 / n, -0.5 - 2.0 / n, 100.5, 99.5);
  EXPECT_FALSE(is_overlap_free(needles, no_neighbours(needles)));
}

TEST(Overlaps, ManyContactsAlongOneLine)
{
  // Two combs of triangles stand on the same line from both sides, with different pitch.
  std::vector<Triangle_uv> triangles;
  for (int i = 0; i < 3000; ++i)
    triangles.push_back(triangle(3 * i, 0, 3 * i + 3, 0, 3 * i + 1, 5));
  for (int i = 0; i < 1800; ++i)
    triangles.push_back(triangle(5 * i, 0, 5 * i + 2, -5, 5 * i + 5, 0));
  EXPECT_TRUE(is_overlap_free(triangles, no_neighbours(triangles)));
  EXPECT_TRUE(find_overlaps(triangles).pairs.empty());
  triangles.back()[0] = Point_2(triangles.back()[0].x(), 1e-9);
  EXPECT_FALSE(is_overlap_free(triangles, no_neighbours(triangles)));
  EXPECT_FALSE(find_overlaps(triangles).pairs.empty());
}

} // namespace
} // namespace Atlas
