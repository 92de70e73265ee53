// SPDX-License-Identifier: MIT
// Two hundred charts on which flattenings break: every one is a disc, so a one-to-one map exists, and no
// split may be needed. The verdict is that of the validation room.
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/validation/Exact_validator.h>

#include "test_meshes.h"

namespace {

using namespace Atlas;

using Height = std::function<double(double, double)>;

Chart height_field(Index m, Index n, const Height& height)
{
  return test::chart_of(test::grid(m, n, [&](double x, double y) { return Point_3(x, y, height(x, y)); }));
}

/// Ground with sharp peaks at a few vertices.
Chart spikes(Index n, double height, std::mt19937& random)
{
  return height_field(n, n, [&](double, double) { return random() % 9 == 0 ? height : 0; });
}

/// A saddle z = s (x^2 - y^2) with noise.
Chart saddle(Index n, double steepness, double noise, std::mt19937& random)
{
  std::uniform_real_distribution<double> real(-noise / n, noise / n);
  return height_field(n, n, [&](double x, double y) {
    return steepness * ((x - 0.5) * (x - 0.5) - (y - 0.5) * (y - 0.5)) + real(random);
  });
}

/// A hyperbolic frill: each ring has more vertices than a plane has room for.
Chart crochet(Index rings, double growth)
{
  return test::chart_of(test::grid(96, rings, [=](double x, double y) {
    const double a = 2 * M_PI * 0.98 * x, r = 0.3 + y;
    return Point_3(r * std::cos(a), r * std::sin(a), growth * y * y * std::sin(12 * a));
  }));
}

/// A helical ramp of some turns around an axis, with noise.
Chart helix(double turns, double inner, double noise, std::mt19937& random)
{
  std::uniform_real_distribution<double> real(-noise, noise);
  return test::chart_of(test::grid(static_cast<Index>(30 * turns) + 2, 2, [&](double x, double y) {
    const double a = 2 * M_PI * turns * x, r = inner + y;
    return Point_3(r * std::cos(a), r * std::sin(a), 0.2 * a + real(random));
  }));
}

/// A sphere or a sheet cut along one path of edges that nearly goes through.
Chart slit(Index n, bool is_round, double bend)
{
  const auto sheet = [=](double x, double y) {
    if (!is_round)
      return Point_3(x, y, bend * std::sin(4 * x) * std::sin(4 * y));
    const double a = 2 * M_PI * x, z = 2 * (y + 0.02) / 1.04 - 1, r = std::sqrt(1 - z * z);
    return Point_3(r * std::cos(a), r * std::sin(a), (1 + bend) * z);
  };
  if (!is_round) { // two halves that share the last three vertices of the line between them
    test::Soup soup = test::grid(n, n, sheet);
    const Index row = n / 2;
    std::vector<Index> twin(soup.points.size());
    for (Index v = 0; v < twin.size(); ++v)
      twin[v] = v;
    for (Index i = 0; i + 3 <= n; ++i) {
      const Index v = row * (n + 1) + i;
      twin[v] = static_cast<Index>(soup.points.size());
      soup.points.push_back(soup.points[v]);
    }
    for (auto& polygon : soup.polygons)
      if (*std::max_element(polygon.begin(), polygon.end()) >= (row + 1) * (n + 1))
        for (Index& v : polygon)
          v = twin[v];
    return test::chart_of(soup);
  }
  test::Soup soup = test::grid(2 * n, n, sheet); // open along a meridian, and its south pole closed
  const auto pole = static_cast<Index>(soup.points.size());
  soup.points.emplace_back(0, 0, -(1 + bend));
  for (Index i = 0; i < 2 * n; ++i)
    soup.polygons.push_back({i + 1, i, pole});
  return test::chart_of(soup);
}

/// Cells whose widths vary between 1 and `aspect`, on bent ground.
Chart needles(Index n, double aspect, std::mt19937& random)
{
  std::vector<double> place{0};
  for (Index i = 0; i < 2 * n; ++i)
    place.push_back(place.back() + (random() % 2 ? 1 : aspect));
  return test::chart_of(test::grid(2 * n, n, [&](double x, double y) {
    const double p = place[static_cast<std::size_t>(std::lround(2 * n * x))];
    return Point_3(p, n * y, 0.3 * std::sin(p + 5 * y));
  }));
}

/// Caps: points on or next to the middle of edges, in bad places.
Chart caps(Index n, double height, std::mt19937& random)
{
  test::Soup soup = test::grid(n, n, [](double x, double y) { return Point_3(x, y, 0.2 * std::sin(6 * x)); });
  const std::size_t count = soup.polygons.size();
  for (std::size_t i = 0; i < count; i += 2) {
    const std::vector<Index> t = soup.polygons[i];
    const double along = 0.1 + 0.08 * static_cast<double>(random() % 11);
    const auto v = static_cast<Index>(soup.points.size());
    soup.points.push_back(CGAL::barycenter(soup.points[t[0]], along, soup.points[t[1]], 1 - along - height,
                                           soup.points[t[2]], height));
    soup.polygons[i] = {t[0], t[1], v};
    soup.polygons.insert(soup.polygons.end(), {{t[1], t[2], v}, {t[2], t[0], v}});
  }
  return test::chart_of(soup);
}

/// A fan of so many triangles, its rim wavy; or folded together to needles.
Chart fan(Index valence, double wave, std::mt19937& random)
{
  std::uniform_real_distribution<double> real(0, wave);
  test::Soup soup;
  soup.points.emplace_back(0, 0, 0.5);
  for (Index i = 0; i < valence; ++i) {
    const double a = 2 * M_PI * i / valence;
    soup.points.emplace_back(std::cos(a), std::sin(a), real(random) / valence);
  }
  for (Index i = 0; i < valence; ++i)
    soup.polygons.push_back({0, 1 + i, 1 + (i + 1) % valence});
  return test::chart_of(soup);
}

constexpr unsigned number_of_charts = 200;

Chart hard_chart(unsigned number)
{
  std::mt19937 random(1000 + number);
  const double size = std::uniform_real_distribution<double>(0, 1)(random);
  const unsigned step = number / 10; // 0 to 19
  const Index n = 5 + 3 * (step % 9);
  switch (number % 10) {
  case 0:
    return spikes(n, 0.05 + 2 * size, random);
  case 1:
    return saddle(n, 8 * size, 0.3 * (step % 8), random);
  case 2:
    return crochet(2 + step % 8, 2 * size);
  case 3:
    return helix(0.9 + 7 * size, 0.1 + size, 0.02 * (step % 6), random);
  case 4:
    return slit(n + 4, false, 0.5 * size);
  case 5:
    return slit(n, true, 2 * size);
  case 6:
    return needles(n, std::pow(10, -static_cast<double>(1 + step % 10)), random);
  case 7:
    return caps(n, step % 5 == 0 ? 0 : std::pow(10, -static_cast<double>(step % 13)) / 4, random);
  case 8:
    return fan(step % 10 == 0 ? 10000 : 100 + 100 * step, size, random);
  default: { // all corners at a few places: nothing but connectivity is left
    Chart chart = height_field(n, n, [](double, double) { return 0; });
    for (Point_3& p : chart.points)
      p = Point_3(std::floor(p.x() * (step % 4)), std::floor(p.y() * 2), 0);
    return chart;
  }
  }
}

TEST(Flattening_stress, two_hundred_hard_discs_need_no_split)
{
  const Exact_validator validator(0);
  std::array<std::size_t, 3> starts{};
  std::size_t flips = 0, overlaps = 0;
  for (unsigned number = 0; number < number_of_charts; ++number) {
    Chart chart = hard_chart(number);
    ASSERT_TRUE(topology(chart).is_disc()) << number;
    Flattening_record record;
    ASSERT_EQ(Bijective_parameterizer().parameterize(chart, Execution(), record), Chart_status::valid)
        << number;
    ASSERT_EQ(chart.uv.size(), chart.points.size());
    for (const auto& [a, b, c] : chart.triangles) // also where the chart has no area in space
      ASSERT_EQ(CGAL::orientation(chart.uv[a], chart.uv[b], chart.uv[c]), CGAL::LEFT_TURN) << number;
    const Chart_verdict verdict = validator.validate(chart, Execution());
    EXPECT_TRUE(verdict.is_valid()) << number << ": " << message(verdict.status);
    ++starts[static_cast<std::size_t>(record.start)];
    flips += record.flips > 0;
    overlaps += record.was_overlapping;
  }
  // The set is hard: LSCM alone fails often, in both ways.
  EXPECT_GT(flips, 20u);
  EXPECT_GT(overlaps, 20u);
  EXPECT_LT(starts[0], number_of_charts - 20);
}

} // namespace
