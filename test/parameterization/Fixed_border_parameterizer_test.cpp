// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/internal/geometry/border.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>

#include "test_meshes.h"

namespace {

using namespace Atlas;
using internal::Complex;

static_assert(ChartParameterizer<Tutte_parameterizer>);

std::vector<Complex> complex(const Chart& chart)
{
  std::vector<Complex> u;
  for (const Point_2& p : chart.uv)
    u.emplace_back(p.x(), p.y());
  return u;
}

/// A disc of one vertex in the middle and n around it, at random heights.
Chart fan(Index n)
{
  std::mt19937 random(n);
  std::uniform_real_distribution<double> height(0, 1);
  test::Soup soup;
  soup.points.emplace_back(0, 0, 0);
  for (Index i = 0; i < n; ++i)
    soup.points.emplace_back(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), height(random));
  for (Index i = 0; i < n; ++i)
    soup.polygons.push_back({0, 1 + i, 1 + (i + 1) % n});
  return test::chart_of(soup);
}

TEST(Tutte, inner_vertices_are_the_means_of_their_neighbours)
{
  Chart chart = test::chart_of(test::grid(9, 7, [](double x, double y) { return Point_3(x, y, x * y); }));
  ASSERT_EQ(Tutte_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  std::vector<std::set<Index>> neighbors(chart.points.size());
  for (const auto& t : chart.triangles)
    for (int i = 0; i < 3; ++i) {
      neighbors[t[i]].insert(t[(i + 1) % 3]);
      neighbors[t[i]].insert(t[(i + 2) % 3]);
    }
  const std::vector<bool> border = internal::border_vertices(chart);
  const std::vector<Complex> u = complex(chart);
  int inner = 0, outer = 0;
  double radius = 0;
  for (Index v = 0; v < u.size(); ++v) {
    Complex mean = 0;
    for (const Index w : neighbors[v])
      mean += u[w] / double(neighbors[v].size());
    if (border[v]) {
      if (outer++ == 0)
        radius = std::abs(u[v]);
      EXPECT_NEAR(std::abs(u[v]), radius, 1e-12);
    } else {
      ++inner;
      EXPECT_LT(std::abs(mean - u[v]), 1e-12);
    }
  }
  EXPECT_EQ(inner, 8 * 6);
  EXPECT_EQ(outer, 32);
}

TEST(Tutte, maps_hard_discs_one_to_one)
{
  std::vector<Chart> charts{fan(3), fan(10000)};
  // All inner vertices in one place, all border vertices in another: shapes do not matter.
  Chart flat = test::chart_of(test::planar_grid(20, 20));
  std::fill(flat.points.begin(), flat.points.end(), Point_3(1, 1, 1));
  charts.push_back(flat);
  // A sphere with one face missing.
  test::Soup sphere = test::sphere(4);
  sphere.polygons.pop_back();
  charts.push_back(test::chart_of(sphere));
  // A strip, where every vertex is on the border.
  charts.push_back(test::chart_of(test::planar_grid(300, 1)));
  for (Chart& chart : charts) {
    const bool is_point = chart.points.front() == chart.points.back();
    const Chart_status status = Tutte_parameterizer().parameterize(chart, Execution());
    EXPECT_EQ(status, is_point ? Chart_status::flipped : Chart_status::valid);
    for (const auto& [a, b, c] : chart.triangles)
      EXPECT_EQ(CGAL::orientation(chart.uv[a], chart.uv[b], chart.uv[c]) == CGAL::LEFT_TURN, !is_point);
  }
}

TEST(Tutte, refuses_what_has_not_one_border)
{
  Chart sphere = test::chart_of(test::sphere(1));
  EXPECT_EQ(Tutte_parameterizer().parameterize(sphere, Execution()), Chart_status::not_a_disc);
  Chart tube = test::chart_of(test::grid(
      8, 2, [](double x, double y) { return Point_3(std::cos(2 * M_PI * x), std::sin(2 * M_PI * x), y); },
      true));
  EXPECT_EQ(Tutte_parameterizer().parameterize(tube, Execution()), Chart_status::not_a_disc);
}

TEST(Injectivity_checker, sees_flips_crossings_and_touches)
{
  // A strip of five squares, laid out as it is, then bent around.
  Chart chart = test::chart_of(test::planar_grid(5, 1));
  std::vector<Complex> u;
  for (const Point_3& p : chart.points)
    u.emplace_back(5 * p.x(), p.y());
  internal::Injectivity_checker checker(chart);
  EXPECT_TRUE(checker.is_one_to_one(u));
  std::vector<Complex> flipped = u;
  flipped[3] = Complex(flipped[3].real(), flipped[3].imag() > 0.5 ? -5 : 5);
  EXPECT_TRUE(checker.has_flip(flipped));
  EXPECT_GE(checker.number_of_flips(flipped), 1u);
  const auto bent = [&](double turn) {
    std::vector<Complex> w;
    for (const Complex& z : u)
      w.push_back(std::polar(3 - z.imag(), turn * z.real() / 5));
    return w;
  };
  EXPECT_TRUE(checker.is_one_to_one(bent(6)));
  EXPECT_FALSE(checker.has_flip(bent(8)));
  EXPECT_FALSE(checker.is_border_simple(bent(8)));
}

TEST(Injectivity_checker, agrees_with_all_pairs_on_random_polygons)
{
  std::mt19937 random(7);
  int simple = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = 4 + trial % 9;
    Chart chart = fan(n);
    std::uniform_int_distribution<int> coordinate(0, 6);
    std::vector<Complex> u(n + 1);
    for (Index i = 1; i <= n; ++i)
      u[i] = trial % 2 == 0 ? Complex(coordinate(random), coordinate(random))
                            : std::polar(1. + coordinate(random), 2 * M_PI * i / n);
    internal::Injectivity_checker checker(chart);
    bool expected = true;
    for (Index i = 0; i < n; ++i)
      for (Index j = i + 1; j < n; ++j) {
        const auto at = [&](Index k) { return internal::to_point(u[1 + k % n]); };
        const Kernel::Segment_2 s(at(i), at(i + 1)), t(at(j), at(j + 1));
        if (j == i + 1 || (i == 0 && j == n - 1)) {
          const Point_2 shared = j == i + 1 ? at(j) : at(0), p = j == i + 1 ? at(i) : at(1),
                        q = j == i + 1 ? at(j + 1) : at(j);
          expected = expected && !(t.has_on(p) || s.has_on(q)) && shared != p && shared != q;
        } else
          expected = expected && !CGAL::do_intersect(s, t);
      }
    if (expected == true)
      ++simple;
    bool has_zero_edge = false;
    for (Index i = 0; i < n; ++i)
      has_zero_edge = has_zero_edge || u[1 + i] == u[1 + (i + 1) % n];
    if (!has_zero_edge) { // those make flat triangles, which are seen as such
      EXPECT_EQ(checker.is_border_simple(u), expected);
    }
  }
  EXPECT_GT(simple, 100);
  EXPECT_LT(simple, 250);
}

} // namespace
