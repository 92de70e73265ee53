// SPDX-License-Identifier: MIT
#include <Atlas/core/build_surface.h>
#include <Atlas/core/concepts.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/halfedges.h>

#include "test_meshes.h"
#include <algorithm>
#include <array>
#include <random>

namespace Atlas::test {
namespace {

Index border_halfedges(const Surface& surface)
{
  return static_cast<Index>(std::count(surface.opposite.begin(), surface.opposite.end(), no_index));
}

TEST(BuildSurface, AdjacencyIsSymmetricAndRunsAlongTheSameEdge)
{
  const Surface s = surface_of(torus(8, 5));
  EXPECT_EQ(border_halfedges(s), 0u);
  for (Index h = 0; h < s.opposite.size(); ++h) {
    const Index o = s.opposite[h];
    EXPECT_EQ(s.opposite[o], h);
    EXPECT_EQ(s.point(h), s.point(next_halfedge(o)));
    EXPECT_EQ(s.point(next_halfedge(h)), s.point(o));
  }
}

TEST(BuildSurface, QuadsKeepTheirCornersAndDiagonals)
{
  const Surface s = surface_of(cube());
  EXPECT_EQ(s.number_of_faces, 6u);
  EXPECT_EQ(s.number_of_corners, 24u);
  EXPECT_EQ(s.number_of_triangles(), 12u);
  Index diagonals = 0;
  for (Index h = 0; h < s.opposite.size(); ++h)
    diagonals += s.is_diagonal(h);
  EXPECT_EQ(diagonals, 12u);
  std::set<Index> corners(s.corner.begin(), s.corner.end());
  EXPECT_EQ(corners.size(), 24u);
}

TEST(BuildSurface, StitchesSplitVerticesByPosition)
{
  Soup soup;
  for (const auto& t : sphere(2).polygons)
    for (const Index v : t) {
      if (soup.points.size() % 3 == 0)
        soup.polygons.push_back({});
      soup.polygons.back().push_back(static_cast<Index>(soup.points.size()));
      soup.points.push_back(sphere(2).points[v]);
    }
  EXPECT_EQ(border_halfedges(surface_of(soup)), 0u);
}

TEST(BuildSurface, EdgesWithThreeTrianglesAndWrongOrientationStayOpen)
{
  Soup book{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  EXPECT_EQ(border_halfedges(surface_of(book)), 9u);
  Soup twisted{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}}};
  EXPECT_EQ(border_halfedges(surface_of(twisted)), 6u);
}

/// How many triangles each part of the surface has, ascending.
std::vector<std::size_t> part_sizes(const Surface& s)
{
  std::vector<std::size_t> sizes;
  std::vector<bool> seen(s.number_of_triangles());
  for (Index seed = 0; seed < seen.size(); ++seed) {
    std::vector<Index> part;
    if (!seen[seed])
      part.push_back(seed);
    seen[seed] = true;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (Index h = 3 * part[i]; h < 3 * part[i] + 3; ++h)
        if (const Index o = s.opposite[h]; o != no_index && !seen[o / 3]) {
          seen[o / 3] = true;
          part.push_back(o / 3);
        }
    if (!part.empty())
      sizes.push_back(part.size());
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

/// The soup with some faces twice: turned around or not.
Soup doubled(const Soup& soup, bool is_turned, std::size_t every = 1)
{
  Soup result = soup;
  for (std::size_t f = 0; f < soup.polygons.size(); f += every) {
    auto face = soup.polygons[f];
    if (is_turned)
      std::reverse(face.begin(), face.end());
    result.polygons.push_back(face);
  }
  return result;
}

TEST(BuildSurface, TwoSidedModelsHaveASheetForEachSide)
{
  std::mt19937 random(3);
  for (const bool is_turned : {true, false})
    for (const Soup& soup : {sphere(2), cube(), planar_grid(5, 4)}) {
      const std::size_t n = surface_of(soup).number_of_triangles();
      const Index open = border_halfedges(surface_of(soup));
      Soup two = doubled(soup, is_turned);
      for (int round = 0; round < 3; ++round) {
        EXPECT_EQ(part_sizes(surface_of(two)), (std::vector<std::size_t>{n, n}));
        EXPECT_EQ(border_halfedges(surface_of(two)), 2 * open);
        std::shuffle(two.polygons.begin(), two.polygons.end(), random);
      }
      for (auto& face : two.polygons) // vertices may be split, too
        for (Index& v : face) {
          two.points.push_back(two.points[v]);
          v = static_cast<Index>(two.points.size() - 1);
        }
      EXPECT_EQ(part_sizes(surface_of(two)), (std::vector<std::size_t>{n, n}));
    }
}

TEST(BuildSurface, SomeFacesThatAreThereTwiceDoNotTearTheOthers)
{
  const std::size_t n = sphere(2).polygons.size();
  for (const bool is_turned : {true, false}) {
    const Surface s = surface_of(doubled(sphere(2), is_turned, 10));
    EXPECT_EQ(part_sizes(s).back(), n);
    EXPECT_EQ(s.number_of_triangles(), n + (n + 9) / 10);
    for (Index h = 0; h < s.opposite.size(); ++h)
      if (const Index o = s.opposite[h]; o != no_index) {
        EXPECT_EQ(s.opposite[o], h);
        EXPECT_EQ(s.point(h), s.point(next_halfedge(o)));
      }
  }
}

TEST(BuildSurface, ListsFacesThatCannotTakePart)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Soup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}}, {{0, 1, 2}, {0, 1, 1}, {0, 1, 3}, {0, 1, 9}, {}}};
  const Surface s = surface_of(soup);
  ASSERT_EQ(s.rejected.size(), 4u);
  EXPECT_EQ(s.rejected[0].face, 1u);
  EXPECT_EQ(s.rejected[0].reason, Rejection::too_few_corners);
  EXPECT_EQ(s.rejected[1].reason, Rejection::not_finite);
  EXPECT_EQ(s.rejected[2].reason, Rejection::bad_index);
  EXPECT_EQ(s.rejected[3].reason, Rejection::too_few_corners);
  EXPECT_EQ(s.number_of_triangles(), 1u);
}

TEST(BuildSurface, ConcavePolygonIsTriangulatedInside)
{
  // An arrowhead whose fan from the first corner is invalid.
  Soup soup{{{-1, 0, 0}, {0, -2, 0}, {1, 0, 0}, {0, -1, 0}}, {{0, 1, 2, 3}}};
  const Surface s = surface_of(soup);
  ASSERT_EQ(s.number_of_triangles(), 2u);
  for (const auto& t : s.triangles)
    EXPECT_GT(CGAL::cross_product(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]).z(), 0);
}

TEST(BuildSurface, PolygonWithoutAValidFanIsAFanFromItsFirstCorner)
{
  Soup soup;
  soup.polygons.emplace_back();
  for (Index i = 0; i < 40; ++i) {
    const double r = i % 2 ? 0.4 : 1, a = 2 * M_PI * i / 40;
    soup.points.emplace_back(r * std::cos(a), r * std::sin(a), 0);
    soup.polygons[0].push_back(i);
  }
  const Surface s = surface_of(soup);
  ASSERT_EQ(s.number_of_triangles(), 38u);
  for (Index t = 0; t < 38; ++t)
    EXPECT_EQ(s.triangles[t], (std::array<Index, 3>{0, t + 1, t + 2}));
}

TEST(ExtractCharts, CutsOpenAndTopology)
{
  const Surface s = surface_of(torus(6, 6));
  Segmentation one = one_chart(s);
  Chart_topology t = topology(extract_charts(s, one)[0]);
  EXPECT_EQ(t.euler, 0);
  EXPECT_EQ(t.border_loops, 0u);
  EXPECT_FALSE(t.is_disc());
  // Cut along one meridian and one parallel: vertices of column 0 or row 0.
  for (Index h = 0; h < s.opposite.size(); ++h) {
    const Index a = s.triangles[h / 3][h % 3], b = s.triangles[h / 3][(h % 3 + 1) % 3];
    one.cut[h] = (a % 6 == 0 && b % 6 == 0) || (a / 6 == 0 && b / 6 == 0);
  }
  const Chart chart = extract_charts(s, one)[0];
  EXPECT_TRUE(topology(chart).is_disc());
  EXPECT_EQ(chart.number_of_vertices(), 49u);
}

TEST(ExtractCharts, SheetsThatTouchInAVertexComeApart)
{
  Soup bowtie{{{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  EXPECT_EQ(chart_of(bowtie).number_of_vertices(), 6u);
  EXPECT_EQ(topology(chart_of(bowtie)).components, 2u);
}

TEST(ChartStatus, EveryStatusHasAMessageOfItsOwn)
{
  std::set<std::string> messages;
  for (int i = 0; i <= static_cast<int>(Chart_status::cancelled); ++i)
    messages.insert(message(static_cast<Chart_status>(i)));
  EXPECT_EQ(messages.size(), 8u);
}

TEST(BuildSurface, TakesPolygonsAsCGALHasThem)
{
  const Soup soup = cube();
  std::vector<std::vector<std::size_t>> polygons;
  for (const auto& polygon : soup.polygons)
    polygons.emplace_back(polygon.begin(), polygon.end());
  const Surface wanted = surface_of(soup), s = build_surface(soup.points, polygons);
  EXPECT_EQ(s.points, wanted.points);
  EXPECT_EQ(s.triangles, wanted.triangles);
  EXPECT_EQ(s.opposite, wanted.opposite);
  EXPECT_EQ(s.corner, wanted.corner);
  EXPECT_EQ(s.number_of_faces, 6u);
  EXPECT_EQ(s.number_of_corners, 24u);
}

TEST(BuildSurface, FacesOfVerticesBeyondAllNumbersAreRejected)
{
  const std::size_t beyond = std::size_t(1) << 32; // 0 if it were cut to 32 bits
  const Surface s = build_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {beyond, 1, 2}, {}});
  EXPECT_EQ(s.number_of_triangles(), 1u);
  ASSERT_EQ(s.rejected.size(), 2u);
  EXPECT_EQ(s.rejected[0].reason, Rejection::bad_index);
  EXPECT_EQ(s.rejected[1].reason, Rejection::too_few_corners);
}

TEST(Execution, RunsEveryIterationOnceAndStopsWhenCancelled)
{
  for (unsigned threads : {1u, 2u}) {
    std::vector<std::atomic<int>> count(1000);
    Execution execution(threads);
    execution.for_each(count.size(), [&](std::size_t i) { ++count[i]; });
    for (const auto& c : count)
      EXPECT_EQ(c, 1);
    int calls = 0;
    Execution stopping(threads, [&](double) { return ++calls < 3; });
    std::atomic<int> done = 0;
    stopping.for_each(1000, [&](std::size_t) {
      ++done;
      (void)stopping.proceed(0.5);
    });
    EXPECT_LT(done, 1000);
    EXPECT_EQ(calls, 3);
    EXPECT_FALSE(stopping.proceed(1));
  }
}

/// What pairing says, by looking at all pairs of halfedges.
std::vector<Index> opposites_by_search(const std::vector<std::array<Index, 3>>& triangles)
{
  const Index n = static_cast<Index>(3 * triangles.size());
  const auto tail = [&](Index h) { return triangles[h / 3][h % 3]; };
  const auto head = [&](Index h) { return tail(next_halfedge(h)); };
  std::vector<Index> opposite(n, no_index);
  for (Index h = 0; h < n; ++h) {
    std::vector<Index> others;
    for (Index g = 0; g < n; ++g)
      if (g != h && std::minmax(tail(g), head(g)) == std::minmax(tail(h), head(h)))
        others.push_back(g);
    if (others.size() == 1 && tail(h) != head(h) && tail(others[0]) == head(h))
      opposite[h] = others[0];
  }
  return opposite;
}

TEST(Pair_halfedges, finds_what_a_search_of_all_pairs_finds)
{
  // Random triangles: edges of one, two and more triangles, of any direction, and triangles that repeat a
  // vertex.
  std::mt19937 random(11);
  for (const Index vertices : {4u, 9u, 30u}) {
    std::vector<std::array<Index, 3>> triangles;
    for (int t = 0; t < 60; ++t)
      triangles.push_back(
          {Index(random() % vertices), Index(random() % vertices), Index(random() % vertices)});
    for (std::array<Index, 3>& t : triangles)
      for (Index& v : t)
        v += 1000; // numbers need not begin with 0
    EXPECT_EQ(internal::opposite_halfedges(triangles), opposites_by_search(triangles));
  }
  // A vertex of many edges, listed in an order that is not that of their other ends.
  std::vector<std::array<Index, 3>> fan;
  constexpr Index n = 101;
  for (Index k = 0; k < n; ++k)
    fan.push_back({0, 1 + 37 * k % n, 1 + 37 * (k + 1) % n});
  const std::vector<Index> opposite = internal::opposite_halfedges(fan);
  EXPECT_EQ(opposite, opposites_by_search(fan));
  EXPECT_EQ(std::count(opposite.begin(), opposite.end(), no_index), std::ptrdiff_t(n));
  EXPECT_TRUE(internal::opposite_halfedges({}).empty());
}

} // namespace
} // namespace Atlas::test
