// SPDX-License-Identifier: MIT
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/pipeline/internal/round_coordinates.h>
#include <Atlas/validation/Culprit_splitter.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/internal/chart_faults.h>
#include <Atlas/validation/internal/split_chart.h>

#include "test_meshes.h"
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace Atlas {
namespace {

using test::chart_of;
using test::Soup;

const Execution execution;

/// A strip of 1 x n cells, bent in the plane into a ring sector of the given angle; flat in space.
Chart strip(Index n, double angle, Index rows = 2)
{
  Chart chart =
      chart_of(test::grid(n, rows, [n, rows](double x, double y) { return Point_3(n * x, rows * y, 0); }));
  for (const Point_3& p : chart.points) {
    const double phi = angle * p.x() / n, r = n / angle + rows / 2.0 - p.y();
    chart.uv.emplace_back(r * std::sin(phi), -r * std::cos(phi));
  }
  for (Point_2& p : chart.uv)
    p = Point_2(p.x(), -p.y());
  for (auto& t : chart.triangles)
    if (CGAL::orientation(chart.uv[t[0]], chart.uv[t[1]], chart.uv[t[2]]) == CGAL::RIGHT_TURN)
      std::swap(t[1], t[2]);
  return chart;
}

Chart flat_grid(Index n)
{
  Chart chart = chart_of(test::planar_grid(n, n));
  for (const Point_3& p : chart.points)
    chart.uv.emplace_back(p.x(), p.y());
  return chart;
}

/// The triangles of one part, as a chart.
Chart part_of(const Chart& chart, const std::vector<Index>& parts, Index part)
{
  Chart result = chart;
  result.triangles.clear();
  result.source.clear();
  for (Index t = 0; t < parts.size(); ++t)
    if (parts[t] == part) {
      result.triangles.push_back(chart.triangles[t]);
      result.source.push_back(chart.source[t]);
    }
  return result;
}

std::size_t number_of_parts(const std::vector<Index>& parts)
{
  const std::set<Index> names(parts.begin(), parts.end());
  EXPECT_EQ(*names.rbegin() + 1, names.size()); // 0, 1, ... without gaps
  return names.size();
}

/// Splits, without flattening again, until every part is accepted. Returns the number of parts, and rounds.
std::pair<std::size_t, int> split_until_valid(const Chart& chart, const Exact_validator& validator)
{
  std::vector<Chart> open{chart};
  std::size_t accepted = 0;
  int rounds = 0;
  for (; !open.empty() && rounds < 100; ++rounds) {
    std::vector<Chart> next;
    for (const Chart& c : open) {
      const Chart_verdict verdict = validator.validate(c, execution);
      if (verdict.is_valid()) {
        ++accepted;
        continue;
      }
      EXPECT_FALSE(verdict.culprits.empty());
      EXPECT_TRUE(std::is_sorted(verdict.culprits.begin(), verdict.culprits.end()));
      const std::vector<Index> parts = Culprit_splitter(validator.area_quantile()).split(c, verdict);
      EXPECT_EQ(parts.size(), c.number_of_triangles());
      const std::size_t count = number_of_parts(parts);
      EXPECT_GE(count, 2u);
      for (Index p = 0; p < count; ++p)
        next.push_back(part_of(c, parts, p));
    }
    open = std::move(next);
  }
  EXPECT_LT(rounds, 100);
  return {accepted, rounds};
}

TEST(ExactValidator, AcceptsWhatIsOneToOne)
{
  EXPECT_TRUE(Exact_validator().validate(flat_grid(8), execution).is_valid());
  EXPECT_TRUE(Exact_validator(0).validate(strip(60, 6.2), execution).is_valid());
}

TEST(ExactValidator, ContactOfTheBorderIsNoOverlap)
{
  // A ring that closes up exactly: first and last column of vertices coincide.
  Chart chart = strip(16, 2 * M_PI, 1);
  for (Index v = 0; v < chart.points.size(); ++v)
    if (chart.points[v].x() == 16)
      for (Index w = 0; w < chart.points.size(); ++w)
        if (chart.points[w].x() == 0 && chart.points[w].y() == chart.points[v].y())
          chart.uv[v] = chart.uv[w];
  EXPECT_TRUE(Exact_validator(0).validate(chart, execution).is_valid());
}

TEST(ExactValidator, FindsOverlapWithoutFlip)
{
  const Chart chart = strip(60, 7);
  const Chart_verdict verdict = Exact_validator(0).validate(chart, execution);
  EXPECT_EQ(verdict.status, Chart_status::overlapping);
  // Only the two ends lie on each other: an angle of 7 - 2 pi on either side.
  for (const Index t : verdict.culprits) {
    const double x = chart.points[chart.triangles[t][0]].x();
    EXPECT_TRUE(x < 8 || x > 52) << x;
  }
  EXPECT_GE(verdict.culprits.size(), 12u);
}

TEST(ExactValidator, FindsAVertexThatIsPassedTwice)
{
  // Eight triangles around a vertex that wind around it twice: every triangle is fine, and so is no pair of
  // neighbours to blame.
  Soup soup;
  soup.points.emplace_back(0, 0, 0);
  for (int i = 0; i < 8; ++i)
    soup.points.emplace_back(std::cos(i * M_PI / 4), std::sin(i * M_PI / 4), i % 2);
  for (Index i = 0; i < 8; ++i)
    soup.polygons.push_back({0, 1 + i, 1 + (i + 1) % 8});
  Chart chart = chart_of(soup);
  chart.uv.resize(chart.points.size());
  for (Index v = 0; v < chart.points.size(); ++v) {
    const int i = static_cast<int>(std::find(soup.points.begin(), soup.points.end(), chart.points[v]) -
                                   soup.points.begin());
    const double phi = (i - 1) * M_PI / 2;
    chart.uv[v] =
        i == 0 ? Point_2(0, 0) : Point_2(std::cos(phi) * (1 + 0.1 * i), std::sin(phi) * (1 + 0.1 * i));
  }
  EXPECT_EQ(Exact_validator(0).validate(chart, execution).status, Chart_status::overlapping);
  EXPECT_LE(split_until_valid(chart, Exact_validator(0)).first, 4u);
}

TEST(ExactValidator, FlippedAndFlatTrianglesAreToBlame)
{
  Chart chart = flat_grid(6);
  const Index middle = 3 * 7 + 3;
  chart.uv[middle] = Point_2(chart.uv[middle].x() + 0.4, chart.uv[middle].y());
  Chart_verdict verdict = Exact_validator().validate(chart, execution);
  EXPECT_EQ(verdict.status, Chart_status::flipped);
  std::vector<Index> expected;
  for (Index t = 0; t < chart.number_of_triangles(); ++t) {
    const auto& [a, b, c] = chart.triangles[t];
    if (CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]) <= 0)
      expected.push_back(t);
  }
  EXPECT_EQ(verdict.culprits, expected);
  EXPECT_FALSE(expected.empty());

  chart = flat_grid(1);
  chart.uv = {Point_2(0, 0), Point_2(1, 0), Point_2(2, 0), Point_2(3, 0)};
  verdict = Exact_validator().validate(chart, execution);
  EXPECT_EQ(verdict.status, Chart_status::flipped);
  EXPECT_EQ(verdict.culprits, (std::vector<Index>{0, 1}));
}

TEST(ExactValidator, TrianglesWithoutAreaInSpaceMayBeFlatButNotFlipped)
{
  Chart chart;
  chart.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  chart.triangles = {{0, 1, 2}, {2, 3, 0}};
  chart.source = {0, 1};
  chart.uv = {{0, 0}, {1, 0}, {2, 0}, {1, 1}};
  EXPECT_TRUE(Exact_validator().validate(chart, execution).is_valid());
  chart.uv[1] = {1, 0.1}; // clockwise now
  EXPECT_EQ(Exact_validator().validate(chart, execution).culprits, std::vector<Index>{0});
  chart.uv[1] = {1, -0.1};
  EXPECT_TRUE(Exact_validator().validate(chart, execution).is_valid());
}

TEST(ExactValidator, MeasuresTheAreaRatio)
{
  Chart chart = flat_grid(10);
  for (Point_2& p : chart.uv) // density grows from 1 to 3 in x
    p = Point_2(p.x() + p.x() * p.x(), p.y());
  // The outermost triangles reach from x = 0 to 0.1, and from 0.9 to 1: ratio (1 + 1.9) / (1 + 0.1).
  const double ratio = 2.9 / 1.1;
  EXPECT_TRUE(Exact_validator(ratio * 1.0001).validate(chart, execution).is_valid());
  const Chart_verdict verdict = Exact_validator(ratio * 0.9999).validate(chart, execution);
  EXPECT_EQ(verdict.status, Chart_status::area_ratio_exceeded);
  EXPECT_EQ(verdict.culprits.size(), 2u);
  EXPECT_TRUE(Exact_validator(0).validate(chart, execution).is_valid());
  EXPECT_TRUE(Exact_validator(INFINITY).validate(chart, execution).is_valid());
  // Without a tenth of the area at either end: columns 1 to 8.
  EXPECT_TRUE(Exact_validator(2.7 / 1.3 * 1.0001, 0.101).validate(chart, execution).is_valid());
  EXPECT_FALSE(Exact_validator(2.7 / 1.3 * 0.9999, 0.101).validate(chart, execution).is_valid());
  // A split by density: a few parts are enough.
  EXPECT_LE(split_until_valid(chart, Exact_validator(2)).first, 3u);
}

TEST(ExactValidator, NumbersThatAreMissingOrNotFinite)
{
  Chart chart = flat_grid(2);
  chart.uv[3] = Point_2(NAN, 0);
  const Chart_verdict verdict = Exact_validator().validate(chart, execution);
  EXPECT_EQ(verdict.status, Chart_status::solver_failed);
  EXPECT_EQ(number_of_parts(Culprit_splitter().split(chart, verdict)), 2u);
  chart.uv.clear();
  EXPECT_EQ(Exact_validator().validate(chart, execution).status, Chart_status::solver_failed);
  EXPECT_EQ(number_of_parts(Culprit_splitter().split(chart, {Chart_status::not_a_disc, {}})), 2u);
}

TEST(ExactValidator, AnOverlapOfTheEndsCostsOneCut)
{
  const auto [parts, rounds] = split_until_valid(strip(60, 7), Exact_validator(0));
  EXPECT_EQ(parts, 2u);
  // Winding twice and a half, it takes three pieces at least.
  const auto [many, many_rounds] = split_until_valid(strip(200, 15), Exact_validator(0));
  EXPECT_LE(many, 8u);
  EXPECT_LE(many_rounds, 6);
}

/// Pairs of triangles whose interiors meet, each tried with each.
std::vector<std::pair<Index, Index>> overlapping_pairs(const Chart& chart)
{
  const auto corners = [&](Index t) {
    const auto& [a, b, c] = chart.triangles[t];
    return std::array{chart.uv[a], chart.uv[b], chart.uv[c]};
  };
  const auto is_apart = [](const auto& s, const auto& t) { // by the line of an edge of s
    for (int i = 0; i < 3; ++i)
      if (std::none_of(t.begin(), t.end(), [&](const Point_2& p) {
            return CGAL::orientation(s[i], s[(i + 1) % 3], p) == CGAL::LEFT_TURN;
          }))
        return true;
    return false;
  };
  std::vector<std::pair<Index, Index>> pairs;
  for (Index s = 0; s < chart.number_of_triangles(); ++s)
    for (Index t = s + 1; t < chart.number_of_triangles(); ++t)
      if (!is_apart(corners(s), corners(t)) && !is_apart(corners(t), corners(s)))
        pairs.emplace_back(s, t);
  return pairs;
}

/// A winding stair without steps: a ribbon of so many turns about an axis, flattened by LSCM, which has to
/// turn as far and covers itself.
Chart winding_ribbon(double turns)
{
  Chart chart = chart_of(test::grid(64, 3, [turns](double x, double y) {
    const double a = 2 * M_PI * turns * x, r = 2 + y;
    return Point_3(-r * std::cos(a), r * std::sin(a), 0.2 * a);
  }));
  EXPECT_EQ(LSCM_parameterizer<>().parameterize(chart, execution), Chart_status::valid);
  return chart;
}

TEST(ExactValidator, CutsAlongTheBorderOfTheOverlappedZone)
{
  // Figure 6 of the paper. The ends of the ribbon cover each other; one of the two comes off whole.
  const Chart chart = winding_ribbon(1.3);
  const Chart_verdict verdict = Exact_validator(0).validate(chart, execution);
  ASSERT_EQ(verdict.status, Chart_status::overlapping);
  std::set<Index> zone;
  for (const auto& [s, t] : overlapping_pairs(chart))
    zone.insert({s, t});
  EXPECT_EQ(verdict.culprits, std::vector<Index>(zone.begin(), zone.end()));
  EXPECT_LT(zone.size(), chart.number_of_triangles() * 2 / 3);

  const std::vector<Index> parts = Culprit_splitter().split(chart, verdict);
  ASSERT_EQ(number_of_parts(parts), 2u);
  const std::vector<Index> opposite = internal::opposite_halfedges(chart.triangles);
  std::size_t cuts = 0;
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] != no_index && parts[h / 3] != parts[opposite[h] / 3]) {
      EXPECT_NE(zone.contains(h / 3), zone.contains(opposite[h] / 3));
      ++cuts;
    }
  EXPECT_GT(cuts, 0u);
  EXPECT_LE(cuts / 2, 12u); // across the ribbon, once
  for (Index p = 0; p < 2; ++p)
    EXPECT_TRUE(overlapping_pairs(part_of(chart, parts, p)).empty());
  // What comes off is a piece of the zone; the other piece stays with the rest.
  const auto middle = static_cast<Index>(chart.number_of_triangles() / 2);
  ASSERT_FALSE(zone.contains(middle));
  std::size_t off = 0;
  for (Index t = 0; t < parts.size(); ++t)
    if (parts[t] != parts[middle]) {
      EXPECT_TRUE(zone.contains(t));
      ++off;
    }
  EXPECT_GT(off, zone.size() / 3);
  EXPECT_LT(off, zone.size() * 2 / 3);
}

/// Parts of a strip of 20 cells, two triangles each, in which the given pairs of cells are said to overlap.
std::vector<Index> parts_of_strip(const std::vector<std::pair<Index, Index>>& cells)
{
  const Chart chart = chart_of(test::grid(20, 1, [](double x, double y) { return Point_3(20 * x, y, 0); }));
  const internal::Chart_graph graph(chart);
  std::vector<std::pair<Index, Index>> pairs;
  for (const auto& [a, b] : cells)
    pairs.insert(pairs.end(), {{2 * a, 2 * b}, {2 * a + 1, 2 * b + 1}});
  const std::vector<Index> parts =
      internal::renumber(internal::cut_off(chart, graph, internal::Overlapped_zone(graph, pairs)));
  std::vector<Index> of_cells;
  for (Index t = 0; t < parts.size(); t += 2) {
    EXPECT_EQ(parts[t], parts[t + 1]);
    of_cells.push_back(parts[t]);
  }
  return of_cells;
}

TEST(ExactValidator, AsFewPiecesOfTheZoneComeOffAsWillDo)
{
  // Cells 2 and 3 are one piece of the zone, under cell 10 and cell 15. It comes off, and cells 0 and 1,
  // which hang on it, go with it.
  std::vector<Index> expected(20, 1);
  std::fill_n(expected.begin(), 4, 0);
  EXPECT_EQ(parts_of_strip({{2, 10}, {3, 15}}), expected);

  // Cell 12 comes off; what it parts from the rest covers it, and is a part of its own.
  expected.assign(20, 0);
  expected[12] = 1;
  std::fill(expected.begin() + 13, expected.end(), 2);
  EXPECT_EQ(parts_of_strip({{12, 16}}), expected);
}

TEST(ExactValidator, GrowsTwoPartsFromTheExtremeTriangles)
{
  // A deep bowl; the conformal map magnifies one end of it by far.
  Chart chart = chart_of(test::grid(24, 16, [](double x, double y) {
    const double a = 2 * M_PI * x * 0.9, b = 0.1 + 2.4 * y;
    return Point_3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
  }));
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, execution), Chart_status::valid);
  const auto density = [&](Index t) {
    const auto& [a, b, c] = chart.triangles[t];
    return std::sqrt(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c])) /
           std::abs(CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]));
  };
  Index low = 0, high = 0;
  for (Index t = 1; t < chart.number_of_triangles(); ++t) {
    low = density(t) < density(low) ? t : low;
    high = density(t) > density(high) ? t : high;
  }
  ASSERT_GT(density(high) / density(low), 4);
  const Exact_validator validator;
  const Chart_verdict verdict = validator.validate(chart, execution);
  ASSERT_EQ(verdict.status, Chart_status::area_ratio_exceeded);
  EXPECT_EQ(verdict.culprits, (std::vector<Index>{std::min(low, high), std::max(low, high)}));
  const std::vector<Index> parts = Culprit_splitter(validator.area_quantile()).split(chart, verdict);
  ASSERT_EQ(number_of_parts(parts), 2u);
  EXPECT_NE(parts[low], parts[high]);
  const internal::Chart_graph graph(chart);
  for (const Index seed : {low, high}) {
    // Both grew from their seeds: they hang together, and their densities spread less.
    EXPECT_EQ(graph.components([&](Index t) { return parts[t] == parts[seed]; }).second, 1u);
    double least = density(seed), most = density(seed);
    for (Index t = 0; t < parts.size(); ++t)
      if (parts[t] == parts[seed]) {
        least = std::min(least, density(t));
        most = std::max(most, density(t));
      }
    EXPECT_LT(most / least, 0.9 * density(high) / density(low));
  }
}

TEST(ExactValidator, EverythingEndsInFewRounds)
{
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    Chart chart = flat_grid(12);
    for (Point_2& p : chart.uv) // rubbish
      p = Point_2(double(random()), double(random()));
    for (auto& t : chart.triangles) // that is nowhere flipped
      if (CGAL::orientation(chart.uv[t[0]], chart.uv[t[1]], chart.uv[t[2]]) == CGAL::RIGHT_TURN)
        std::swap(t[1], t[2]);
    EXPECT_LE(split_until_valid(chart, Exact_validator(0)).second, 40);
  }
}

/// A flat disc of rings, each half the size of the one around it, on a page.
Chart graded_disc(Index rings)
{
  constexpr Index n = 12;
  Soup soup;
  for (Index k = 0; k < rings; ++k)
    for (Index i = 0; i < n; ++i) {
      const double r = std::ldexp(0.5, -static_cast<int>(k)), a = 2 * M_PI * i / n;
      soup.points.emplace_back(r * std::cos(a), r * std::sin(a), 0);
    }
  for (Index k = 0; k + 1 < rings; ++k)
    for (Index i = 0; i < n; ++i) {
      const Index a = k * n + i, b = k * n + (i + 1) % n;
      soup.polygons.insert(soup.polygons.end(), {{a, b, b + n}, {a, b + n, a + n}});
    }
  Chart chart = chart_of(soup);
  for (const Point_3& p : chart.points)
    chart.uv.emplace_back(p.x() + 0.5, p.y() + 0.5);
  return chart;
}

TEST(ExactValidator, WhatIsTooSmallForThePageComesOffWithAScaleOfItsOwn)
{
  const Exact_validator validator(0);
  const Chart chart = graded_disc(30);
  ASSERT_TRUE(validator.validate(chart, execution).is_valid());
  Chart rounded = chart;
  const Chart_verdict verdict{Chart_status::flipped, internal::Grid_rounding(rounded)()};
  ASSERT_FALSE(verdict.culprits.empty());
  const std::vector<Index> parts = Culprit_splitter(validator.area_quantile()).split(chart, verdict);
  ASSERT_EQ(number_of_parts(parts), 2u);
  Chart rest = part_of(chart, parts, 0), core = part_of(chart, parts, 1);
  EXPECT_TRUE(
      std::all_of(verdict.culprits.begin(), verdict.culprits.end(), [&](Index t) { return parts[t] == 1; }));
  EXPECT_LT(core.number_of_triangles(), verdict.culprits.size() + 10 * 12);
  // What stays survives the rounding, and what comes off does once it has the size of a texel.
  EXPECT_TRUE(internal::Grid_rounding(rest)().empty());
  const double size =
      std::sqrt(CGAL::squared_distance(core.points[core.triangles[0][0]], core.points[core.triangles[0][2]]));
  for (Point_2& p : core.uv)
    p = Point_2((p.x() - 0.5) / size / 4096 + 0.5, (p.y() - 0.5) / size / 4096 + 0.5);
  EXPECT_TRUE(internal::Grid_rounding(core)().empty());
  EXPECT_TRUE(validator.validate(core, execution).is_valid());

  // A needle that does not survive is not small: it comes off alone.
  const Chart flat = flat_grid(20);
  const std::vector<Index> one =
      Culprit_splitter(validator.area_quantile()).split(flat, {Chart_status::flipped, {17}});
  EXPECT_EQ(std::count(one.begin(), one.end(), 1u), 1);
  EXPECT_EQ(one[17], 1u);
}

TEST(ExactValidator, HalvesAreHalves)
{
  for (const Index n : {1u, 2u, 3u, 7u, 20u}) {
    const Chart chart = flat_grid(n);
    const std::vector<Index> parts = Culprit_splitter().split(chart, {Chart_status::solver_failed, {}});
    EXPECT_EQ(std::count(parts.begin(), parts.end(), 0u), n * n);
    EXPECT_EQ(std::count(parts.begin(), parts.end(), 1u), n * n);
    // A clean cut: hardly longer than a diagonal.
    const std::vector<Index> opposite = internal::opposite_halfedges(chart.triangles);
    Index cut = 0;
    for (Index h = 0; h < opposite.size(); ++h)
      cut += opposite[h] != no_index && h < opposite[h] && parts[h / 3] != parts[opposite[h] / 3];
    EXPECT_LE(cut, 3 * n);
  }
}

TEST(ExactValidator, SplitsChartsInOneSpotAndInPieces)
{
  Chart chart = flat_grid(3);
  for (Point_3& p : chart.points)
    p = Point_3(1, 1, 1);
  EXPECT_EQ(number_of_parts(Culprit_splitter().split(chart, {Chart_status::solver_failed, {}})), 2u);
  Chart two =
      chart_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}});
  EXPECT_EQ(Culprit_splitter().split(two, {Chart_status::not_a_disc, {}}), (std::vector<Index>{0, 1}));
  two.triangles.pop_back();
  EXPECT_EQ(Culprit_splitter().split(two, {Chart_status::flipped, {0}}), std::vector<Index>{0});
}

} // namespace
} // namespace Atlas
