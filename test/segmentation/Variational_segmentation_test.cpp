// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/segmentation/Normal_segmentation.h>
#include <Atlas/segmentation/Region_growing_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>

#include "test_meshes.h"

namespace Atlas::test {
namespace {

static_assert(ChartSegmentation<Variational_segmentation>);
static_assert(ChartSegmentation<Normal_segmentation>);
static_assert(ChartSegmentation<Region_growing_segmentation>);

/// A unit cube of n^2 quads a side, bent by nothing.
Soup fine_cube(Index n, bool quads)
{
  Soup soup;
  const auto side = [&](const std::function<Point_3(double, double)>& f) {
    const Soup g = grid(n, n, f, false, false, quads);
    for (auto polygon : g.polygons) {
      for (Index& v : polygon)
        v += static_cast<Index>(soup.points.size());
      soup.polygons.push_back(polygon);
    }
    soup.points.insert(soup.points.end(), g.points.begin(), g.points.end());
  };
  side([](double x, double y) { return Point_3(x, y, 1); });
  side([](double x, double y) { return Point_3(y, x, 0); });
  side([](double x, double y) { return Point_3(1, x, y); });
  side([](double x, double y) { return Point_3(0, y, x); });
  side([](double x, double y) { return Point_3(y, 1, x); });
  side([](double x, double y) { return Point_3(x, 0, y); });
  return soup;
}

template <typename S>
class PlanarGrouping : public testing::Test
{
public:
  static Segmentation segment(const Surface& s, unsigned threads = 1)
  {
    return S().segment(s, Execution(threads));
  }
};
using Models = testing::Types<Variational_segmentation, Normal_segmentation, Region_growing_segmentation>;
TYPED_TEST_SUITE(PlanarGrouping, Models);

/// Every chart has a triangle and is connected over edges that may be crossed.
void expect_sound(const Surface& s, const Segmentation& g)
{
  ASSERT_EQ(g.chart.size(), s.number_of_triangles());
  ASSERT_EQ(g.cut.size(), 3 * s.number_of_triangles());
  for (const Chart& chart : extract_charts(s, g))
    EXPECT_EQ(topology(chart).components, 1u);
  for (Index h = 0; h < s.opposite.size(); ++h)
    if (s.is_diagonal(h)) {
      EXPECT_TRUE(g.is_glued(s, h));
    }
}

TYPED_TEST(PlanarGrouping, TheSidesOfACubeAreTheCharts)
{
  for (bool quads : {false, true}) {
    const Surface s = surface_of(fine_cube(12, quads));
    ASSERT_EQ(std::count(s.opposite.begin(), s.opposite.end(), no_index), 0);
    const Segmentation g = TestFixture::segment(s);
    expect_sound(s, g);
    EXPECT_EQ(g.number_of_charts, 6u);
    // Growing by pairs may take single triangles across an edge of the cube; the others must not.
    std::map<std::pair<Index, Index>, int> triangles; // of side and chart
    for (Index t = 0; t < g.chart.size(); ++t)
      ++triangles[{t / (2 * 144), g.chart[t]}];
    if (std::is_same_v<TypeParam, Region_growing_segmentation>) {
      std::erase_if(triangles, [](const auto& entry) { return entry.second <= 4; });
    }
    EXPECT_EQ(triangles.size(), 6u);
  }
}

TYPED_TEST(PlanarGrouping, IsTheSameAtAnyScaleAndForAnyNumberOfThreads)
{
  Soup soup = torus(40, 24);
  const Segmentation one = TestFixture::segment(surface_of(soup));
  expect_sound(surface_of(soup), one);
  EXPECT_GT(one.number_of_charts, 4u);
  EXPECT_LT(one.number_of_charts, 200u);
  EXPECT_EQ(one.chart, TestFixture::segment(surface_of(soup), 2).chart);
  for (const double scale : {std::ldexp(1, -20), std::ldexp(1, 20)}) {
    Soup scaled = soup;
    for (Point_3& p : scaled.points)
      p = CGAL::ORIGIN + scale * (p - CGAL::ORIGIN);
    EXPECT_EQ(TestFixture::segment(surface_of(scaled)).chart, one.chart);
  }
}

TYPED_TEST(PlanarGrouping, RespectsPatchesSeamsAndEdgesThatMustNotBeCut)
{
  Surface s = surface_of(planar_grid(10, 10));
  EXPECT_EQ(TestFixture::segment(s).number_of_charts, 1u);
  s.patch.assign(s.number_of_triangles(), 0);
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    s.patch[t] = s.points[s.triangles[t][0]].x() < 0.45 && s.points[s.triangles[t][1]].x() < 0.55;
  const Segmentation g = TestFixture::segment(s);
  EXPECT_EQ(g.number_of_charts, 2u);
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    EXPECT_EQ(g.chart[t] == g.chart[0], s.patch[t] == s.patch[0]);

  s.patch.clear();
  s.constraint.assign(3 * s.number_of_triangles(), Edge_constraint::none);
  const auto on_line = [&](Index h) { return s.point(h).x() == 0.5 && s.point(next_halfedge(h)).x() == 0.5; };
  for (Index h = 0; h < s.constraint.size(); ++h)
    if (on_line(h))
      s.constraint[h] = Edge_constraint::seam;
  EXPECT_EQ(TestFixture::segment(s).number_of_charts, 2u);
  for (Index h = 0; h < s.constraint.size(); ++h)
    if (on_line(h) && s.point(h).y() < 0.25 && s.point(next_halfedge(h)).y() < 0.25)
      s.constraint[h] = Edge_constraint::none;
  const Segmentation slit = TestFixture::segment(s);
  for (Index h = 0; h < s.constraint.size(); ++h)
    if (s.constraint[h] == Edge_constraint::seam) {
      EXPECT_FALSE(slit.is_glued(s, h));
    }

  Surface roof = surface_of(fine_cube(8, false));
  roof.constraint.assign(3 * roof.number_of_triangles(), Edge_constraint::none);
  for (Index h = 0; h < roof.constraint.size(); ++h)
    if (roof.point(h).z() == 1 && roof.point(next_halfedge(h)).z() == 1)
      roof.constraint[h] = Edge_constraint::no_seam;
  const Segmentation joined = TestFixture::segment(roof);
  for (Index h = 0; h < roof.constraint.size(); ++h)
    if (roof.constraint[h] == Edge_constraint::no_seam) {
      EXPECT_TRUE(joined.is_glued(roof, h));
    }
}

TYPED_TEST(PlanarGrouping, TakesAnySurface)
{
  EXPECT_EQ(TestFixture::segment(Surface{}).number_of_charts, 0u);
  // All corners at one point, and huge coordinates.
  Soup point{std::vector<Point_3>(4, Point_3(1, 1, 1)), {{0, 1, 2}, {2, 1, 3}}};
  const Surface degenerate = surface_of(point);
  expect_sound(degenerate, TestFixture::segment(degenerate));
  Soup huge = sphere(3);
  for (Point_3& p : huge.points)
    p = CGAL::ORIGIN + 1e200 * (p - CGAL::ORIGIN);
  const Surface s = surface_of(huge);
  expect_sound(s, TestFixture::segment(s));
  Execution cancelled;
  cancelled.cancel();
  const Surface t = surface_of(torus(40, 24));
  expect_sound(t, TypeParam().segment(t, cancelled));
}

TEST(VariationalSegmentation, GivesTheNumberOfChartsAskedFor)
{
  const Surface s = surface_of(sphere(5));
  for (Index k : {1u, 7u, 64u}) {
    Variational_segmentation::Options options;
    options.number_of_charts = k;
    EXPECT_EQ(Variational_segmentation(options).segment(s, Execution()).number_of_charts, k);
  }
}

TEST(VariationalSegmentation, ChoosesTheNumberByShapeAndNotByResolution)
{
  const Index coarse =
      Variational_segmentation().segment(surface_of(sphere(4)), Execution()).number_of_charts;
  const Index fine = Variational_segmentation().segment(surface_of(sphere(6)), Execution()).number_of_charts;
  EXPECT_GE(coarse, 6u);
  EXPECT_LE(coarse, 40u);
  EXPECT_LE(std::max(coarse, fine), 1.5 * std::min(coarse, fine));
}

/// The energy of Cohen-Steiner et al., from the definition: the integral of |n - N|^2.
double energy(const Surface& s, const Segmentation& g)
{
  std::vector<Vector_3> sum(g.number_of_charts, Vector_3(0, 0, 0));
  const auto vector = [&](Index t) {
    return CGAL::cross_product(s.point(3 * t + 1) - s.point(3 * t), s.point(3 * t + 2) - s.point(3 * t)) / 2;
  };
  for (Index t = 0; t < g.chart.size(); ++t)
    sum[g.chart[t]] = sum[g.chart[t]] + vector(t);
  double total = 0;
  for (Index t = 0; t < g.chart.size(); ++t) {
    const Vector_3 v = vector(t), n = v / std::sqrt(v.squared_length());
    const Vector_3 plane = sum[g.chart[t]] / std::sqrt(sum[g.chart[t]].squared_length());
    total += std::sqrt(v.squared_length()) * (n - plane).squared_length();
  }
  return total;
}

TEST(VariationalSegmentation, PlanesFitNearlyAsWellAsCapsOfASphere)
{
  // k caps of half angle a with k (1 - cos a) = 2 cover the sphere's area; on each the integral of |n - N|^2
  // is 2 pi (1 - cos a)^2. No k clusters are better.
  const Surface s = surface_of(sphere(5));
  Variational_segmentation::Options options;
  options.number_of_charts = 30;
  options.compactness = 0;
  const double bound = 30 * 2 * M_PI * std::pow(2.0 / 30, 2);
  const double found = energy(s, Variational_segmentation(options).segment(s, Execution()));
  EXPECT_GT(found, 0.97 * bound);
  EXPECT_LT(found, 1.25 * bound);
}

} // namespace
} // namespace Atlas::test
