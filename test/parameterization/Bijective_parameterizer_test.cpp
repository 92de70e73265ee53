// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>

#include "flattening_checks.h"

namespace {

using namespace Atlas;
using test::height_field;
using test::is_one_to_one;
using test::mean_energy;
using test::spiral;
using test::tube;

static_assert(ChartParameterizer<Bijective_parameterizer>);

TEST(Bijective_parameterizer, keeps_what_is_one_to_one)
{
  Chart chart = test::chart_of(
      test::grid(8, 8, [](double x, double y) { return Point_3(x, y, 0.2 * std::sin(5 * x + y)); }));
  Chart lscm = chart;
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
  Flattening_record record;
  ASSERT_EQ(Bijective_parameterizer(Optimize_charts::if_needed).parameterize(chart, Execution(), record),
            Chart_status::valid);
  EXPECT_EQ(chart.uv, lscm.uv);
  EXPECT_FALSE(record.is_optimized);
  ASSERT_EQ(Bijective_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid);
  EXPECT_EQ(record.start, Flattening_start::first_choice);
  EXPECT_TRUE(record.is_optimized);
  EXPECT_LT(mean_energy(chart), mean_energy(lscm));
}

TEST(Bijective_parameterizer, repairs_overlaps)
{
  for (const double turns : {1.3, 2.5}) {
    Chart chart = spiral(turns), lscm = chart;
    ASSERT_EQ(LSCM_parameterizer<>().parameterize(lscm, Execution()), Chart_status::valid);
    ASSERT_FALSE(is_one_to_one(lscm));
    Flattening_record record;
    EXPECT_EQ(Bijective_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid);
    EXPECT_TRUE(record.was_overlapping);
    EXPECT_TRUE(is_one_to_one(chart));
    EXPECT_LT(mean_energy(chart), 3);
  }
}

TEST(Bijective_parameterizer, repairs_flips)
{
  std::size_t flips = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    Chart chart = height_field(16, 2, seed);
    Flattening_record record;
    EXPECT_EQ(Bijective_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid);
    flips += record.flips;
    EXPECT_TRUE(is_one_to_one(chart));
    if (record.flips > 0) {
      EXPECT_EQ(record.start, Flattening_start::tutte);
    }
  }
  EXPECT_GT(flips, 0u);
}

/// Mean over the area of the ratio of the singular values and its inverse, over 2.
double mean_shear(const Chart& chart)
{
  double sum = 0, total = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    const Vector_3 p = chart.points[b] - chart.points[a], q = chart.points[c] - chart.points[a];
    const Vector_2 s = chart.uv[b] - chart.uv[a], t = chart.uv[c] - chart.uv[a];
    const double space = std::sqrt(CGAL::cross_product(p, q).squared_length()),
                 plane = s.x() * t.y() - s.y() * t.x();
    sum += ((q * q) * (s * s) - 2 * (p * q) * (s * t) + (p * p) * (t * t)) / (2 * plane);
    total += space;
  }
  return sum / total;
}

TEST(Bijective_parameterizer, repairs_flips_conformally_if_asked_to)
{
  std::size_t flips = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    Chart chart = height_field(16, 2, seed), isometric = chart;
    Flattening_record record;
    ASSERT_EQ(Bijective_parameterizer(Optimize_charts::if_needed).parameterize(chart, Execution(), record),
              Chart_status::valid);
    ASSERT_EQ(Bijective_parameterizer().parameterize(isometric, Execution()), Chart_status::valid);
    flips += record.flips;
    EXPECT_TRUE(is_one_to_one(chart));
    if (record.is_optimized) {
      EXPECT_LT(mean_shear(chart) - 1, 0.95 * (mean_shear(isometric) - 1));
    }
  }
  EXPECT_GT(flips, 0u);
}

TEST(Bijective_parameterizer, needs_no_more_than_connectivity)
{
  for (const Index rings : {20, 150}) {
    Chart chart = tube(rings);
    Flattening_record record;
    EXPECT_EQ(Bijective_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid);
    EXPECT_TRUE(is_one_to_one(chart));
  }
  Chart folded = test::chart_of(test::planar_grid(5, 5)); // needles: columns of vertices in one place
  for (Point_3& p : folded.points)
    p = Point_3(std::floor(p.x() * 2), p.y(), 0);
  EXPECT_EQ(Bijective_parameterizer().parameterize(folded, Execution()), Chart_status::valid);
  EXPECT_TRUE(is_one_to_one(folded));
}

/// A first choice of another kind: every chart is folded along a line.
struct Folding_parameterizer
{
  Chart_status parameterize(Chart& chart, const Execution&) const
  {
    chart.uv.clear();
    for (const Point_3& p : chart.points)
      chart.uv.emplace_back(std::abs(p.x() - 0.5), p.y());
    return Chart_status::valid;
  }
};

TEST(Bijective_parameterizer, takes_any_first_choice)
{
  Chart chart = test::chart_of(test::planar_grid(6, 6));
  Flattening_record record;
  const Bijective_parameterizer parameterizer(Optimize_charts::if_needed, {}, Folding_parameterizer());
  ASSERT_EQ(parameterizer.parameterize(chart, Execution(), record), Chart_status::valid);
  EXPECT_EQ(record.flips, 36u);
  EXPECT_EQ(record.start, Flattening_start::tutte);
  EXPECT_TRUE(is_one_to_one(chart));
}

TEST(Bijective_parameterizer, checks_its_arguments)
{
  for (const double bad : {-1e-9, std::nan("")}) {
    Distortion_options tolerance, target;
    tolerance.tolerance = target.target = bad;
    EXPECT_THROW(Bijective_parameterizer(Optimize_charts::always, tolerance), Invalid_argument);
    EXPECT_THROW(Bijective_parameterizer(Optimize_charts::always, target), Invalid_argument);
  }
  Chart chart = test::chart_of(test::planar_grid(2, 2));
  chart.triangles[3][1] = 9;
  EXPECT_THROW((void)Bijective_parameterizer().parameterize(chart, Execution()), Invalid_argument);
}

TEST(Bijective_parameterizer, says_why_it_refuses)
{
  Chart sphere = test::chart_of(test::sphere(1)), torus = test::chart_of(test::torus(5, 4));
  EXPECT_EQ(Bijective_parameterizer().parameterize(sphere, Execution()), Chart_status::not_a_disc);
  EXPECT_EQ(Bijective_parameterizer().parameterize(torus, Execution()), Chart_status::not_a_disc);
  Chart chart = test::chart_of(test::planar_grid(4, 4));
  const Execution execution;
  execution.cancel();
  EXPECT_EQ(Bijective_parameterizer().parameterize(chart, execution), Chart_status::cancelled);
}

/// The kinds of charts on which flattenings break, by number.
Chart stress_chart(unsigned number)
{
  std::mt19937 random(number);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const Index n = 6 + number % 13;
  const double size = uniform(0.5, 4);
  switch (number % 8) {
  case 0: // rugged terrain
    return height_field(n, size, number);
  case 1: // saddles, up to very steep ones
    return test::chart_of(test::grid(
        n, n, [=](double x, double y) { return Point_3(x, y, 3 * size * (x - 0.5) * (y - 0.5)); }));
  case 2:
    return spiral(size);
  case 3: // a frilled ring
    return test::chart_of(test::grid(12 * n, 3, [=](double x, double y) {
      const double a = 6.1 * x;
      return Point_3((1 + y) * std::cos(a), (1 + y) * std::sin(a), size * y * std::sin(9 * a));
    }));
  case 4: { // columns of needles, of aspect 1e-9 and below
    const double width = std::pow(10, -9 - std::floor(3 * size));
    return test::chart_of(test::grid(2 * n, n, [=](double x, double y) {
      const int column = static_cast<int>(std::lround(2 * n * x));
      return Point_3((column / 2 + column % 2 * width) / n, y, 0.1 * std::sin(5 * y));
    }));
  }
  case 5: { // a vertex of valence 10,000, or less
    test::Soup soup;
    const Index valence = number % 16 == 5 ? 10000 : 50 * n;
    soup.points.emplace_back(0, 0, uniform(-1, 1));
    for (Index i = 0; i < valence; ++i) {
      const double a = 2 * M_PI * i / valence;
      soup.points.emplace_back(std::cos(a), std::sin(a), uniform(0, size / valence));
    }
    for (Index i = 0; i < valence; ++i)
      soup.polygons.push_back({0, 1 + i, 1 + (i + 1) % valence});
    return test::chart_of(soup);
  }
  case 6: // deep tubes
    return tube(n + 5 * (number % 20));
  default: { // caps, of height 0 to 1e-6, on flat ground
    test::Soup soup = test::planar_grid(n, n);
    const double height = number % 3 == 0 ? 0 : std::pow(10, -3 * size);
    const std::size_t count = soup.polygons.size();
    for (std::size_t i = 0; i < count; i += 3) {
      const std::vector<Index> t = soup.polygons[i];
      const Index v = static_cast<Index>(soup.points.size());
      soup.points.push_back(CGAL::barycenter(soup.points[t[0]], 0.5, soup.points[t[1]], 0.5 - height,
                                             soup.points[t[2]], height));
      soup.polygons[i] = {t[0], t[1], v};
      soup.polygons.insert(soup.polygons.end(), {{t[1], t[2], v}, {t[2], t[0], v}});
    }
    return test::chart_of(soup);
  }
  }
}

TEST(Bijective_parameterizer, flattens_two_hundred_hard_charts_one_to_one)
{
  std::array<int, 3> starts{};
  for (unsigned number = 0; number < 200; ++number) {
    Chart chart = stress_chart(number);
    Flattening_record record;
    ASSERT_TRUE(topology(chart).is_disc()) << number;
    EXPECT_EQ(Bijective_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid)
        << number;
    if (chart.number_of_triangles() < 5000) { // the test looks at all pairs of border edges
      EXPECT_TRUE(is_one_to_one(chart)) << number;
    }
    ++starts[static_cast<int>(record.start)];
  }
  for (const int count : starts) // all ways are needed
    EXPECT_GT(count, 0);
}

} // namespace
