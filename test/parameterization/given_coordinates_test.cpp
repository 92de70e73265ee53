// SPDX-License-Identifier: MIT
// What a surface, or coordinates that it has, say of seams: constrain_hard_edges(), constrain_to_uv(),
// Existing_uv_parameterizer.
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Existing_uv_parameterizer.h>

#include "test_meshes.h"
#include <limits>
#include <set>

namespace Atlas::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The edges with a constraint, by their smaller halfedges.
std::set<Index> constrained(const Surface& s, Edge_constraint constraint = Edge_constraint::seam)
{
  std::set<Index> result;
  for (Index h = 0; h < s.constraint.size(); ++h)
    if (s.constraint[h] == constraint) {
      if (s.opposite[h] != no_index) {
        EXPECT_EQ(s.constraint[s.opposite[h]], constraint); // the same on both sides
      }
      result.insert(std::min(h, s.opposite[h]));
    }
  return result;
}

std::set<Index> hard_edges(Surface s, double degrees)
{
  constrain_hard_edges(s, degrees);
  return constrained(s);
}

/// Two sheets that meet along x = 0; the normal turns there by so many degrees, up or down.
Soup bent_sheet(double degrees)
{
  const double a = degrees * M_PI / 180;
  return grid(2, 3, [a](double x, double y) {
    return x <= 0.5 ? Point_3(2 * x - 1, 3 * y, 0)
                    : Point_3((2 * x - 1) * std::cos(a), 3 * y, (2 * x - 1) * std::sin(a));
  });
}

TEST(ConstrainHardEdges, TheEdgesOfACubeAndNoDiagonal)
{
  const Surface s = surface_of(cube());
  const std::set<Index> hard = hard_edges(s, 89);
  EXPECT_EQ(hard.size(), 12u);
  for (const Index h : hard)
    EXPECT_FALSE(s.is_diagonal(h));
  EXPECT_TRUE(hard_edges(s, 91).empty());
}

TEST(ConstrainHardEdges, ABentQuadStaysWhole)
{
  const Surface s = surface_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 2}, {0, 1, 0}}, {{0, 1, 2, 3}}});
  ASSERT_EQ(s.number_of_triangles(), 2u);
  EXPECT_TRUE(hard_edges(s, 1).empty());
  const Surface torn = surface_of({s.points, {{0, 1, 2}, {0, 2, 3}}});
  EXPECT_EQ(hard_edges(torn, 1).size(), 1u); // the same as two triangles
}

TEST(ConstrainHardEdges, TheAngleIsThatBetweenNormalsUpOrDown)
{
  for (const double degrees : {1., 30., 89., 120., 179.})
    for (const double sign : {1., -1.}) {
      const Surface s = surface_of(bent_sheet(sign * degrees));
      EXPECT_EQ(hard_edges(s, degrees - 0.01).size(), 3u) << sign * degrees;
      for (const Index h : hard_edges(s, degrees - 0.01)) {
        EXPECT_EQ(s.point(h).x(), 0);
        EXPECT_EQ(s.point(next_halfedge(h)).x(), 0);
      }
      EXPECT_TRUE(hard_edges(s, degrees + 0.01).empty()) << sign * degrees;
    }
}

TEST(ConstrainHardEdges, AtAnyScale)
{
  const std::set<Index> hard = hard_edges(surface_of(bent_sheet(40)), 39);
  for (const double scale : {1e-300, 1e-160, 1e-3, 1e160, 1e300}) {
    Surface s = surface_of(bent_sheet(40));
    for (Point_3& p : s.points)
      p = Point_3(scale * p.x(), scale * p.y(), scale * p.z());
    EXPECT_EQ(hard_edges(s, 39), hard) << scale;
    EXPECT_TRUE(hard_edges(s, 41).empty()) << scale;
  }
}

TEST(ConstrainHardEdges, WhatIsForbiddenStaysForbiddenAndSeamsStaySeams)
{
  Surface s = surface_of(cube());
  s.constraint.assign(s.opposite.size(), Edge_constraint::none);
  const std::set<Index> hard = hard_edges(s, 89);
  const Index forbidden = *hard.begin(), diagonal = [&] {
    Index h = 0;
    while (!s.is_diagonal(h))
      ++h;
    return h;
  }();
  s.constraint[forbidden] = s.constraint[s.opposite[forbidden]] = Edge_constraint::no_seam;
  constrain_hard_edges(s, 89);
  EXPECT_EQ(constrained(s).size(), 11u);
  EXPECT_EQ(constrained(s, Edge_constraint::no_seam), std::set<Index>{forbidden});
  EXPECT_EQ(s.constraint[diagonal], Edge_constraint::none);
  const std::set<Index> before = constrained(s);
  constrain_hard_edges(s, 91); // adds nothing and takes nothing away
  EXPECT_EQ(constrained(s), before);
}

TEST(ConstrainHardEdges, TrianglesWithoutAreaHaveNoAngle)
{
  // Three walls around an edge of a fourth; then one of them loses its area.
  Surface s = surface_of({{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 1}, {2, 2, 1}, {0, 2, 1}},
                          {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 5}}});
  ASSERT_EQ(s.number_of_triangles(), 4u);
  EXPECT_EQ(hard_edges(s, 1).size(), 3u);
  for (Index h = 0; h < s.opposite.size(); ++h)
    if (s.point(h) == Point_3(1, -1, 1))
      s.points[s.triangles[h / 3][h % 3]] = Point_3(1, 0, 0);
  EXPECT_EQ(hard_edges(s, 1).size(), 2u);
}

TEST(ConstrainHardEdges, AnglesOutOfRangeAreRefused)
{
  Surface s = surface_of(cube());
  for (const double degrees : {0., -1., 180.5, nan})
    EXPECT_THROW(constrain_hard_edges(s, degrees), Invalid_argument) << degrees;
  constrain_hard_edges(s, 180);
  EXPECT_TRUE(constrained(s).empty());
}

/// Coordinates at corners from places on the surface and triangles.
std::vector<Point_2> coordinates(const Surface& s, const std::function<Point_2(const Point_3&, Index)>& f)
{
  std::vector<Point_2> uv(s.number_of_corners, Point_2(nan, nan));
  for (Index h = 0; h < s.opposite.size(); ++h)
    uv[s.corner[h]] = f(s.point(h), h / 3);
  return uv;
}

Point_3 centre(const Surface& s, Index t)
{
  return CGAL::centroid(s.point(3 * t), s.point(3 * t + 1), s.point(3 * t + 2));
}

TEST(ConstrainToUv, ChartsBecomePatchesWithSeamsBetweenThem)
{
  Surface s = surface_of(planar_grid(8, 4));
  s.constraint.assign(s.opposite.size(), Edge_constraint::no_seam); // earlier wishes are gone afterwards
  const auto is_right = [&](Index t) { return centre(s, t).x() > 0.5; };
  constrain_to_uv(s, coordinates(s, [&](const Point_3& p, Index t) {
                    return Point_2(p.x() + (is_right(t) ? 3 : 0), p.y());
                  }));
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    EXPECT_EQ(s.patch[t], Index(is_right(t)));
  EXPECT_EQ(constrained(s).size(), 4u);
  for (const Index h : constrained(s))
    EXPECT_EQ(s.point(h).x(), 0.5);
  EXPECT_TRUE(constrained(s, Edge_constraint::no_seam).empty());
}

TEST(ConstrainToUv, ACutInsideAChartIsASeamWithinAPatch)
{
  // A tube, unrolled: it is cut where the angle starts anew.
  Surface s = surface_of(grid(
      12, 5, [](double x, double y) { return Point_3(std::cos(2 * M_PI * x), std::sin(2 * M_PI * x), y); },
      true));
  constrain_to_uv(s, coordinates(s, [&](const Point_3& p, Index t) {
                    const Point_3 c = centre(s, t);
                    const double a = std::atan2(p.y(), p.x()), middle = std::atan2(c.y(), c.x());
                    return Point_2(std::round((a - middle > 3    ? a - 2 * M_PI
                                               : a - middle < -3 ? a + 2 * M_PI
                                                                 : a) *
                                              1e6),
                                   p.z());
                  }));
  EXPECT_EQ(std::set<Index>(s.patch.begin(), s.patch.end()), std::set<Index>{0});
  EXPECT_EQ(constrained(s).size(), 5u);
  for (const Index h : constrained(s))
    EXPECT_LT(s.point(h).x(), -0.999);
}

TEST(ConstrainToUv, AFoldSeparatesItsSides)
{
  Surface s = surface_of(planar_grid(8, 4));
  constrain_to_uv(s, coordinates(s, [](const Point_3& p, Index) {
                    return Point_2(p.x() < 0.75 ? p.x() : 1.5 - p.x(), p.y());
                  }));
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    EXPECT_EQ(s.patch[t], centre(s, t).x() < 0.75 ? 0u : 1u);
}

TEST(ConstrainToUv, FacesWithoutCoordinatesAreApart)
{
  Surface s = surface_of(planar_grid(8, 4));
  constrain_to_uv(s, coordinates(s, [&](const Point_3& p, Index t) {
                    return centre(s, t).y() < 0.5 ? Point_2(p.x(), p.y()) : Point_2(nan, nan);
                  }));
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    EXPECT_EQ(s.patch[t], centre(s, t).y() < 0.5 ? 0u : no_index);
}

/// Makes itself known in the coordinates.
struct Fallback
{
  Chart_status parameterize(Chart& chart, const Execution&) const
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(7, 7));
    return Chart_status::solver_failed;
  }
};
static_assert(ChartParameterizer<Existing_uv_parameterizer>);

/// One chart with the given coordinates, flattened; what it comes to.
std::pair<Chart_status, Chart> given(const std::function<Point_2(const Point_3&, Index)>& f)
{
  const Surface s = surface_of(planar_grid(3, 2));
  const std::vector<Point_2> uv = coordinates(s, f);
  Chart chart = extract_charts(s, one_chart(s)).at(0);
  const Chart_status status = Existing_uv_parameterizer(s, uv, Fallback()).parameterize(chart, Execution());
  return {status, chart};
}

TEST(Existing_uv_parameterizer, TakesCoordinatesAsTheyAre)
{
  const auto [status, chart] =
      given([](const Point_3& p, Index) { return Point_2(p.x() + p.y(), 3 * p.y()); });
  EXPECT_EQ(status, Chart_status::valid);
  for (Index v = 0; v < chart.number_of_vertices(); ++v) {
    const Point_3& p = chart.points[v];
    EXPECT_EQ(chart.uv[v], Point_2(p.x() + p.y(), 3 * p.y()));
  }
}

TEST(Existing_uv_parameterizer, TurnsOverWhatLiesFaceDown)
{
  const auto [status, chart] = given([](const Point_3& p, Index) { return Point_2(p.y(), p.x()); });
  EXPECT_EQ(status, Chart_status::valid);
  EXPECT_NEAR(area_uv(chart), 1, 1e-12);
  for (Index v = 0; v < chart.number_of_vertices(); ++v)
    EXPECT_EQ(chart.uv[v], Point_2(-chart.points[v].y(), chart.points[v].x()));
}

TEST(Existing_uv_parameterizer, LeavesChartsWithoutCoordinatesOrAreaToTheOther)
{
  const std::vector<std::function<Point_2(const Point_3&, Index)>> unusable{
      [](const Point_3&, Index) { return Point_2(nan, nan); },
      [](const Point_3& p, Index t) { return t == 5 ? Point_2(nan, 0) : Point_2(p.x(), p.y()); },
      [](const Point_3& p, Index t) { return t == 5 ? Point_2(0, INFINITY) : Point_2(p.x(), p.y()); },
      [](const Point_3& p, Index) { return Point_2(p.x(), p.x()); }};
  for (const auto& f : unusable) {
    const auto [status, chart] = given(f);
    EXPECT_EQ(status, Chart_status::solver_failed);
    EXPECT_EQ(chart.uv, std::vector<Point_2>(chart.number_of_vertices(), Point_2(7, 7)));
  }
}

TEST(Existing_uv_parameterizer, FindsTheCornersOfOneChartOfMany)
{
  // The second chart: triangles and corners have other numbers than in the surface.
  const Surface s = surface_of(planar_grid(4, 3));
  Segmentation g = one_chart(s);
  g.number_of_charts = 2;
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    g.chart[t] = centre(s, t).x() > 0.5;
  const std::vector<Point_2> uv = coordinates(s, [&](const Point_3& p, Index t) {
    return g.chart[t] == 1 ? Point_2(p.x(), p.y()) : Point_2(nan, nan);
  });
  std::vector<Chart> charts = extract_charts(s, g);
  const Existing_uv_parameterizer parameterizer(s, uv, Fallback());
  EXPECT_EQ(parameterizer.parameterize(charts[0], Execution()), Chart_status::solver_failed);
  EXPECT_EQ(parameterizer.parameterize(charts[1], Execution()), Chart_status::valid);
  for (Index v = 0; v < charts[1].number_of_vertices(); ++v)
    EXPECT_EQ(charts[1].uv[v], Point_2(charts[1].points[v].x(), charts[1].points[v].y()));
}

TEST(Existing_uv_parameterizer, ChecksThatCoordinatesAndChartsBelongToTheSurface)
{
  const Surface s = surface_of(planar_grid(3, 2));
  std::vector<Point_2> uv = coordinates(s, [](const Point_3& p, Index) { return Point_2(p.x(), p.y()); });
  Chart chart = extract_charts(s, one_chart(s)).at(0);
  const Existing_uv_parameterizer parameterizer(s, uv, Fallback());
  chart.source.back() = static_cast<Index>(s.number_of_triangles());
  EXPECT_THROW((void)parameterizer.parameterize(chart, Execution()), Invalid_argument);
  chart.source.pop_back();
  EXPECT_THROW((void)parameterizer.parameterize(chart, Execution()), Invalid_argument);
  uv.pop_back();
  EXPECT_THROW((void)Existing_uv_parameterizer(s, uv), Invalid_argument);
}

} // namespace
} // namespace Atlas::test
