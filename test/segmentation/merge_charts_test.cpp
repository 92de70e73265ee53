// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Normal_segmentation.h>
#include <Atlas/segmentation/Region_growing_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/merging/layout_limits.h>
#include <Atlas/segmentation/internal/merging/layout_quality.h>

#include "test_meshes.h"

namespace Atlas::test {
namespace {

using Trial = Bijective_parameterizer;
static_assert(BoundedSegmentation<Merged_segmentation>);

Merge_options unlimited()
{
  Merge_options options;
  options.max_area_share = 1;
  options.min_solidity = 0;
  options.orders = 1;
  return options;
}

template <typename Base = Variational_segmentation>
Segmentation merged(const Surface& s, const Merge_options& options = {}, const Base& base = Base(),
                    unsigned threads = 1)
{
  return Merged_segmentation(base, Trial(), Identity_optimizer(), options).segment(s, Execution(threads));
}

void expect_discs(const Surface& s, const Segmentation& g)
{
  for (const Chart& chart : extract_charts(s, g))
    EXPECT_TRUE(topology(chart).is_disc());
}

double worst_distortion(const Surface& s, const Segmentation& g)
{
  double worst = 0;
  for (Chart& chart : extract_charts(s, g)) {
    EXPECT_EQ(Trial().parameterize(chart, Execution()), Chart_status::valid);
    worst = std::max(worst, measure_distortion(chart).symmetric_dirichlet_mean);
  }
  return worst;
}

/// Bumpy, closed, of genus 1.
Surface bumpy_torus()
{
  return surface_of(grid(
      48, 32,
      [](double x, double y) {
        const double u = 2 * M_PI * x, v = 2 * M_PI * y;
        const double tube = 0.4 + 0.06 * std::sin(3 * u) * std::cos(2 * v), r = 1 + tube * std::cos(v);
        return Point_3(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
      },
      true, true));
}

TEST(MergeCharts, AnOpenCubeUnfoldsToOneChart)
{
  // Five sides of a cube meet in chains of right angles: a cross, a flat chart without any distortion.
  Soup soup = cube();
  soup.polygons.pop_back();
  const Surface s = surface_of(soup);
  Segmentation g{std::vector<Index>(s.face.begin(), s.face.end()),
                 std::vector<std::uint8_t>(3 * s.number_of_triangles(), 0), 5};
  merge_charts(s, g, unlimited(), Trial(), Identity_optimizer());
  EXPECT_EQ(g.number_of_charts, 1u);
  expect_discs(s, g);
  EXPECT_NEAR(worst_distortion(s, g), 1, 1e-9);
  // Five squares, four hinges.
  EXPECT_NEAR(seam_length(s, g), 8 - 4, 1e-12);
}

TEST(MergeCharts, AConeIsZippedUpToItsApexAndNoFurther)
{
  // A flat disc in sectors: merged and zipped, it has no seam left. A sharp cone keeps one slit at least.
  for (const double height : {0.0, 2.0}) {
    const Index sectors = 8;
    Soup soup = grid(
        4 * sectors, 6,
        [&](double x, double y) {
          const double u = 2 * M_PI * x, r = 0.1 + 0.9 * (1 - y);
          return Point_3(r * std::cos(u), r * std::sin(u), height * (1 - r));
        },
        true);
    const Index ring = 4 * sectors, apex = static_cast<Index>(soup.points.size());
    soup.points.emplace_back(0, 0, height);
    for (Index i = 0; i < ring; ++i)
      soup.polygons.push_back({6 * ring + i, 6 * ring + (i + 1) % ring, apex});
    const Surface s = surface_of(soup);
    Segmentation g = one_chart(s);
    g.number_of_charts = sectors;
    for (Index t = 0; t < s.number_of_triangles(); ++t) {
      const Point_3 c = CGAL::centroid(s.point(3 * t), s.point(3 * t + 1), s.point(3 * t + 2));
      const double turn = std::atan2(c.y(), c.x()) / (2 * M_PI) + 1;
      g.chart[t] = static_cast<Index>(std::floor(turn * sectors)) % sectors;
    }
    Merge_options options = unlimited();
    options.min_gap = 0;
    merge_charts(s, g, options, Trial(), Identity_optimizer());
    EXPECT_EQ(g.number_of_charts, 1u);
    expect_discs(s, g);
    const double slant = std::hypot(1, height);
    if (height == 0) {
      EXPECT_EQ(seam_length(s, g), 0);
    } else {
      EXPECT_NEAR(seam_length(s, g), slant, 0.01 * slant);
    }
  }
}

TEST(MergeCharts, KeepsTheBoundAtFullResolutionAndUsesIt)
{
  const Surface s = bumpy_torus();
  Segmentation before = Variational_segmentation().segment(s, Execution());
  const double first_seam = seam_length(s, before);
  double last_seam = first_seam;
  for (const double bound : {1.005, 1.03, 1.1}) {
    Merge_options options = unlimited();
    options.max_distortion = bound;
    const Segmentation g = merged(s, options);
    expect_discs(s, g);
    EXPECT_LT(worst_distortion(s, g), bound + 0.015); // the coarse surface smooths bumps
    EXPECT_LE(seam_length(s, g), last_seam);
    last_seam = seam_length(s, g);
  }
  EXPECT_LT(last_seam, 0.5 * first_seam);
}

TEST(MergeCharts, EveryMeasureBounds)
{
  const Surface s = bumpy_torus();
  const Index many = [&] {
    Segmentation g = Variational_segmentation().segment(s, Execution());
    cut_to_discs(s, g);
    return g.number_of_charts;
  }();
  for (int m = 0; m <= static_cast<int>(Distortion_measure::quasi_conformal); ++m) {
    Merge_options options = unlimited();
    options.measure = static_cast<Distortion_measure>(m);
    options.max_distortion = 1; // only what is flat on the coarse surface merges, if anything is
    EXPECT_GT(merged(s, options).number_of_charts, 3 * many / 4);
    options.max_distortion = 2;
    EXPECT_LT(merged(s, options).number_of_charts, many / 2);
  }
}

TEST(MergeCharts, LimitsTheShareOfAChart)
{
  const Surface s = bumpy_torus();
  Merge_options options;
  options.orders = 1;
  options.solidity_of_large_charts = 1; // never reached
  options.max_distortion = 2;
  for (const double share : {0.12, 0.3}) {
    options.max_area_share = share;
    const Segmentation g = merged(s, options);
    double largest = 0;
    for (const Chart& chart : extract_charts(s, g))
      largest = std::max(largest, area_3d(chart) / area_3d(s));
    EXPECT_LT(largest, 1.1 * share); // areas are those of the coarse surface
    EXPECT_GT(largest, 0.5 * share);
  }
}

TEST(MergeCharts, TheSameForAnyNumberOfThreadsAndAtAnyScale)
{
  const Surface s = bumpy_torus();
  const Segmentation one = merged(s), four = merged(s, {}, Variational_segmentation(), 4);
  EXPECT_EQ(one.chart, four.chart);
  EXPECT_EQ(one.cut, four.cut);
  Surface scaled = s;
  for (Point_3& p : scaled.points)
    p = CGAL::ORIGIN + std::ldexp(1, -30) * (p - CGAL::ORIGIN);
  EXPECT_EQ(merged(scaled).chart, one.chart);
}

TEST(MergeCharts, WorksAfterEveryBase)
{
  const Surface s = bumpy_torus();
  const Segmentation normal = merged<Normal_segmentation>(s), grown = merged<Region_growing_segmentation>(s);
  expect_discs(s, normal);
  expect_discs(s, grown);
  EXPECT_LT(seam_length(s, normal), seam_length(s, Normal_segmentation().segment(s, Execution())));
  EXPECT_LT(seam_length(s, grown), seam_length(s, Region_growing_segmentation().segment(s, Execution())));
}

TEST(MergeCharts, KeepsPatchesAndSeams)
{
  Surface s = surface_of(planar_grid(12, 12));
  s.constraint.assign(3 * s.number_of_triangles(), Edge_constraint::none);
  for (Index h = 0; h < s.constraint.size(); ++h)
    if (s.point(h).x() == 0.5 && s.point(next_halfedge(h)).x() == 0.5)
      s.constraint[h] = Edge_constraint::seam;
  EXPECT_EQ(merged(s).number_of_charts, 2u);
  s.constraint.clear();
  s.patch.assign(s.number_of_triangles(), 0);
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    s.patch[t] = t % 24 < 12;
  EXPECT_EQ(merged(s).number_of_charts, 2u);
}

TEST(MergeCharts, TakesAnySurface)
{
  EXPECT_EQ(merged(Surface{}).number_of_charts, 0u);
  Soup point{std::vector<Point_3>(4, Point_3(1, 1, 1)), {{0, 1, 2}, {2, 1, 3}}};
  expect_discs(surface_of(point), merged(surface_of(point)));
  Soup fan; // one vertex of a high degree, closed
  for (int i = 0; i < 500; ++i)
    fan.points.emplace_back(std::cos(2 * M_PI * i / 500), std::sin(2 * M_PI * i / 500), 0);
  fan.points.emplace_back(0, 0, 1);
  fan.points.emplace_back(0, 0, -1);
  for (Index i = 0; i < 500; ++i)
    fan.polygons.insert(fan.polygons.end(), {{i, (i + 1) % 500, 500}, {(i + 1) % 500, i, 501}});
  expect_discs(surface_of(fan), merged(surface_of(fan)));
  Execution cancelled;
  cancelled.cancel();
  EXPECT_NO_THROW(Merged_segmentation(Variational_segmentation(), Trial(), Identity_optimizer())
                      .segment(bumpy_torus(), cancelled));
}

TEST(CoarseSurface, HasTheSameChartsAndArcsAndAlmostTheSameArea)
{
  const Surface s = bumpy_torus();
  Segmentation g = Variational_segmentation().segment(s, Execution());
  cut_to_discs(s, g);
  const internal::Chart_arcs arcs = internal::chart_arcs(s, g);
  const internal::Coarse_surface c = internal::Surface_simplifier(s, g, arcs, 30).run();
  EXPECT_LT(c.triangles.size(), s.number_of_triangles() / 2);
  Surface coarse;
  coarse.points = c.points;
  coarse.triangles = c.triangles;
  coarse.opposite = c.opposite;
  EXPECT_NEAR(area_3d(coarse), area_3d(s), 0.05 * area_3d(s));
  for (Index h = 0; h < c.opposite.size(); ++h) {
    const Index o = c.opposite[h];
    ASSERT_EQ(c.opposite[o], h);
    EXPECT_EQ(coarse.point(h), coarse.point(next_halfedge(o)));
    EXPECT_EQ(c.side[h] == no_index, c.side[o] == no_index);
    if (c.side[h] != no_index) {
      EXPECT_EQ(c.side[h], c.side[o] ^ 1);
    }
  }
  Segmentation cg{c.chart, std::vector<std::uint8_t>(c.side.size(), 0), g.number_of_charts};
  for (Index h = 0; h < c.side.size(); ++h)
    cg.cut[h] = c.side[h] != no_index;
  const internal::Chart_arcs again = internal::chart_arcs(coarse, cg);
  EXPECT_EQ(again.number_of_arcs(), arcs.number_of_arcs());
  expect_discs(coarse, cg);
}

TEST(LayoutShape, HullCrossingsGapsAndMisfit)
{
  std::vector<Point_2> points{{0, 0}, {2, 0}, {2, 1}, {0, 1}, {1, 0.5}, {1, 0}};
  EXPECT_NEAR(internal::hull_area(points), 2, 1e-15);

  const auto loop = [](const std::vector<Point_2>& p) {
    std::vector<internal::Border_edge> edges;
    for (Index i = 0; i < p.size(); ++i) {
      const Index j = static_cast<Index>((i + 1) % p.size());
      edges.push_back({p[i], p[j], i, j});
    }
    return edges;
  };
  const std::vector<Point_2> square{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  EXPECT_TRUE(internal::is_clear(loop(square), 0.5));
  std::vector<Point_2> waist = square; // the edges at the middle of the sides come near each other
  waist[1] = {1, 0.95};
  waist[5] = {1, 1.05};
  EXPECT_TRUE(internal::is_clear(loop(waist), 0.05));
  EXPECT_FALSE(internal::is_clear(loop(waist), 0.1));
  std::swap(waist[1], waist[5]);
  EXPECT_FALSE(internal::is_clear(loop(waist), 0));

  std::vector<Point_2> turned;
  for (const Point_2& p : square)
    turned.emplace_back(3 - p.y(), p.x() - 7);
  EXPECT_NEAR(internal::chain_fit(square, turned).misfit, 0, 1e-7);
  // A straight chain against one bent by a right angle in its middle.
  const std::vector<Point_2> straight{{-1, 0}, {0, 0}, {1, 0}}, bent{{-1, 0}, {0, 0}, {0, 1}};
  const auto at = [&](double angle) { // by trying all rotations about the weighted means
    double sum = 0;
    const double w[] = {0.25, 0.5, 0.25};
    for (int i = 0; i < 3; ++i) {
      const double x = bent[i].x() + 0.25, y = bent[i].y() - 0.25;
      sum += w[i] * (std::pow(straight[i].x() - x * std::cos(angle) + y * std::sin(angle), 2) +
                     std::pow(-x * std::sin(angle) - y * std::cos(angle), 2));
    }
    return std::sqrt(sum);
  };
  double best = 10;
  for (int i = 0; i < 3600; ++i)
    best = std::min(best, at(2 * M_PI * i / 3600));
  EXPECT_NEAR(internal::chain_fit(straight, bent).misfit, best, 1e-4);
}

TEST(MergeCharts, LayoutsBesideEachOtherFillLessOfTheirHull)
{
  // Two rectangles of 2 x 1 that make a square, and that make an L of 4/5 of its hull.
  Chart a;
  a.uv = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  a.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Point_2> side{{0, 0}, {2, 0}}, lower{{0, 1}, {2, 1}}, half{{1, 1}, {2, 1}},
      end{{0, 1}, {0, 0}};
  EXPECT_NEAR(internal::solidity_side_by_side(a, a, internal::chain_fit(lower, side)), 1, 1e-9);
  // The short side of the second lies on the right half of the first.
  const internal::Chain_fit upright = internal::chain_fit(half, end);
  EXPECT_NEAR(upright.misfit, 0, 1e-9);
  EXPECT_NEAR(internal::solidity_side_by_side(a, a, upright), 4 / 5.0, 1e-9);
  Merge_options options;
  options.min_solidity = 0.5;
  options.solidity_of_large_charts = 0.9;
  EXPECT_EQ(internal::least_solidity(false, options), 0.5);
  EXPECT_EQ(internal::least_solidity(true, options), 0.9);
}

} // namespace
} // namespace Atlas::test
