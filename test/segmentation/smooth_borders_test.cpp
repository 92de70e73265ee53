// SPDX-License-Identifier: MIT
#include <Atlas/core/extract_charts.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/smoothing/minimum_cut.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>
#include <Atlas/segmentation/smooth_borders.h>

#include "segmentation_checks.h"
#include "segmentation_shapes.h"
#include <atomic>
#include <mutex>

namespace Atlas {
namespace {

double border_length(const Surface& surface, const Segmentation& segmentation)
{
  double sum = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && !segmentation.is_glued(surface, h))
      sum += internal::edge_length(surface, h) / 2;
  return sum;
}

/// Charts by a function of the face's first corner.
Segmentation charts_by(const Surface& surface, const std::function<Index(const Point_3&)>& chart)
{
  Segmentation segmentation = test::one_chart(surface);
  std::vector<Index> of_face(surface.number_of_faces, no_index);
  for (Index t = 0; t < segmentation.chart.size(); ++t) {
    Index& c = of_face[surface.face[t]];
    if (c == no_index)
      c = chart(surface.point(3 * t));
    segmentation.chart[t] = c;
  }
  segmentation.number_of_charts = *std::max_element(segmentation.chart.begin(), segmentation.chart.end()) + 1;
  cut_to_discs(surface, segmentation);
  return segmentation;
}

test::Soup sheet(Index n, bool quads)
{
  return test::grid(
      n, n, [](double x, double y) { return Point_3(x, y, 0); }, false, false, quads);
}

Index wavy_halves(const Point_3& p)
{
  return p.x() > 0.5 + 0.06 * std::sin(40 * p.y());
}

TEST(Minimum_cut, A_chain_breaks_at_its_weakest_link)
{
  internal::Minimum_cut cut(4);
  cut.connect(4, 0, 10); // node 4 is one side, node 5 the other
  cut.connect(0, 1, 7);
  cut.connect(1, 2, 3);
  cut.connect(2, 3, 8);
  cut.connect(3, 5, 10);
  EXPECT_EQ(cut.run(), 3);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(cut.is_on_first_side(i), i < 2);
}

TEST(Smooth_borders, A_wavy_border_becomes_straight)
{
  for (const bool quads : {false, true}) {
    const Surface surface = test::surface_of(sheet(40, quads));
    Segmentation segmentation = charts_by(surface, wavy_halves);
    ASSERT_EQ(segmentation.number_of_charts, 2u);
    ASSERT_GT(border_length(surface, segmentation), 1.5);
    EXPECT_GE(smooth_borders(surface, segmentation), 1u);
    EXPECT_NEAR(border_length(surface, segmentation), 1, 1e-9);
    test::expect_discs(surface, segmentation);
  }
}

TEST(Smooth_borders, A_straight_border_stays)
{
  const Surface surface = test::surface_of(sheet(20, true));
  Segmentation segmentation = charts_by(surface, [](const Point_3& p) { return Index(p.x() >= 0.5); });
  const Segmentation before = segmentation;
  EXPECT_EQ(smooth_borders(surface, segmentation), 0u);
  EXPECT_EQ(segmentation.chart, before.chart);
}

TEST(Smooth_borders, Borders_go_to_sharp_edges_and_stay_there)
{
  // A roof with a ridge at x = 0.5; the border wavers around it.
  const Surface surface = test::surface_of(
      test::grid(40, 40, [](double x, double y) { return Point_3(x, y + 0.2 * x, -2 * std::abs(x - 0.5)); }));
  Segmentation segmentation = charts_by(surface, wavy_halves);
  smooth_borders(surface, segmentation);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && !segmentation.is_glued(surface, h)) {
      EXPECT_EQ(surface.point(h).x(), 0.5);
    }
  test::expect_discs(surface, segmentation);
}

TEST(Smooth_borders, Many_random_charts_stay_discs_and_get_shorter)
{
  std::mt19937 random(3);
  for (const test::Soup& soup : {test::sphere(4), test::torus(48, 24), sheet(40, true), test::glove()}) {
    const Surface surface = test::surface_of(soup);
    for (const int charts : {4, 20, 60}) {
      std::vector<Point_3> seeds;
      for (int i = 0; i < charts; ++i)
        seeds.push_back(surface.points[random() % surface.points.size()]);
      Segmentation segmentation = charts_by(surface, [&](const Point_3& p) {
        Index best = 0;
        for (Index i = 0; i < seeds.size(); ++i)
          if (CGAL::squared_distance(p, seeds[i]) < CGAL::squared_distance(p, seeds[best]))
            best = i;
        return best;
      });
      Segmentation parallel = segmentation;
      const Index number = segmentation.number_of_charts;
      const double before = border_length(surface, segmentation);
      EXPECT_GT(smooth_borders(surface, segmentation, {4, 2, 1, 0}), 0u);
      EXPECT_LT(border_length(surface, segmentation), before);
      EXPECT_EQ(segmentation.number_of_charts, number);
      test::expect_discs(surface, segmentation);
      smooth_borders(surface, parallel, {4, 2, 1, 0}, Execution(4));
      EXPECT_EQ(parallel.chart, segmentation.chart);
    }
  }
}

TEST(Smooth_borders, Who_says_no_is_heard_and_sees_discs)
{
  const Surface surface = test::surface_of(sheet(40, false));
  Segmentation segmentation = charts_by(surface, wavy_halves);
  const Segmentation before = segmentation;
  std::size_t calls = 0;
  EXPECT_EQ(smooth_borders(surface, segmentation, {}, Execution(),
                           [&](const Chart& a, const Chart& b) {
                             ++calls;
                             EXPECT_TRUE(topology(a).is_disc());
                             EXPECT_TRUE(topology(b).is_disc());
                             EXPECT_EQ(a.number_of_triangles() + b.number_of_triangles(),
                                       surface.number_of_triangles());
                             return false;
                           }),
            0u);
  EXPECT_EQ(calls, 2u); // one a round
  EXPECT_EQ(segmentation.chart, before.chart);
}

TEST(Smooth_borders, Wishes_are_respected)
{
  Surface surface = test::surface_of(sheet(40, true));
  Segmentation wavy = charts_by(surface, wavy_halves);
  surface.patch.assign(wavy.chart.begin(), wavy.chart.end());
  Segmentation segmentation = wavy;
  EXPECT_EQ(smooth_borders(surface, segmentation), 0u); // patch borders cannot move
  surface.patch.clear();
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && surface.point(h).x() == 0.5 &&
        surface.point(next_halfedge(h)).x() == 0.5)
      surface.constraint[h] = Edge_constraint::no_seam;
  smooth_borders(surface, segmentation);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.constraint[h] == Edge_constraint::no_seam) {
      EXPECT_TRUE(segmentation.is_glued(surface, h));
    }
  EXPECT_LT(border_length(surface, segmentation), border_length(surface, wavy));
}

/// Halves with a wavy border, of a sheet with three triangles to a spike.
struct Wavy_halves
{
  Segmentation segment(const Surface& surface, const Execution&) const
  {
    Segmentation segmentation = test::one_chart(surface);
    for (Index t = 0; t < segmentation.chart.size(); ++t)
      segmentation.chart[t] = wavy_halves(surface.point(9 * (t / 3)));
    segmentation.number_of_charts = 2;
    return segmentation;
  }
};

/// Flattens nothing, and remembers the largest chart that it got.
struct Size_recorder
{
  std::atomic<std::size_t>* largest;

  Chart_status parameterize(Chart& chart, const Execution&) const
  {
    for (std::size_t n = *largest; n < chart.number_of_triangles();)
      if (largest->compare_exchange_weak(n, chart.number_of_triangles()))
        break;
    return Chart_status::flipped;
  }
};

/// Every triangle gets a tip over its middle: no edge can collapse.
test::Soup spikes(const test::Soup& soup, double height)
{
  test::Soup result{soup.points, {}};
  for (const auto& t : soup.polygons) {
    const Point_3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    const auto tip = static_cast<Index>(result.points.size());
    result.points.push_back(CGAL::centroid(a, b, c) + Vector_3(0, 0, height));
    for (std::size_t i = 0; i < 3; ++i)
      result.polygons.push_back({t[i], t[(i + 1) % 3], tip});
  }
  return result;
}

TEST(Merged_segmentation, No_chart_of_many_spikes_is_flattened_for_trial)
{
  std::atomic<std::size_t> largest = 0;
  Merge_options options;
  options.max_trial_triangles = 1000;
  const auto largest_trial = [&](double height) {
    const Surface surface = test::surface_of(spikes(sheet(40, false), height));
    largest = 0;
    const Segmentation result =
        Merged_segmentation(Wavy_halves(), Size_recorder{&largest}, Identity_optimizer(), options)
            .segment(surface, Execution());
    EXPECT_EQ(result.number_of_charts, 2u);
    return largest.load();
  };
  EXPECT_EQ(largest_trial(0.5), 0u);
  // Flat, the same charts become coarse, and are tried.
  EXPECT_GT(largest_trial(0), 0u);
  EXPECT_LE(largest_trial(0), options.max_trial_triangles);
}

} // namespace
} // namespace Atlas
