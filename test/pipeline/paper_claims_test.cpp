// SPDX-License-Identifier: MIT
// What the LSCM paper says, and what is so: each test is a sentence of doc/paper.md.
#include <Atlas/core/extract_charts.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/validation/Exact_validator.h>

#include "flattening_checks.h"
#include "segmentation_shapes.h"
#include "test_meshes.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <set>

namespace Atlas::test {
namespace {

/// Kantorovich's inequality: the L2 stretch of a conformal chart whose densities of area differ by at most 2.
const double greatest_stretch = 3 / (2 * std::sqrt(2.));

/// Right triangles apart from each other, of area `weight` in space and `weight * ratio` in the plane, each
/// mapped by a similarity.
Chart scaled_triangles(const std::vector<double>& weight, const std::vector<double>& ratio)
{
  Chart chart;
  for (Index t = 0; t < weight.size(); ++t) {
    const double side = std::sqrt(2 * weight[t]), flat = side * std::sqrt(ratio[t]), left = 10. * t;
    chart.points.insert(chart.points.end(),
                        {Point_3(left, 0, 0), Point_3(left + side, 0, 0), Point_3(left, side, 0)});
    chart.uv.insert(chart.uv.end(), {Point_2(left, 0), Point_2(left + flat, 0), Point_2(left, flat)});
    chart.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    chart.source.push_back(t);
  }
  return chart;
}

TEST(Paper, Charts_that_obey_the_rule_on_areas_cannot_have_the_printed_stretches)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> weight(0.01, 1), ratio(1, 2);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> weights(40), ratios(40);
    for (double& w : weights)
      w = weight(random);
    for (double& r : ratios)
      r = i % 2 ? ratio(random) : double(1 + random() % 2);
    EXPECT_LE(measure_distortion(scaled_triangles(weights, ratios)).l2_stretch, greatest_stretch + 1e-9);
  }
  // The bound is reached where half of the area has the one density, half the other.
  EXPECT_NEAR(measure_distortion(scaled_triangles({1, 1}, {1, 2})).l2_stretch, greatest_stretch, 1e-9);
  for (const double stretch : {2.9, 2.5, 1.16, 1.14, 1.26, 1.55, 1.12}) // Table 2
    EXPECT_GT(stretch, greatest_stretch);
}

Index flipped_triangles(const Chart& chart)
{
  return static_cast<Index>(std::count_if(chart.triangles.begin(), chart.triangles.end(), [&](const auto& t) {
    return CGAL::orientation(chart.uv[t[0]], chart.uv[t[1]], chart.uv[t[2]]) != CGAL::LEFT_TURN;
  }));
}

std::set<Index> border_vertices(const Chart& chart)
{
  std::set<std::pair<Index, Index>> halfedges;
  for (const auto& t : chart.triangles)
    for (int i = 0; i < 3; ++i)
      halfedges.insert({t[i], t[(i + 1) % 3]});
  std::set<Index> result;
  for (const auto& [a, b] : halfedges)
    if (!halfedges.contains({b, a}))
      result.insert(a);
  return result;
}

TEST(Paper, With_pins_on_the_border_triangles_flip)
{
  // Section 2.6: "all the triangles are consistently oriented if the pinned vertices are chosen on the
  // boundary".
  Chart chart = height_field(16, 6, 5);
  LSCM_record record;
  ASSERT_EQ(LSCM_parameterizer<>().parameterize(chart, Execution(), record), Chart_status::valid);
  ASSERT_EQ(record.pins.size(), 2u);
  const std::set<Index> border = border_vertices(chart);
  for (const LSCM_pin& pin : record.pins)
    EXPECT_TRUE(border.contains(pin.vertex));
  EXPECT_GT(flipped_triangles(chart), 0u);

  // The cure: Bijective_parameterizer.
  ASSERT_EQ(Bijective_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
  EXPECT_TRUE(is_one_to_one(chart));
}

/// Pins all vertices of the border, on a circle.
struct Border_on_circle
{
  using Solver = Eigen_LSCM_traits::Solver;

  static std::vector<LSCM_pin> pins(const Chart& chart)
  {
    std::vector<LSCM_pin> pins;
    const CGAL::Bbox_3 box = CGAL::bbox_3(chart.points.begin(), chart.points.end());
    const Point_3 centre((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2,
                         (box.zmin() + box.zmax()) / 2);
    for (const Index v : border_vertices(chart)) {
      const Vector_3 d = chart.points[v] - centre;
      const double length = std::sqrt(d.squared_length());
      pins.push_back({v, Point_2(d.x() / length, d.y() / length)});
    }
    return pins;
  }
};

TEST(Paper, With_the_border_on_a_convex_curve_triangles_flip)
{
  // Section 1.2: "if all the border nodes are fixed on a convex polygon, no overlap can occur".
  Chart chart = chart_of(grid(12, 12, [](double x, double y) { return Point_3(x + 4 * y, y, 0); }));
  ASSERT_EQ(LSCM_parameterizer<Border_on_circle>().parameterize(chart, Execution()), Chart_status::valid);
  EXPECT_GT(flipped_triangles(chart), 0u);
}

/// How many edges of features have the same chart on both sides.
Index crossed_features(const Surface& surface, const std::vector<std::uint8_t>& is_feature,
                       const Growth_options& growth)
{
  const Segmentation charts = expand_charts(surface, distance_to_features(surface, is_feature), growth);
  Index crossed = 0;
  for (Index h = 0; h < is_feature.size(); ++h)
    crossed += is_feature[h] && charts.is_glued(surface, h);
  return crossed;
}

TEST(Paper, Merging_below_a_quarter_of_the_largest_distance_crosses_features)
{
  // A wide sheet, whose middle is far from features, goes on over a step that is small beside it.
  Soup soup;
  append(soup, grid(40, 40, [](double x, double y) { return Point_3(10 * x, 10 * y, 0); }));
  append(soup, grid(40, 4, [](double x, double y) { return Point_3(10 * x, 0, y); }));
  append(soup, grid(40, 4, [](double x, double y) { return Point_3(10 * x, -y, 1); }));
  const Surface surface = surface_of(soup);
  const std::vector<std::uint8_t> is_feature = detect_features(surface, Feature_options::paper());
  Growth_options unmerged = Growth_options::paper();
  unmerged.merge_depth = 0;
  EXPECT_GT(crossed_features(surface, is_feature, Growth_options::paper()),
            crossed_features(surface, is_feature, unmerged));
}

/// How many charts there are, and how many of less than 20 triangles.
std::pair<std::size_t, std::size_t> count(const Atlas_report& report)
{
  return {report.charts.size(), std::count_if(report.charts.begin(), report.charts.end(),
                                              [](const Chart_report& c) { return c.triangles < 20; })};
}

TEST(Paper, The_rule_on_areas_makes_confetti)
{
  const Surface surface = surface_of(whole_glove());
  std::vector<Point_2> uv;
  const auto paper = parameters::mode(Atlas_mode::paper);
  const Exact_validator rule(default_max_area_ratio, 0), no_rule(0);
  const auto [with_rule, small] = count(generate_atlas(surface, uv, paper.validator(rule)));
  const auto [without_rule, small_without] = count(generate_atlas(surface, uv, paper.validator(no_rule)));
  EXPECT_GT(with_rule, 2 * without_rule);
  EXPECT_GT(small, small_without);
}

TEST(Paper, Charts_of_the_papers_pipeline_keep_the_bound_on_stretch)
{
  const Surface surface = surface_of(whole_glove());
  std::vector<Point_2> uv;
  const auto paper =
      parameters::mode(Atlas_mode::paper).validator(Exact_validator(default_max_area_ratio, 0));
  const Atlas_report report = generate_atlas(surface, uv, paper);
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  for (const Chart_report& chart : report.charts) {
    EXPECT_LE(chart.distortion.area_max / chart.distortion.area_min, 2 + 1e-6);
    // Not quite conformal: each triangle adds (s1/s2 + s2/s1)/2 to its part.
    EXPECT_LE(chart.distortion.l2_stretch,
              greatest_stretch * std::sqrt(chart.distortion.quasi_conformal_mean));
  }
}

} // namespace
} // namespace Atlas::test
