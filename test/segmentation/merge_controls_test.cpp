// SPDX-License-Identifier: MIT
// What the user may ask of merged charts: where seams go, how many charts there are, how small they may be.
#include <Atlas/core/extract_charts.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Normal_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>
#include <Atlas/segmentation/smooth_borders.h>

#include "segmentation_checks.h"
#include "segmentation_shapes.h"

namespace Atlas::test {
namespace {

template <typename Base = Variational_segmentation>
Segmentation merged(const Surface& s, const Merge_options& options, const Base& base = Base())
{
  return Merged_segmentation(base, Bijective_parameterizer(), Identity_optimizer(), options)
      .segment(s, Execution());
}

Merge_options quick()
{
  Merge_options options;
  options.orders = 1;
  return options;
}

template <typename Predicate>
double length_of_seams(const Surface& s, const Segmentation& g, Predicate is_counted)
{
  double sum = 0;
  for (Index h = 0; h < s.opposite.size(); ++h)
    if (s.opposite[h] != no_index && !g.is_glued(s, h) && is_counted(h))
      sum += internal::edge_length(s, h) / 2;
  return sum;
}
double length_of_seams(const Surface& s, const Segmentation& g)
{
  return length_of_seams(s, g, [](Index) { return true; });
}

template <typename Predicate>
void constrain(Surface& s, Edge_constraint constraint, Predicate is_meant)
{
  s.constraint.resize(s.opposite.size(), Edge_constraint::none);
  for (Index h = 0; h < s.opposite.size(); ++h)
    if (is_meant(s.point(h), s.point(next_halfedge(h))))
      s.constraint[h] = constraint;
}

/// A cube with sides of n * n squares.
Surface fine_cube(Index n)
{
  return surface_of(noisy_cube(n, 0));
}

double extent(const Surface& s)
{
  double most = 0;
  for (const Point_3& p : s.points)
    most = std::max(most, p.z());
  return most;
}

TEST(MergeControls, AForbiddenRingOfEdgesIsNotCut)
{
  Surface s = fine_cube(12);
  const double top = extent(s);
  const auto is_on_ring = [&](const Point_3& p, const Point_3& q) { return p.z() == top && q.z() == top; };
  const auto count = [&](const Segmentation& g) {
    return length_of_seams(s, g, [&](Index h) { return is_on_ring(s.point(h), s.point(next_halfedge(h))); });
  };
  Merge_options options = quick();
  options.max_distortion = 1.001; // or there is no seam at the ring anyway
  EXPECT_GT(count(merged(s, options)), top);
  constrain(s, Edge_constraint::no_seam, is_on_ring); // the whole top, in fact
  for (const Segmentation& g : {merged(s, options), merged<Normal_segmentation>(s, options)}) {
    EXPECT_EQ(count(g), 0);
    expect_discs(s, g);
  }
}

TEST(MergeControls, APaintedRegionIsNotCut)
{
  Surface s = surface_of(sphere(4));
  const auto is_painted = [](const Point_3& p, const Point_3& q) { return p.x() > 0.6 && q.x() > 0.6; };
  const auto count = [&](const Segmentation& g) {
    return length_of_seams(s, g, [&](Index h) { return is_painted(s.point(h), s.point(next_halfedge(h))); });
  };
  Merge_options options = quick();
  options.max_distortion = 1.01;
  EXPECT_GT(count(merged(s, options)), 0);
  constrain(s, Edge_constraint::no_seam, is_painted);
  for (const Segmentation& g : {merged(s, options), merged<Normal_segmentation>(s, options)}) {
    EXPECT_EQ(count(g), 0);
    expect_discs(s, g);
  }
}

TEST(MergeControls, WishesYieldToTopology)
{
  Surface s = surface_of(sphere(3));
  constrain(s, Edge_constraint::no_seam, [](const Point_3&, const Point_3&) { return true; });
  const Segmentation g = merged(s, quick());
  expect_discs(s, g);
  EXPECT_EQ(g.number_of_charts, 1u);
}

TEST(MergeControls, SeamsKeepOffExpensivePlaces)
{
  Surface s = surface_of(sphere(4));
  const auto in_front = [&](Index h) { return s.point(h).x() + s.point(next_halfedge(h)).x() > 0; };
  const double usual = length_of_seams(s, merged(s, Merge_options()), in_front);
  s.seam_cost.assign(s.opposite.size(), 1);
  for (Index h = 0; h < s.seam_cost.size(); ++h)
    if (in_front(h))
      s.seam_cost[h] = 10;
  const Segmentation g = merged(s, Merge_options());
  expect_discs(s, g);
  EXPECT_LT(length_of_seams(s, g, in_front), 0.9 * usual);
}

TEST(MergeControls, ACostMovesABorder)
{
  // Two halves of a sheet; a seam is cheap at x = 0.55 and nowhere else.
  Surface s = surface_of(planar_grid(40, 20));
  Segmentation g = one_chart(s);
  g.number_of_charts = 2;
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    g.chart[t] = CGAL::centroid(s.point(3 * t), s.point(3 * t + 1), s.point(3 * t + 2)).x() > 0.5;
  s.seam_cost.assign(s.opposite.size(), 1);
  const auto is_cheap = [&](Index h) {
    return std::abs(s.point(h).x() - 0.55) < 1e-9 && std::abs(s.point(next_halfedge(h)).x() - 0.55) < 1e-9;
  };
  for (Index h = 0; h < s.seam_cost.size(); ++h)
    if (is_cheap(h))
      s.seam_cost[h] = 0.5;
  EXPECT_EQ(smooth_borders(s, g), 1u);
  EXPECT_NEAR(length_of_seams(s, g, is_cheap), length_of_seams(s, g), 1e-12);
}

TEST(MergeControls, ACostMovesACut)
{
  // A tube has to be cut open along its length; the cut goes where it is cheap.
  const Index around = 24, cheap = 7;
  Surface s = surface_of(grid(
      around, 12,
      [](double x, double y) { return Point_3(std::cos(2 * M_PI * x), std::sin(2 * M_PI * x), 3 * y); },
      true));
  const auto is_cheap_point = [&](const Point_3& p) {
    const double u = 2 * M_PI * cheap / around;
    return std::hypot(p.x() - std::cos(u), p.y() - std::sin(u)) < 1e-9;
  };
  const auto is_cheap = [&](Index h) {
    return is_cheap_point(s.point(h)) && is_cheap_point(s.point(next_halfedge(h)));
  };
  s.seam_cost.assign(s.opposite.size(), 1);
  for (Index h = 0; h < s.seam_cost.size(); ++h)
    if (is_cheap(h))
      s.seam_cost[h] = 0.5;
  Segmentation g = one_chart(s);
  cut_to_discs(s, g);
  EXPECT_NEAR(length_of_seams(s, g), 3, 1e-9);
  EXPECT_NEAR(length_of_seams(s, g, is_cheap), 3, 1e-9);
}

TEST(MergeControls, MoreOrdersDoNotMakeSeamsLonger)
{
  const Surface s = surface_of(glove());
  Segmentation start = Variational_segmentation().segment(s, Execution());
  cut_to_discs(s, start);
  double last = 1e9;
  for (const std::size_t orders : {1, 3, 5}) {
    Merge_options options;
    options.orders = orders;
    Segmentation g = start;
    merge_charts(s, g, options, Bijective_parameterizer(), Identity_optimizer());
    EXPECT_LE(length_of_seams(s, g), 1.02 * last); // on the coarse surface lengths differ a little
    last = length_of_seams(s, g);
  }
}

TEST(MergeControls, NoMoreOrdersThanTheWorkAllows)
{
  const Surface s = surface_of(glove());
  Segmentation start = Variational_segmentation().segment(s, Execution());
  cut_to_discs(s, start);
  const auto merged_in = [&](std::size_t orders, std::size_t work) {
    Merge_options options;
    options.orders = orders;
    options.max_work_of_orders = work;
    Segmentation g = start;
    merge_charts(s, g, options, Bijective_parameterizer(), Identity_optimizer());
    return std::pair(g.chart, g.cut);
  };
  const auto one = merged_in(1, 1'000'000), six = merged_in(6, 1'000'000);
  ASSERT_NE(one, six);
  EXPECT_EQ(merged_in(6, 0), one);
  EXPECT_EQ(merged_in(6, 100'000'000), six);
}

TEST(MergeControls, AtMostSoManyCharts)
{
  const Surface s = surface_of(torus(48, 32));
  Merge_options options = quick();
  options.max_distortion = 1.002;
  const Segmentation usual = merged(s, options);
  ASSERT_GT(usual.number_of_charts, 3u);
  for (const std::size_t most : {3, 1}) {
    options.max_charts = most;
    const Segmentation g = merged(s, options);
    expect_discs(s, g);
    EXPECT_EQ(g.number_of_charts, most);
  }
  // What the bound allows is not undone.
  options.max_charts = 1000;
  EXPECT_EQ(merged(s, options).number_of_charts, usual.number_of_charts);
}

TEST(MergeControls, PatchesSetTheLeastNumberOfCharts)
{
  Surface s = surface_of(planar_grid(12, 12));
  s.patch.resize(s.number_of_triangles());
  for (Index t = 0; t < s.number_of_triangles(); ++t)
    s.patch[t] = t % 24 / 8;
  Merge_options options = quick();
  options.max_charts = 1;
  EXPECT_EQ(merged(s, options).number_of_charts, 3u);
}

TEST(MergeControls, NoChartBelowTheLeastArea)
{
  const Surface s = surface_of(torus(48, 32));
  Merge_options options = quick();
  options.max_distortion = 1.002;
  const auto smallest = [&](const Segmentation& g) {
    double least = 1;
    for (const Chart& chart : extract_charts(s, g))
      least = std::min(least, area_3d(chart) / area_3d(s));
    return least;
  };
  ASSERT_LT(smallest(merged(s, options)), 0.2);
  options.min_chart_area = 0.25;
  const Segmentation g = merged(s, options);
  expect_discs(s, g);
  EXPECT_GT(smallest(g), 0.23); // areas are those of the coarse surface
  EXPECT_GT(g.number_of_charts, 1u);
}

/// The share of the area in charts whose distortion is at most `bound`.
double share_within(const Surface& s, const Segmentation& g, Distortion_measure measure, double bound,
                    Optimize_charts optimize)
{
  double within = 0;
  for (Chart& chart : extract_charts(s, g)) {
    EXPECT_EQ(Bijective_parameterizer(optimize).parameterize(chart, Execution()), Chart_status::valid);
    if (value(measure_distortion(chart), measure) <= bound)
      within += area_3d(chart);
  }
  return within / area_3d(s);
}

TEST(MergeControls, FewSeamsAreFewer)
{
  const Surface s = surface_of(glove());
  const Segmentation usual = merged(s, Merge_options());
  const Merge_options few = few_seams_options();
  const Segmentation g = merged(s, few);
  expect_discs(s, g);
  EXPECT_LT(length_of_seams(s, g), length_of_seams(s, usual));
  EXPECT_LE(g.number_of_charts, usual.number_of_charts);
  EXPECT_NEAR(share_within(s, g, few.measure, few.max_distortion + 0.015, Optimize_charts::always), 1, 1e-12);
}

TEST(MergeControls, ConformalChartsKeepTheirDensities)
{
  const Surface s = surface_of(glove());
  Merge_options options = conformal_options();
  options.orders = 1;
  EXPECT_EQ(options.measure, Distortion_measure::area_ratio_quantiles);
  const Segmentation g =
      Merged_segmentation(Variational_segmentation(), Bijective_parameterizer(Optimize_charts::if_needed),
                          Identity_optimizer(), options)
          .segment(s, Execution());
  expect_discs(s, g);
  const Segmentation base = Variational_segmentation().segment(s, Execution());
  const auto share = [&](const Segmentation& charts) {
    return share_within(s, charts, options.measure, 2, Optimize_charts::if_needed);
  };
  Merge_options few = few_seams_options();
  few.orders = 1;
  EXPECT_GT(share(g), share(merged(s, few)) + 0.2);
  EXPECT_LT(g.number_of_charts, base.number_of_charts / 2);
}

} // namespace
} // namespace Atlas::test
