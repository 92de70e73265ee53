// SPDX-License-Identifier: MIT
// Regular grids of quadrilaterals become rectangles, where that keeps the bound.
#include <Atlas/core/build_surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>

#include "test_meshes.h"
#include <cmath>
#include <numbers>

namespace Atlas::test {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Like `grid()`, of quadrilaterals that may be turned: the first corner is any of the four.
Soup quads(Index m, Index n, const std::function<Point_3(double, double)>& f, bool is_closed = false)
{
  Soup soup = grid(m, n, f, is_closed, false, true);
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    auto& polygon = soup.polygons[i];
    std::rotate(polygon.begin(), polygon.begin() + static_cast<long>(i * i % 4), polygon.end());
  }
  return soup;
}

/// A tube that narrows a little, `m` faces around.
Soup tube(Index m, Index n)
{
  return quads(
      m, n,
      [](double x, double y) {
        const double r = 1 - 0.05 * y;
        return Point_3(r * std::cos(turn * x), r * std::sin(turn * x), 5 * y);
      },
      true);
}

/// A flat road around a bend.
Soup road()
{
  return quads(40, 4, [](double x, double y) {
    const double r = 10 + y;
    return Point_3(r * std::cos(x * 2.5), -r * std::sin(x * 2.5), 0);
  });
}

/// A thin tube around a helix.
Soup rope()
{
  return quads(
      8, 120,
      [](double x, double y) {
        const double a = 3 * turn * y, r = 3 + 0.15 * std::cos(turn * x);
        return Point_3(r * std::cos(a), r * std::sin(a), 2 * y + 0.15 * std::sin(turn * x));
      },
      true);
}

Atlas_report straightened(const Surface& surface, std::vector<Point_2>& uv)
{
  const Atlas_report report =
      generate_atlas(surface, uv, parameters::straighten(true).texture_size(512).seam_exchange_rate(0));
  EXPECT_TRUE(report.is_valid());
  return report;
}

/// How many faces are rectangles parallel to each other in the plane.
std::size_t rectangles(const Surface& surface, const std::vector<Point_2>& uv)
{
  constexpr double tolerance = 1e-4; // coordinates are rounded
  std::size_t count = 0;
  Vector_2 axis = uv[1] - uv[0];
  axis = axis / std::sqrt(axis.squared_length());
  for (std::size_t c = 0; c + 3 < uv.size(); c += 4) {
    bool is_straight = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector_2 side = uv[c + (i + 1) % 4] - uv[c + i];
      const double along = side * axis, across = side.x() * axis.y() - side.y() * axis.x();
      is_straight = is_straight && std::min(std::abs(along), std::abs(across)) <=
                                       tolerance * std::sqrt(side.squared_length()) + 1e-6;
    }
    count += is_straight;
  }
  EXPECT_EQ(uv.size(), 4 * surface.number_of_faces);
  return count;
}

TEST(Straighten, TubesRoadsAndRopesBecomeRectangles)
{
  for (const Soup& soup : {tube(12, 20), road(), rope()}) {
    const Surface surface = surface_of(soup);
    std::vector<Point_2> uv;
    const Atlas_report report = straightened(surface, uv);
    ASSERT_EQ(report.charts.size(), 1u);
    EXPECT_TRUE(report.charts[0].is_within_bound);
    EXPECT_EQ(rectangles(surface, uv), surface.number_of_faces);
    std::vector<Point_2> usual;
    ASSERT_TRUE(generate_atlas(surface, usual).is_valid());
    EXPECT_LT(rectangles(surface, usual), surface.number_of_faces) << "or there is nothing to straighten";
  }
}

TEST(Straighten, ATubeIsOpenedAlongOneLineOfEdges)
{
  const Surface surface = surface_of(tube(12, 20));
  std::vector<Point_2> uv;
  EXPECT_NEAR(straightened(surface, uv).seam_length, 5, 0.01);
}

TEST(Straighten, ColumnsAreAsWideAsTheirEdgesAreLongOnAverage)
{
  // Two trapezes side by side: edges across are 1, 2 and 3 long, edges along 1.25 on the outside.
  const Soup soup{{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
                  {{0, 1, 4, 3}, {1, 2, 5, 4}}};
  const Surface surface = surface_of(soup);
  Chart chart = chart_of(soup);
  const Straight_parameterizer straight(surface.face, Bijective_parameterizer(), Distortion_bound());
  ASSERT_EQ(straight.parameterize(chart, Execution()), Chart_status::valid);
  const auto length = [&](Index i, Index j) {
    Index a = 0, b = 0;
    for (Index v = 0; v < chart.number_of_vertices(); ++v) {
      a = chart.points[v] == soup.points[i] ? v : a;
      b = chart.points[v] == soup.points[j] ? v : b;
    }
    return std::sqrt(CGAL::squared_distance(chart.uv[a], chart.uv[b]));
  };
  EXPECT_DOUBLE_EQ(length(0, 1), 1);
  EXPECT_DOUBLE_EQ(length(1, 2), 1.5);
  EXPECT_DOUBLE_EQ(length(4, 5), 1.5);
  EXPECT_DOUBLE_EQ(length(1, 4), (2 + std::sqrt(2.)) / 3);

  // Not so under a bound that this exceeds: the chart is flat, and stays so.
  const Straight_parameterizer bounded(surface.face, Bijective_parameterizer(),
                                       {Distortion_measure::symmetric_dirichlet, 1.001});
  ASSERT_EQ(bounded.parameterize(chart, Execution()), Chart_status::valid);
  EXPECT_NEAR(length(1, 2), 2, 1e-6);
  EXPECT_NEAR(length(4, 5), 1, 1e-6);
}

TEST(Straighten, GridsWithHolesAndTrianglesAreLeftAlone)
{
  Soup with_hole = road(), triangulated = tube(12, 20), torn = tube(12, 20);
  with_hole.polygons.erase(with_hole.polygons.begin() + 50); // in the second row, not at its end
  triangulated.polygons.clear();
  for (const auto& p : tube(12, 20).polygons) {
    triangulated.polygons.push_back({p[0], p[1], p[2]});
    triangulated.polygons.push_back({p[0], p[2], p[3]});
  }
  torn.polygons.erase(torn.polygons.begin() + 100);
  for (const Soup& soup : {with_hole, triangulated, torn}) {
    const Surface surface = surface_of(soup);
    std::vector<Point_2> uv, usual;
    const Atlas_report report = straightened(surface, uv);
    const auto np = parameters::texture_size(512).seam_exchange_rate(0);
    EXPECT_TRUE(generate_atlas(surface, usual, np).is_valid());
    EXPECT_EQ(uv, usual);
  }
}

TEST(Straighten, WhatTheBoundForbidsIsNotStraight)
{
  // A cone that narrows to a tenth: as a rectangle, its tip would be stretched to ten times its width.
  const Soup cone = quads(
      12, 20,
      [](double x, double y) {
        const double r = 1 - 0.9 * y;
        return Point_3(r * std::cos(turn * x), r * std::sin(turn * x), 2 * y);
      },
      true);
  const Surface surface = surface_of(cone);
  std::vector<Point_2> uv;
  const Atlas_report report = straightened(surface, uv);
  EXPECT_EQ(report.charts_beyond_bound, 0u);
  EXPECT_LT(rectangles(surface, uv), surface.number_of_faces);
}

TEST(Straighten, OnlyTheGridOfALargerSurfaceIsStraight)
{
  // A tube with fans of triangles at both ends.
  Soup soup = tube(12, 20);
  for (const Index row : {0, 20}) {
    const auto tip = static_cast<Index>(soup.points.size());
    soup.points.emplace_back(0, 0, row == 0 ? -1 : 6);
    for (Index i = 0; i < 12; ++i) {
      // The points of a row follow each other.
      const Index a = row * 12 + i, b = row * 12 + (i + 1) % 12;
      soup.polygons.push_back(row == 0 ? std::vector<Index>{b, a, tip} : std::vector<Index>{a, b, tip});
    }
  }
  const Surface surface = surface_of(soup);
  std::vector<Point_2> uv;
  const Atlas_report report = straightened(surface, uv);
  EXPECT_EQ(report.charts.size(), 3u);
  for (Index f = 1; f < 240; ++f)
    EXPECT_EQ(report.face_chart[f], report.face_chart[0]);
  EXPECT_NE(report.face_chart[240], report.face_chart[0]);
}

} // namespace
} // namespace Atlas::test
