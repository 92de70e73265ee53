// SPDX-License-Identifier: MIT
// No chart exceeds its bound without a reason.
#include <Atlas/core/extract_charts.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/pipeline/internal/Cut_forest.h>
#include <Atlas/pipeline/internal/Cut_zipper.h>
#include <Atlas/pipeline/internal/slit_chart.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/validation/Culprit_splitter.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/internal/Worst_place.h>

#include "segmentation_shapes.h"
#include "test_meshes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace Atlas::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A single column of squares of side 1, of which number i is mapped to a rectangle of height `heights[i]`.
Chart column_of_squares(const std::vector<double>& heights)
{
  Chart chart;
  double y = 0;
  for (Index i = 0; i <= heights.size(); ++i) {
    chart.points.emplace_back(0, i, 0);
    chart.points.emplace_back(1, i, 0);
    chart.uv.emplace_back(0, y);
    chart.uv.emplace_back(1, y);
    if (i == heights.size())
      break;
    y += heights[i];
    chart.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
    chart.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
    chart.source.push_back(2 * i);
    chart.source.push_back(2 * i + 1);
  }
  return chart;
}

/// A cone of the given height over the unit circle.
Soup cone(double height)
{
  return lathe({{1, 0}, {0, height}}, 48, 12);
}

/// Per chart of the result, what `measure` says, from the coordinates at corners.
std::vector<double> measured(const Surface& surface, const std::vector<Point_2>& uv,
                             const Atlas_report& report, double share)
{
  std::vector<std::vector<Triangle_distortion>> charts(report.charts.size());
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    charts[report.segmentation.chart[t]].push_back(triangle_distortion(
        {surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2)},
        {uv[surface.corner[3 * t]], uv[surface.corner[3 * t + 1]], uv[surface.corner[3 * t + 2]]}));
  std::vector<double> result;
  for (const auto& chart : charts)
    result.push_back(stretch_quantile(chart, share));
  return result;
}

TEST(StretchQuantile, CountsShrinkingLikeStretchingAndWeighsByArea)
{
  // Scaled to the area of 10, which the heights sum up to: stretch 1.5, 2 and 1.
  const std::vector<Triangle_distortion> m =
      triangle_distortions(column_of_squares({1.5, 0.5, 1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_DOUBLE_EQ(stretch_quantile(m, 1), 2);
  EXPECT_DOUBLE_EQ(stretch_quantile(m, 0.91), 2);
  EXPECT_DOUBLE_EQ(stretch_quantile(m, 0.9), 1.5);
  EXPECT_DOUBLE_EQ(stretch_quantile(m, 0.81), 1.5);
  EXPECT_DOUBLE_EQ(stretch_quantile(m, 0.8), 1);
  EXPECT_DOUBLE_EQ(summarize_distortion(m).stretch_max, 2);
  EXPECT_EQ(stretch_quantile({}, 1), 1);
}

TEST(UsedShare, IsThatOfTheBoundThatIsUsedMore)
{
  const std::vector<Triangle_distortion> m =
      triangle_distortions(column_of_squares({1.5, 0.5, 1, 1, 1, 1, 1, 1, 1, 1}));
  const auto measure = Distortion_measure::symmetric_dirichlet;
  const double mean = summarize_distortion(m).symmetric_dirichlet_mean;
  EXPECT_EQ(used_share(m, {}), 0);
  EXPECT_NEAR(used_share(m, {measure, mean}), 1, 1e-12);
  EXPECT_NEAR(used_share(m, {measure, 1 + 2 * (mean - 1)}), 0.5, 1e-12);
  EXPECT_NEAR(used_share(m, {measure, infinite, 1.5, 1}), 2, 1e-12);
  EXPECT_NEAR(used_share(m, {measure, infinite, 1.5, 0.9}), 1, 1e-12);
  EXPECT_NEAR(used_share(m, {measure, mean, 1.25, 0.9}), 2, 1e-12);
}

TEST(ExactValidator, RefusesChartsBeyondTheBoundAndNamesTheWorstTriangle)
{
  const Chart chart = column_of_squares({1.5, 1, 1, 1, 1, 1, 1, 1, 1, 0.5});
  const auto verdict = [&](const Distortion_bound& bound) {
    return Exact_validator(0, 0, bound).validate(chart, Execution());
  };
  const auto measure = Distortion_measure::symmetric_dirichlet;
  EXPECT_TRUE(verdict({measure, infinite, 2.001, 1}).is_valid());
  EXPECT_TRUE(verdict({measure, infinite, 1.001, 0.8}).is_valid());
  const Chart_verdict refused = verdict({measure, infinite, 1.999, 1});
  EXPECT_EQ(refused.status, Chart_status::bound_exceeded);
  ASSERT_EQ(refused.culprits.size(), 1u);
  EXPECT_EQ(refused.culprits[0] / 2, 9u);
  EXPECT_EQ(verdict({measure, 1.001}).status, Chart_status::bound_exceeded);
  EXPECT_THROW(verdict({measure, 0.9}), Invalid_argument);
  EXPECT_THROW(verdict({measure, 2, 2, 0}), Invalid_argument);
  EXPECT_THROW(verdict({measure, 2, 2, 1.1}), Invalid_argument);
}

TEST(WorstPlace, IsTheTipOfAConeAndCutsGoThroughIt)
{
  Chart chart = chart_of(cone(1));
  for (const Point_3& p : chart.points) // seen from above
    chart.uv.emplace_back(p.x(), p.y());
  for (std::size_t v = 0; v < chart.points.size(); ++v) { // crowded at the tip
    const double r = std::hypot(chart.points[v].x(), chart.points[v].y());
    chart.uv[v] = Point_2(chart.uv[v].x() * r, chart.uv[v].y() * r);
  }
  const auto cost = [](Index) { return 1.0; };
  const std::vector<Index> slit = internal::Worst_place(chart, cost).slit();
  ASSERT_FALSE(slit.empty());
  const auto height = [&](Index v) { return chart.points[v].z(); };
  double low = 1, high = 0;
  for (const Index h : slit) {
    for (const Index v : {chart.triangles[h / 3][h % 3], chart.triangles[h / 3][(h + 1) % 3]}) {
      low = std::min(low, height(v));
      high = std::max(high, height(v));
    }
    EXPECT_NE(internal::opposite_halfedges(chart.triangles)[h], no_index);
  }
  EXPECT_LT(low, 1e-12) << "it reaches the border";
  EXPECT_GT(high, 0.8) << "it ends about the tip";
  const std::vector<Index> parts = Culprit_splitter().split(chart, {Chart_status::bound_exceeded, {0}});
  const auto second = std::count(parts.begin(), parts.end(), 1u);
  EXPECT_GT(second, long(parts.size()) / 4) << "cut off least border for the length: through the middle";
  EXPECT_LT(second, 3 * long(parts.size()) / 4);
}

TEST(DistortionBounds, EveryChartKeepsTheStretchThatIsAskedFor)
{
  for (const Soup& soup : {sphere(4), torus(48, 24), glove()})
    for (const double share : {0.95, 1.0}) {
      const Surface surface = surface_of(soup);
      Merge_options options;
      options.max_stretch = 1.2;
      options.max_stretch_share = share;
      std::vector<Point_2> uv;
      const Atlas_report report = generate_atlas(surface, uv, parameters::merge_options(options));
      EXPECT_TRUE(report.is_valid());
      EXPECT_EQ(report.charts_beyond_bound, 0u);
      const std::vector<double> stretch = measured(surface, uv, report, share);
      for (std::size_t c = 0; c < stretch.size(); ++c) {
        EXPECT_LE(stretch[c], 1.2);
        EXPECT_NEAR(stretch[c], report.charts[c].stretch, 1e-6);
      }
      std::vector<Point_2> usual;
      Policies without_slits = preset();
      without_slits.repair.wanted_stretch = infinite;
      const Atlas_report other = generate_atlas(surface, usual, parameters::policies(without_slits));
      const std::vector<double> of_other = measured(surface, usual, other, share);
      EXPECT_GT(*std::max_element(of_other.begin(), of_other.end()), 1.2) << "or the bound does nothing";
    }
}

TEST(DistortionBounds, ASlitOpensAConeAndLeavesOneChart)
{
  const Surface surface = surface_of(cone(1.5));
  std::vector<Point_2> uv;
  const Exact_validator bounded(0, 0, {Distortion_measure::symmetric_dirichlet, 1.035});
  const Atlas_report report =
      generate_atlas(surface, uv, parameters::segmentation(Patch_segmentation()).validator(bounded));
  EXPECT_TRUE(report.is_valid());
  ASSERT_EQ(report.charts.size(), 1u);
  EXPECT_LE(report.charts[0].distortion.symmetric_dirichlet_mean, 1.035);
  EXPECT_NEAR(report.seam_length, std::hypot(1, 1.5), 0.3) << "from the border to about the tip";
}

TEST(DistortionBounds, ShortSlitsLowerTheTailOfTheWholeSurface)
{
  double before = 0, usual = 0, after = 0, seam_before = 0, seam_after = 0;
  for (const Soup& soup : {sphere(4), ellipsoid(2), glove()}) {
    const Surface surface = surface_of(soup);
    const auto report_with = [&](double wanted) {
      Policies policies = preset();
      policies.repair.wanted_stretch = wanted;
      std::vector<Point_2> uv;
      return generate_atlas(surface, uv, parameters::policies(policies));
    };
    const Atlas_report plain = report_with(infinite), slit = report_with(1.15);
    EXPECT_TRUE(slit.is_valid());
    before += plain.distortion.stretch_p99;
    after += slit.distortion.stretch_p99;
    std::vector<Point_2> uv;
    usual += generate_atlas(surface, uv).distortion.stretch_p99;
    seam_before += plain.seam_length;
    seam_after += slit.seam_length;
  }
  EXPECT_LT(after, 3 * 1.2) << "as was wanted, about";
  EXPECT_LT(usual, before) << "the standard mode makes some";
  EXPECT_GT(usual, after);
  EXPECT_GT(seam_after, seam_before);
  EXPECT_LT(seam_after, 1.4 * seam_before);
}

/// The edges of cuts that are left when those of one chart are zipped: a sheet of 24 x 24 cells, of a height
/// that goes with the distance from its middle, cut from the border to there.
template <typename Height>
std::size_t cuts_left(const Height& height, Edge_constraint constraint = Edge_constraint::none)
{
  Surface surface = surface_of(
      grid(24, 24, [&](double x, double y) { return Point_3(x, y, height(std::hypot(x - 0.5, y - 0.5))); }));
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  Segmentation segmentation;
  segmentation.chart.assign(surface.number_of_triangles(), 0);
  segmentation.cut.assign(surface.opposite.size(), 0);
  segmentation.number_of_charts = 1;
  const auto is_on_cut = [&](Index h) {
    const Point_3& p = surface.point(h);
    return std::abs(p.y() - 0.5) < 1e-9 && p.x() < 0.5 + 1e-9;
  };
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && is_on_cut(h) && is_on_cut(next_halfedge(h))) {
      segmentation.cut[h] = 1;
      surface.constraint[h] = constraint;
    }
  const auto lay_flat = [](Chart& chart) {
    Flattening_record record;
    return preset().parameterizer.parameterize(chart, Execution(1), record);
  };
  const auto flatten = [&](Chart chart) {
    internal::Flattened_chart result{std::move(chart), {}, {}, {}};
    result.verdict.status = lay_flat(result.chart);
    return result;
  };
  std::vector<internal::Flattened_chart> charts{flatten(extract_charts(surface, segmentation).front())};
  internal::Cut_zipper(surface, segmentation, 1.28, flatten, lay_flat, Execution(1)).run(charts);
  EXPECT_TRUE(charts[0].verdict.is_valid());
  EXPECT_EQ(charts[0].chart.points, extract_charts(surface, segmentation).front().points);
  return static_cast<std::size_t>(std::count(segmentation.cut.begin(), segmentation.cut.end(), 1)) / 2;
}

TEST(DistortionBounds, CutsThatNobodyNeedsAreZipped)
{
  const auto bowl = [](double r) { return r * r; };
  const auto cone = [](double slope) { return [slope](double r) { return -slope * r; }; };
  EXPECT_EQ(cuts_left(bowl), 0u);
  EXPECT_EQ(cuts_left(bowl, Edge_constraint::seam), 12u) << "a seam that is wanted";
  EXPECT_GT(cuts_left(cone(1.6)), 6u) << "the cone needs it";
  EXPECT_EQ(cuts_left(cone(0.4)), 12u) << "with it the net of the cone has no distortion";
}

TEST(DistortionBounds, ASlitOpensWithoutFlipsAndLeavesTheRestAsItIs)
{
  Chart sheet =
      extract_charts(surface_of(planar_grid(8, 8)), one_chart(surface_of(planar_grid(8, 8)))).front();
  for (const Point_3& p : sheet.points)
    sheet.uv.emplace_back(p.x(), p.y());
  const internal::Chart_ways graph(sheet);
  std::vector<Index> border;
  Index middle = no_index;
  for (Index v = 0; v < sheet.number_of_vertices(); ++v) {
    if (graph.is_border(v))
      border.push_back(v);
    if (CGAL::squared_distance(sheet.points[v], Point_3(0.5, 0.5, 0)) < 1e-12)
      middle = v;
  }
  ASSERT_NE(middle, no_index);
  const auto ways = graph.from(border, [&](Index h) { return graph.length(h); });
  const std::vector<Index> way = graph.way_to(ways, middle);
  ASSERT_GE(way.size(), 4u);
  const Chart slit = internal::slit_chart(sheet, graph, way);
  EXPECT_EQ(slit.number_of_vertices(), sheet.number_of_vertices() + way.size());
  EXPECT_TRUE(Exact_validator(0).validate(slit, Execution(1)).is_valid());
  EXPECT_TRUE(internal::is_border_clear(slit, 0.01));
  std::size_t moved = 0;
  for (std::size_t h = 0; h < 3 * slit.number_of_triangles(); ++h)
    moved += slit.uv[slit.triangles[h / 3][h % 3]] != sheet.uv[sheet.triangles[h / 3][h % 3]];
  EXPECT_GT(moved, way.size());
  EXPECT_LE(moved, 6 * way.size());
}

TEST(DistortionBounds, SlitsAreAsGoodFromOldCoordinatesAsAnew)
{
  const Surface surface = surface_of(lathe({{1, 0}, {0.6, 0.4}, {0.35, 1}, {0.3, 1.6}}, 48, 24));
  std::array<double, 2> stretch{}, seam{};
  for (const bool is_anew : {false, true}) {
    Policies policies = preset();
    ASSERT_TRUE(policies.repair.slit_optimizer);
    policies.repair.wanted_stretch = 1.15;
    if (is_anew)
      policies.repair.slit_optimizer.reset();
    std::vector<Point_2> uv;
    const Atlas_report report =
        generate_atlas(surface, uv, parameters::policies(policies).seam_exchange_rate(0));
    ASSERT_TRUE(report.is_valid());
    stretch[is_anew] = report.distortion.stretch_p99;
    seam[is_anew] = report.seam_length;
  }
  EXPECT_NEAR(stretch[0], stretch[1], 0.05);
  EXPECT_NEAR(seam[0] / seam[1], 1, 0.15);
}

TEST(DistortionBounds, PiecesThatAreCutForPagesKeepIt)
{
  // All distortion of the strip is at one end: what is cut off there would exceed the bound.
  const Surface surface = surface_of(grid(40, 1, [](double x, double y) { return Point_3(40 * x, y, 0); }));
  const Segmentation segmentation = one_chart(surface);
  Chart strip = extract_charts(surface, segmentation).front();
  for (const Point_3& p : strip.points)
    strip.uv.emplace_back(1.6 * std::min(p.x(), 1.) + std::max(p.x() - 1, 0.), p.y());
  const std::vector<internal::Flattened_chart> charts{{strip, {}, {}, {}}};
  const auto largest_share = [&](const Distortion_bound& bound) {
    const Execution execution(1);
    internal::Cut_forest forest(surface, segmentation, charts, {8, 0.1}, execution, std::nullopt, 1, bound);
    while (forest.cut_longest(0.2)) {
    }
    Segmentation cut;
    double largest = 0;
    for (const internal::Flattened_chart& piece : forest.write(cut))
      largest = std::max(largest, used_share(triangle_distortions(piece.chart),
                                             {Distortion_measure::symmetric_dirichlet, 1.02}));
    EXPECT_GT(cut.number_of_charts, 1u);
    return largest;
  };
  EXPECT_GT(largest_share({}), 1);
  EXPECT_LE(largest_share({Distortion_measure::symmetric_dirichlet, 1.02}), 1);
}

TEST(DistortionBounds, ChartsThatBeginBeyondTheBoundAreSplit)
{
  Soup open = sphere(4);
  open.polygons.pop_back();
  const Surface surface = surface_of(open);
  std::vector<Point_2> uv;
  const Distortion_bound bound{Distortion_measure::symmetric_dirichlet, 1.02};
  const Atlas_report report = generate_atlas(
      surface, uv, parameters::segmentation(Patch_segmentation()).validator(Exact_validator(0, 0, bound)));
  EXPECT_TRUE(report.is_valid());
  EXPECT_GT(report.charts.size(), 1u);
  EXPECT_LT(report.charts.size(), 20u);
  for (const Chart_report& chart : report.charts)
    EXPECT_LE(chart.distortion.symmetric_dirichlet_mean, 1.02 + 1e-5);
}

TEST(DistortionBounds, WhatCannotBeKeptIsNamedWithTheReason)
{
  // Faces that are not flat have no isometric map, and no face is cut.
  const Surface bent = surface_of(grid(
      6, 6, [](double x, double y) { return Point_3(x, y, 2 * x * y); }, false, false, true));
  Merge_options options;
  options.max_stretch = 1.0001;
  options.max_stretch_share = 1;
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(bent, uv, parameters::merge_options(options));
  EXPECT_TRUE(report.is_valid());
  for (const Chart_report& chart : report.charts)
    EXPECT_EQ(chart.is_within_bound, chart.reason == Excess_reason::none);

  // A wish goes before the bound.
  const Atlas_report one = generate_atlas(surface_of(sphere(3)), uv, parameters::max_charts(1));
  ASSERT_EQ(one.charts.size(), 1u);
  EXPECT_EQ(one.charts[0].reason, Excess_reason::not_asked_for);
  EXPECT_EQ(one.charts_beyond_bound, 1u);
}

TEST(DistortionBounds, ASurfaceThatIsRoughAllOverIsNotCutToPieces)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> height(0, 0.04);
  const Surface surface =
      surface_of(grid(32, 32, [&](double x, double y) { return Point_3(x, y, height(random)); }));
  std::vector<Point_2> uv;
  const Exact_validator bounded(0, 0, {Distortion_measure::symmetric_dirichlet, 1.0001});
  const Atlas_report report =
      generate_atlas(surface, uv, parameters::segmentation(Patch_segmentation()).validator(bounded));
  EXPECT_TRUE(report.is_valid());
  EXPECT_LT(report.charts.size(), 200u) << "of 2048 triangles";
  EXPECT_TRUE(std::any_of(report.charts.begin(), report.charts.end(), [](const Chart_report& chart) {
    return chart.status == Chart_status::bound_exceeded;
  }));
}

} // namespace
} // namespace Atlas::test
