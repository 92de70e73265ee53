// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/features/Chart_boundaries.h>
#include <Atlas/segmentation/internal/features/Small_chart_absorber.h>
#include <Atlas/segmentation/internal/features/Sock_finder.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>

#include "segmentation_checks.h"
#include "segmentation_shapes.h"

namespace Atlas {
namespace {

static_assert(ChartSegmentation<Feature_segmentation>);
static_assert(ChartSegmentation<Patch_segmentation>);

Point_3 middle(const Surface& surface, Index t)
{
  return CGAL::centroid(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2));
}

std::set<Index> charts_where(const Surface& surface, const Segmentation& segmentation,
                             const std::function<bool(const Point_3&)>& where)
{
  std::set<Index> result;
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    if (where(middle(surface, t)))
      result.insert(segmentation.chart[t]);
  return result;
}

/// The fingers of whole_glove(), the thumb last, without what is near their creases.
const std::vector<std::function<bool(const Point_3&)>>& fingers()
{
  static const std::vector<std::function<bool(const Point_3&)>> result = [] {
    std::vector<std::function<bool(const Point_3&)>> where;
    for (int i = 0; i < 4; ++i)
      where.emplace_back([i](const Point_3& p) { return p.z() > 0.1 && p.x() > i && p.x() < i + 1; });
    where.emplace_back([](const Point_3& p) { return p.x() > 4.1; });
    return where;
  }();
  return result;
}

double height_of_finger(const Point_3& p)
{
  return std::max(p.z(), p.x() - 4);
}

/// Feature curves along the creases and the edges of the palm; five percent take in the tips of the fingers.
Feature_segmentation segmentation_of_glove()
{
  Feature_segmentation model;
  model.features.sharp_edge_share = 0.02;
  return model;
}

TEST(Feature_segmentation, The_fingers_of_a_glove_are_socks_with_a_cut)
{
  for (const bool is_closed : {false, true}) {
    const Surface surface = test::surface_of(test::whole_glove(is_closed));
    const Segmentation segmentation = segmentation_of_glove().segment(surface);
    test::expect_discs(surface, segmentation); // of a segmentation that nothing has mended
    const std::set<Index> palm = charts_where(surface, segmentation, [](const Point_3& p) {
      return p.z() < -0.1 && p.x() < 3.9; // its front and its back at least
    });
    EXPECT_GE(palm.size(), 2u);
    std::set<Index> socks;
    for (const auto& is_in_finger : fingers()) {
      const std::set<Index> charts = charts_where(surface, segmentation, is_in_finger);
      ASSERT_EQ(charts.size(), 1u);
      const Index sock = *charts.begin();
      EXPECT_TRUE(socks.insert(sock).second);
      EXPECT_FALSE(palm.contains(sock));
      // One cut from the base to the tip, as straight as edges go: 16 of the wall and 5 of the round tip.
      double lowest = 2, highest = 0;
      std::size_t sides = 0;
      for (Index h = 0; h < segmentation.cut.size(); ++h)
        if (segmentation.cut[h] && segmentation.chart[h / 3] == sock) {
          ++sides;
          for (const Index k : {h, next_halfedge(h)}) {
            lowest = std::min(lowest, height_of_finger(surface.point(k)));
            highest = std::max(highest, height_of_finger(surface.point(k)));
          }
        }
      EXPECT_EQ(sides / 2, 21u);
      EXPECT_LT(lowest, 0.01);
      EXPECT_GT(highest, 1.2);
    }

    Feature_segmentation without = segmentation_of_glove();
    without.sock_ratio = 1e9;
    const std::vector<std::uint8_t> uncut = without.segment(surface).cut;
    EXPECT_LE(std::count(uncut.begin(), uncut.end(), 1) + 5 * 2 * 21,
              std::count(segmentation.cut.begin(), segmentation.cut.end(), 1));
  }
}

TEST(Feature_segmentation, Socks_of_little_area_stay_closed)
{
  // A small thimble in the middle of a disc, as one chart: 6 % and 0.06 % of its area.
  for (const bool is_wide : {false, true}) {
    const Surface surface =
        test::surface_of(test::lathe({{is_wide ? 20 : 2, 0}, {0.2, 0}, {0.2, 0.5}, {0, 0.5}}, 24, 8));
    Segmentation segmentation = test::one_chart(surface);
    internal::cut_socks(surface, default_sock_ratio, segmentation, Execution());
    EXPECT_EQ(std::count(segmentation.cut.begin(), segmentation.cut.end(), 1) == 0, is_wide);
  }
}

TEST(Feature_segmentation, Small_charts_go_to_the_neighbour_with_most_border)
{
  // A strip of six cells along the bottom of a sheet: six edges to the chart above, one to that beside.
  const Surface surface = test::surface_of(test::planar_grid(8, 8));
  const internal::Submesh submesh = internal::surface_connectivity(surface);
  for (const Index above : {0u, 1u}) {
    internal::Chart_boundaries boundaries(surface, submesh);
    for (int c = 0; c < 3; ++c)
      boundaries.new_chart();
    const auto is_in_strip = [&](Index t) {
      return middle(surface, t).y() < 0.125 && middle(surface, t).x() < 0.75;
    };
    for (Index t = 0; t < surface.number_of_triangles(); ++t)
      boundaries.put(t, is_in_strip(t) ? 2 : middle(surface, t).x() < 0.75 ? above : 1 - above);
    internal::Small_chart_absorber(surface, submesh, boundaries).run({13, 0, 0});
    for (Index t = 0; t < surface.number_of_triangles(); ++t)
      EXPECT_EQ(boundaries.chart(t) == boundaries.chart(0), middle(surface, t).x() < 0.75);
  }
}

TEST(Feature_segmentation, With_the_defaults_of_the_paper_a_glove_has_fingers_too)
{
  for (const bool is_closed : {false, true}) {
    const Surface surface = test::surface_of(test::whole_glove(is_closed));
    Segmentation segmentation = Feature_segmentation().segment(surface);
    test::expect_discs(surface, segmentation);
    EXPECT_LE(segmentation.number_of_charts, 16u);
    std::set<Index> others =
        charts_where(surface, segmentation, [](const Point_3& p) { return p.z() < -0.1 && p.x() < 3.9; });
    for (const auto& is_in_finger : fingers())
      for (const Index c : charts_where(surface, segmentation, is_in_finger))
        EXPECT_TRUE(others.insert(c).second) << "a chart goes on beyond a finger";
  }
}

TEST(Feature_segmentation, A_capped_cylinder_is_two_lids_and_a_rolled_side)
{
  for (const bool quads : {false, true}) {
    const Surface surface = test::surface_of(test::capped_cylinder(quads));
    const Segmentation segmentation = Feature_segmentation().segment(surface);
    EXPECT_EQ(segmentation.number_of_charts, 3u);
    const auto bottom = charts_where(surface, segmentation, [](const Point_3& p) { return p.z() == 0; });
    const auto top = charts_where(surface, segmentation, [](const Point_3& p) { return p.z() == 3; });
    const auto side =
        charts_where(surface, segmentation, [](const Point_3& p) { return p.z() > 0 && p.z() < 3; });
    ASSERT_EQ(bottom.size(), 1u);
    ASSERT_EQ(top.size(), 1u);
    ASSERT_EQ(side.size(), 1u);
    EXPECT_EQ((std::set<Index>{*bottom.begin(), *top.begin(), *side.begin()}).size(), 3u);
    test::expect_discs(surface, segmentation); // the side borders itself already
    test::expect_whole_faces(surface, segmentation);
  }
}

TEST(Feature_segmentation, An_open_cylinder_is_one_rolled_chart)
{
  const Surface surface = test::surface_of(test::open_cylinder());
  const Segmentation segmentation = Feature_segmentation().segment(surface);
  EXPECT_EQ(segmentation.number_of_charts, 1u);
  test::expect_discs(surface, segmentation);
}

TEST(Feature_segmentation, To_the_letter_only_whole_charts_are_socks)
{
  // A hat: a flat brim and a high cylinder that is closed on top. As one chart it is no sock, but its upper
  // part is; the cylinder alone is one.
  const Surface hat = test::surface_of(test::lathe({{8, 0}, {1, 0}, {1, 4}, {0, 4.5}}, 32, 12));
  const Surface cap = test::surface_of(test::lathe({{1, 0}, {1, 4}, {0, 4.5}}, 32, 12));
  const auto cuts = [](const Surface& surface, bool is_letter) {
    Segmentation one = test::one_chart(surface);
    std::vector<double> height;
    for (Index t = 0; t < surface.number_of_triangles(); ++t)
      height.push_back(middle(surface, t).z());
    if (is_letter)
      internal::cut_socks_from_seeds(surface, default_sock_ratio, height, one, Execution());
    else
      internal::cut_socks(surface, default_sock_ratio, one, Execution());
    double highest = 0;
    for (Index h = 0; h < one.cut.size(); ++h)
      if (one.cut[h])
        highest = std::max(highest, surface.point(h).z());
    return std::pair(std::count(one.cut.begin(), one.cut.end(), 1), highest);
  };
  EXPECT_GT(cuts(hat, false).first, 0);
  EXPECT_EQ(cuts(hat, true).first, 0);
  EXPECT_GT(cuts(cap, true).first, 0);
  EXPECT_NEAR(cuts(cap, true).second, 4.5, 0.1); // from the seed, the highest triangle
}

TEST(Feature_segmentation, A_featureless_ellipsoid_is_two_caps)
{
  const Surface surface = test::surface_of(test::ellipsoid(2));
  Segmentation segmentation = Feature_segmentation().segment(surface);
  EXPECT_EQ(segmentation.number_of_charts, 2u);
  const auto north = charts_where(surface, segmentation, [](const Point_3& p) { return p.z() > 0.5; });
  const auto south = charts_where(surface, segmentation, [](const Point_3& p) { return p.z() < -0.5; });
  EXPECT_EQ(north.size(), 1u);
  EXPECT_EQ(south.size(), 1u);
  EXPECT_NE(north, south);
  test::expect_discs(surface, segmentation);
}

TEST(Feature_segmentation, A_noisy_cube_has_six_sides)
{
  const Index n = 24;
  const Surface surface = test::surface_of(test::noisy_cube(n, 0.3 / n));
  Feature_segmentation model;
  model.features.normal_filter_rounds = 5;
  const Segmentation segmentation = model.segment(surface);
  EXPECT_EQ(segmentation.number_of_charts, 6u);
  std::map<std::pair<Index, Index>, int> count; // (side, chart)
  for (Index t = 0; t < segmentation.chart.size(); ++t)
    ++count[{t / (2 * n * n), segmentation.chart[t]}];
  std::set<Index> majorities;
  for (const auto& [key, number] : count)
    if (number > static_cast<int>(2 * n * n * 9 / 10))
      majorities.insert(key.second);
  EXPECT_EQ(majorities.size(), 6u);
  // Normals are filtered, places never: charts lie where the noise is.
  for (const Chart& chart : extract_charts(surface, segmentation))
    for (std::size_t t = 0; t < chart.triangles.size(); ++t)
      for (Index i = 0; i < 3; ++i)
        ASSERT_EQ(chart.points[chart.triangles[t][i]], surface.point(3 * chart.source[t] + i));
}

TEST(Feature_segmentation, Noise_alone_does_not_make_thousands_of_charts)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(0, 0.02);
  const Surface surface =
      test::surface_of(test::grid(60, 60, [&](double x, double y) { return Point_3(x, y, noise(random)); }));
  EXPECT_LT(Feature_segmentation().segment(surface).number_of_charts, 40u);
}

TEST(Feature_segmentation, Limits_on_number_and_size)
{
  const Surface surface = test::surface_of(test::noisy_cube(20, 0));
  Feature_segmentation model;
  EXPECT_EQ(model.segment(surface).number_of_charts, 6u);
  for (const std::size_t most : {5u, 3u, 1u}) {
    model.max_charts = most;
    EXPECT_EQ(model.segment(surface).number_of_charts, most);
  }
  model.max_charts = 0;
  model.min_chart_area = 0.2; // a sixth is less, a third is more
  EXPECT_LE(model.segment(surface).number_of_charts, 3u);
  EXPECT_GE(model.segment(surface).number_of_charts, 2u);
  model.min_chart_area = 0;
  model.min_chart_triangles = 801;
  EXPECT_LE(model.segment(surface).number_of_charts, 3u);
}

TEST(Feature_segmentation, Constraints_patches_and_quads_then_discs)
{
  Surface surface = test::surface_of(test::capped_cylinder(true));
  surface.patch.assign(surface.number_of_triangles(), 0);
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  for (Index t = 0; t < surface.patch.size(); ++t)
    surface.patch[t] = surface.face[t] % 48 < 20; // a wedge, through the lids and the side
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.point(h).z() == 1.5 && surface.point(next_halfedge(h)).z() == 1.5)
      surface.constraint[h] = Edge_constraint::seam;
  Segmentation segmentation = Feature_segmentation().segment(surface);
  test::expect_constraints(surface, segmentation);
  test::expect_whole_faces(surface, segmentation);
  cut_to_discs(surface, segmentation);
  test::expect_discs(surface, segmentation);
}

TEST(Feature_segmentation, Scale_does_not_matter)
{
  test::Soup soup = test::glove();
  const Segmentation reference = Feature_segmentation().segment(test::surface_of(soup));
  for (const double scale : {0x1p-100, 0x1p-20, 0x1p20, 0x1p100}) {
    test::Soup scaled = soup;
    for (Point_3& p : scaled.points)
      p = Point_3(p.x() * scale, p.y() * scale, p.z() * scale);
    const Segmentation segmentation = Feature_segmentation().segment(test::surface_of(scaled));
    EXPECT_EQ(segmentation.chart, reference.chart);
    EXPECT_EQ(segmentation.cut, reference.cut);
  }
}

TEST(Feature_segmentation, Everything_small)
{
  const std::vector<test::Soup> soups{{},
                                      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
                                      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}},
                                      {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 1, 2}}},
                                      test::cube(),
                                      test::sphere(0)};
  for (const test::Soup& soup : soups) {
    const Surface surface = test::surface_of(soup);
    Segmentation segmentation = Feature_segmentation().segment(surface);
    cut_to_discs(surface, segmentation);
    test::expect_discs(surface, segmentation);
  }
}

TEST(Feature_segmentation, Cancelled_it_returns_something_of_the_right_size)
{
  const Surface surface = test::surface_of(test::glove());
  const Execution execution(1, [](double) { return false; });
  const Segmentation segmentation = Feature_segmentation().segment(surface, execution);
  EXPECT_TRUE(execution.is_cancelled());
  EXPECT_EQ(segmentation.chart.size(), surface.number_of_triangles());
  EXPECT_EQ(segmentation.cut.size(), surface.opposite.size());
}

TEST(Patch_segmentation, Takes_charts_as_they_are)
{
  Surface surface = test::surface_of(test::cube());
  const Segmentation whole = Patch_segmentation().segment(surface);
  EXPECT_EQ(whole.number_of_charts, 1u);
  const Segmentation given = Patch_segmentation({7, 7, 3, 3, 3, 9}).segment(surface);
  EXPECT_EQ(given.number_of_charts, 3u);
  EXPECT_EQ(given.chart, (std::vector<Index>{1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2}));
  surface.patch.assign(12, 5);
  surface.patch[0] = surface.patch[1] = 1;
  EXPECT_EQ(Patch_segmentation().segment(surface).chart,
            (std::vector<Index>{0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(Patch_segmentation({4}).segment(surface).number_of_charts, 2u); // the other faces: one more
}

} // namespace
} // namespace Atlas
