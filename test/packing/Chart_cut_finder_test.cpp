// SPDX-License-Identifier: MIT
// Where charts are cut so that they need less room on a page.
#include <Atlas/core/Execution.h>
#include <Atlas/packing/internal/cutting/Chart_cut_finder.h>

#include "test_charts.h"
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace Atlas {
namespace {

using namespace test;
using internal::Chart_cut;
using internal::Chart_cut_finder;
using internal::Room_estimate;

/// Unit squares, two triangles each: those of a grid that are in.
Chart squares_chart(int columns, int rows, const std::function<bool(int, int)>& is_in)
{
  std::vector<Point_2> uv;
  std::map<std::pair<int, int>, Index> number;
  const auto at = [&](int x, int y) {
    const auto [it, is_new] = number.try_emplace({x, y}, static_cast<Index>(uv.size()));
    if (is_new)
      uv.emplace_back(x, y);
    return it->second;
  };
  std::vector<std::array<Index, 3>> triangles;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      if (is_in(x, y)) {
        const Index a = at(x, y), b = at(x + 1, y), c = at(x + 1, y + 1), d = at(x, y + 1);
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      }
  return flat_chart(std::move(uv), std::move(triangles));
}

/// What a seam costs along each edge: its length, or more than can be paid.
std::vector<double> lengths(const Chart& chart,
                            const std::function<bool(const Point_2&, const Point_2&)>& may)
{
  std::vector<double> cost;
  for (const auto& triangle : chart.triangles)
    for (int i = 0; i < 3; ++i) {
      const Point_2& p = chart.uv[triangle[i]];
      const Point_2& q = chart.uv[triangle[(i + 1) % 3]];
      cost.push_back(may(p, q) ? std::sqrt(CGAL::squared_distance(p, q))
                               : std::numeric_limits<double>::infinity());
    }
  return cost;
}

bool always(const Point_2&, const Point_2&)
{
  return true;
}

Chart_cut best_cut(const Chart& chart, const std::vector<double>& cost, double side, unsigned threads = 1)
{
  const Room_estimate room{side, 0};
  const double any_cost = std::numeric_limits<double>::infinity();
  return Chart_cut_finder(chart, cost, room, any_cost).best(Execution(threads));
}

std::vector<double> areas(const Chart& chart, const Chart_cut& cut)
{
  std::vector<double> result(cut.number_of_parts, 0);
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const auto& [a, b, c] = chart.triangles[t];
    result[cut.parts[t]] += CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]);
  }
  return result;
}

TEST(ChartCutFinder, AnAngleIsCutAcrossOneArm)
{
  const Chart angle = squares_chart(8, 8, [](int x, int y) { return x < 2 || y < 2; });
  const Chart_cut cut = best_cut(angle, lengths(angle, always), 10);
  ASSERT_EQ(cut.number_of_parts, 2u);
  EXPECT_DOUBLE_EQ(cut.cost, 2);
  EXPECT_GT(cut.gain, 12); // the bay takes up 36, of which a hull has half
  const std::vector<double> pieces = areas(angle, cut);
  EXPECT_DOUBLE_EQ(std::min(pieces[0], pieces[1]), 12);
}

TEST(ChartCutFinder, KeepsAwayFromEdgesThatMustNotBeSeams)
{
  const Chart angle = squares_chart(8, 8, [](int x, int y) { return x < 2 || y < 2; });
  const auto is_outside = [](const Point_2& p, const Point_2& q) { return p.x() > 4 && q.x() > 4; };
  const Chart_cut cut = best_cut(angle, lengths(angle, is_outside), 10);
  ASSERT_EQ(cut.number_of_parts, 2u);
  EXPECT_LE(std::max(areas(angle, cut)[0], areas(angle, cut)[1]), 24);
  for (Index h = 0; h < 3 * angle.triangles.size(); ++h)
    for (Index g = 0; g < h; ++g) {
      const auto end = [&](Index e) { return angle.triangles[e / 3][e % 3]; };
      const bool is_edge = end(h) == end(next_halfedge(g)) && end(g) == end(next_halfedge(h));
      if (is_edge && cut.parts[h / 3] != cut.parts[g / 3]) {
        EXPECT_GT(angle.uv[end(h)].x(), 4);
      }
    }
  const auto never = [](const Point_2&, const Point_2&) { return false; };
  EXPECT_EQ(best_cut(angle, lengths(angle, never), 10).number_of_parts, 0u);
}

TEST(ChartCutFinder, AStripLongerThanThePageIsHalvedFirst)
{
  const Chart strip = squares_chart(40, 1, [](int, int) { return true; });
  const Chart_cut cut = best_cut(strip, lengths(strip, always), 10);
  ASSERT_EQ(cut.number_of_parts, 2u);
  EXPECT_DOUBLE_EQ(cut.cost, 1);
  EXPECT_NEAR(areas(strip, cut)[0], 20, 1);
}

TEST(ChartCutFinder, ARingIsCutThroughItsHole)
{
  const Chart ring = squares_chart(9, 9, [](int x, int y) { return x < 1 || x > 7 || y < 1 || y > 7; });
  const Chart_cut cut = best_cut(ring, lengths(ring, always), 12);
  ASSERT_EQ(cut.number_of_parts, 2u);
  EXPECT_GE(cut.cost, 2);
  EXPECT_LE(cut.cost, 2 * std::sqrt(2.0));
  EXPECT_GT(cut.gain, 0);
}

TEST(ChartCutFinder, DoesNotDependOnTheNumberOfThreads)
{
  const Chart comb = squares_chart(9, 6, [](int x, int y) { return y < 1 || x % 2 == 0; });
  const std::vector<double> cost = lengths(comb, always);
  const Chart_cut one = best_cut(comb, cost, 8, 1), four = best_cut(comb, cost, 8, 4);
  EXPECT_GT(one.number_of_parts, 1u);
  EXPECT_EQ(one.parts, four.parts);
}

} // namespace
} // namespace Atlas
