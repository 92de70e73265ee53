// SPDX-License-Identifier: MIT
#include <Atlas/segmentation/Feature_segmentation.h>

#include "segmentation_checks.h"
#include "segmentation_shapes.h"

namespace Atlas {
namespace {

/// A value per triangle from one per face.
std::vector<double> per_face(const Surface& surface, const std::function<double(Index)>& f)
{
  std::vector<double> result;
  for (const Index face : surface.face)
    result.push_back(f(face));
  return result;
}

double height(const Surface& surface, Index t)
{
  return CGAL::centroid(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2)).z();
}

TEST(Expand_charts, Charts_are_discs_whatever_the_function)
{
  // Where a chart cannot cover a whole sphere, growth alone makes discs: boundaries remain inside charts.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const test::Soup& soup :
       {test::torus(24, 12), test::open_cylinder(true), test::planar_grid(20, 20), test::glove()}) {
    const Surface surface = test::surface_of(soup);
    for (const Growth_options& options : {Growth_options{0, 0}, {0.3, 0}, {0.7, 0.1}, {1, 0}}) {
      std::vector<double> value(surface.number_of_faces);
      for (double& v : value)
        v = uniform(random);
      const Segmentation segmentation =
          expand_charts(surface, per_face(surface, [&](Index f) { return value[f]; }), options);
      test::expect_discs(surface, segmentation);
      test::expect_numbered_by_first_triangle(segmentation);
    }
  }
}

TEST(Expand_charts, Two_hills_meet_in_the_valley)
{
  const Surface surface = test::surface_of(
      test::grid(40, 10, [](double x, double y) { return Point_3(x, y, std::abs(x - 0.5)); }));
  const std::vector<double> value = per_face(surface, [&](Index f) { return height(surface, f); });
  const Segmentation two = expand_charts(surface, value);
  EXPECT_EQ(two.number_of_charts, 2u);
  for (Index t = 0; t < two.chart.size(); ++t)
    EXPECT_EQ(two.chart[t] == two.chart[0],
              surface.point(3 * t).x() + surface.point(3 * t + 1).x() + surface.point(3 * t + 2).x() < 1.5);
  EXPECT_EQ(expand_charts(surface, value, {1, 0}).number_of_charts, 1u);
}

TEST(Expand_charts, Depth_decides_on_merging)
{
  // Tops at height 1; a valley down to 1 - depth between them.
  for (const double depth : {0.1, 0.2, 0.3, 0.5}) {
    const Surface surface = test::surface_of(test::planar_grid(80, 4));
    const std::vector<double> value = per_face(surface, [&](Index f) {
      const double x = double(f / 2 % 80) / 79;
      return 1 - depth * (1 - std::abs(2 * x - 1));
    });
    EXPECT_EQ(expand_charts(surface, value).number_of_charts, depth < 0.25 ? 1u : 2u) << depth;
  }
}

TEST(Expand_charts, A_bump_on_a_slope_is_noise_if_it_is_low)
{
  // From 1 down to 0, with a bump of the given height at two thirds of the way.
  for (const double bump : {0.03, 0.2}) {
    const Surface surface = test::surface_of(test::planar_grid(90, 4));
    const std::vector<double> value = per_face(surface, [&](Index f) {
      const double x = double(f / 2 % 90) / 90;
      return x < 0.6 ? 1 - x : x < 0.7 ? 0.4 + bump * 10 * (x - 0.6) : (0.4 + bump) * (1 - x) / 0.3;
    });
    EXPECT_EQ(expand_charts(surface, value, {0.25, 0.05}).number_of_charts, bump < 0.05 ? 1u : 2u) << bump;
    EXPECT_EQ(expand_charts(surface, value, {0.25, 0}).number_of_charts, 2u) << bump;
  }
}

TEST(Expand_charts, To_the_letter_both_charts_are_within_epsilon)
{
  // A summit of 1, a valley of 0.35, a hill of 0.4: the hill is hardly any, but the summit is more than a
  // quarter above the valley.
  const Surface surface = test::surface_of(test::planar_grid(90, 4));
  const std::vector<double> value = per_face(surface, [&](Index f) {
    const double x = double(f / 2 % 90) / 89;
    return x < 0.6 ? 1 - x * 0.65 / 0.6 : x < 0.7 ? 0.35 + 0.5 * (x - 0.6) : 0.4 - 1.3 * (x - 0.7);
  });
  Growth_options tolerant;
  tolerant.noise_depth = 0.1;
  EXPECT_EQ(expand_charts(surface, value, tolerant).number_of_charts, 1u);
  EXPECT_EQ(expand_charts(surface, value, Growth_options::paper()).number_of_charts, 2u);
}

TEST(Expand_charts, To_the_letter_epsilon_is_a_share_of_the_largest_distance_of_all)
{
  // Two sheets, the second with a tenth of the first's heights: two hills with a deep valley each.
  test::Soup soup = test::planar_grid(80, 4);
  const std::size_t faces = soup.polygons.size();
  test::append(soup, test::grid(80, 4, [](double x, double y) { return Point_3(x, y, 5); }));
  const Surface surface = test::surface_of(soup);
  const std::vector<double> value = per_face(surface, [&](Index f) {
    const double x = double(f % faces / 2 % 80) / 79;
    return (f < faces ? 1 : 0.1) * (1 - 0.8 * (1 - std::abs(2 * x - 1)));
  });
  Growth_options options = Growth_options::paper();
  EXPECT_EQ(expand_charts(surface, value, options).number_of_charts, 3u);
  options.is_depth_global = false;
  EXPECT_EQ(expand_charts(surface, value, options).number_of_charts, 4u);
}

TEST(Expand_charts, A_plateau_is_one_chart)
{
  const Surface surface = test::surface_of(test::planar_grid(30, 30));
  const Segmentation one = expand_charts(surface, per_face(surface, [](Index) { return 1.; }));
  EXPECT_EQ(one.number_of_charts, 1u);
  EXPECT_EQ(std::count(one.cut.begin(), one.cut.end(), 1), 0);
}

TEST(Expand_charts, A_chart_rolls_around_a_cylinder_and_borders_itself)
{
  const Surface surface = test::surface_of(test::open_cylinder());
  const std::vector<std::uint8_t> none(surface.opposite.size(), 0);
  const Segmentation rolled = expand_charts(surface, distance_to_features(surface, none));
  EXPECT_EQ(rolled.number_of_charts, 1u);
  EXPECT_GE(std::count(rolled.cut.begin(), rolled.cut.end(), 1) / 2, 30);
  test::expect_discs(surface, rolled);
}

TEST(Expand_charts, Patches_seams_and_forbidden_seams)
{
  Surface surface = test::surface_of(test::planar_grid(20, 20));
  const std::vector<double> flat(surface.number_of_triangles(), 1);
  surface.patch.assign(surface.number_of_triangles(), 0);
  for (Index t = 0; t < 400; ++t)
    surface.patch[t] = 1;
  const Segmentation two = expand_charts(surface, flat);
  EXPECT_EQ(two.number_of_charts, 2u);
  test::expect_constraints(surface, two);

  surface.patch.clear();
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && surface.point(h).x() == 0.5 &&
        surface.point(next_halfedge(h)).x() == 0.5)
      surface.constraint[h] = Edge_constraint::seam;
  const Segmentation halves = expand_charts(surface, flat);
  EXPECT_EQ(halves.number_of_charts, 2u);
  test::expect_constraints(surface, halves);

  for (Edge_constraint& c : surface.constraint)
    c = Edge_constraint::no_seam;
  std::mt19937 random(1);
  std::vector<double> noise(flat.size());
  for (double& v : noise)
    v = static_cast<double>(random() % 1000);
  EXPECT_EQ(expand_charts(surface, noise, {0, 0}).number_of_charts, 1u);
}

TEST(Expand_charts, Values_that_are_no_numbers)
{
  const Surface surface = test::surface_of(test::planar_grid(5, 5));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Segmentation segmentation =
      expand_charts(surface, std::vector<double>(surface.number_of_triangles(), nan));
  for (const Index c : segmentation.chart)
    EXPECT_LT(c, segmentation.number_of_charts);
}

} // namespace
} // namespace Atlas
