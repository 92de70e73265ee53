// SPDX-License-Identifier: MIT
// Fragments of refused charts that find other charts.
#include <Atlas/core/extract_charts.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/segmentation/internal/rejoining/Fragment_merger.h>
#include <Atlas/segmentation/internal/rejoining/Trial_merge.h>
#include <Atlas/validation/Exact_validator.h>

#include "segmentation_checks.h"
#include "test_meshes.h"
#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <set>

namespace Atlas::test {
namespace {

constexpr Index cells = 8;

Point_3 centre(const Surface& surface, Index t)
{
  return CGAL::centroid(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2));
}

/// Charts of a grid of 8 x 8 cells over the unit square, told by the column and row of the cell.
Segmentation charts_by_cell(const Surface& surface, Index charts,
                            const std::function<Index(int, int)>& chart_of)
{
  Segmentation segmentation = one_chart(surface);
  for (Index t = 0; t < surface.number_of_triangles(); ++t) {
    const Point_3 p = centre(surface, t);
    segmentation.chart[t] = chart_of(static_cast<int>(p.x() * cells), static_cast<int>(p.y() * cells));
  }
  segmentation.number_of_charts = charts;
  return segmentation;
}

bool equal(const Segmentation& a, const Segmentation& b)
{
  return a.chart == b.chart && a.cut == b.cut;
}

TEST(Trial_merge, prefers_long_borders_and_makes_discs)
{
  // A bar in the middle, with 6 edges to the chart below and 2 to each of the others.
  const Surface surface = surface_of(planar_grid(cells, cells));
  Segmentation segmentation = charts_by_cell(surface, 4, [](int x, int y) -> Index {
    return y == 0 || y > 2 ? (y == 0 ? 1 : 2) : x < 6 ? 0 : 3;
  });
  const Segmentation before = segmentation;
  internal::Trial_merge trial(surface, segmentation);
  const Chart bar = extract_charts(surface, segmentation)[0];
  EXPECT_EQ(trial.neighbours(bar), (std::vector<Index>{1, 2, 3}));
  for (const Index other : {1u, 2u, 3u}) {
    trial.merge(bar, other);
    const Chart joined = extract_charts(surface, segmentation)[other];
    EXPECT_EQ(joined.number_of_triangles(),
              bar.number_of_triangles() + extract_charts(surface, before)[other].number_of_triangles());
    EXPECT_TRUE(topology(joined).is_disc());
    trial.undo(bar);
    EXPECT_TRUE(equal(segmentation, before));
  }
}

TEST(Trial_merge, leaves_a_cut_where_charts_touch_twice)
{
  // A lid on a U: the lid touches both arms and closes a hole around a third chart.
  const Surface surface = surface_of(planar_grid(cells, cells));
  Segmentation segmentation = charts_by_cell(surface, 3, [](int x, int y) -> Index {
    return y == 7 ? 0 : x >= 2 && x < 5 && y > 2 ? 2 : 1;
  });
  const Chart lid = extract_charts(surface, segmentation)[0];
  const Segmentation before = segmentation;
  internal::Trial_merge trial(surface, segmentation);
  EXPECT_EQ(trial.neighbours(lid), (std::vector<Index>{1, 2}));
  trial.merge(lid, 1);
  const Chart joined = extract_charts(surface, segmentation)[1];
  EXPECT_TRUE(topology(joined).is_disc());
  Index cut = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    cut += segmentation.cut[h] && surface.opposite[h] != no_index &&
           segmentation.chart[h / 3] == segmentation.chart[surface.opposite[h] / 3];
  EXPECT_EQ(cut, 2u * 2) << "both sides of the two edges to the thinner arm";
  trial.undo(lid);
  EXPECT_TRUE(equal(segmentation, before));
}

TEST(Trial_merge, fills_the_hole_of_a_slit_ring)
{
  const Surface surface = surface_of(planar_grid(cells, cells));
  Segmentation segmentation = charts_by_cell(
      surface, 2, [](int x, int y) -> Index { return x >= 2 && x < 6 && y >= 2 && y < 6 ? 0 : 1; });
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Point_3 p = surface.point(h), q = surface.point(next_halfedge(h));
    if (p.y() == 0.5 && q.y() == 0.5 && std::max(p.x(), q.x()) <= 0.25)
      segmentation.cut[h] = 1;
  }
  const std::vector<Chart> charts = extract_charts(surface, segmentation);
  ASSERT_TRUE(topology(charts[1]).is_disc());
  internal::Trial_merge trial(surface, segmentation);
  trial.merge(charts[0], 1);
  segmentation.number_of_charts = 2;
  EXPECT_TRUE(topology(extract_charts(surface, segmentation)[1]).is_disc());
}

TEST(Trial_merge, stops_where_a_third_chart_comes_between_in_a_vertex)
{
  // The third chart hangs from the middle of the straight border between the other two.
  const Surface surface = surface_of(planar_grid(cells, cells));
  Segmentation segmentation = charts_by_cell(surface, 3, [](int, int y) -> Index { return y < 4 ? 0 : 1; });
  const auto corners = [&](Index t, const std::function<bool(const Point_3&)>& where) {
    return where(surface.point(3 * t)) + where(surface.point(3 * t + 1)) + where(surface.point(3 * t + 2));
  };
  Index third = 0;
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    if (segmentation.chart[t] == 1 && corners(t, [](const Point_3& p) { return p.y() == 0.5; }) == 1 &&
        corners(t, [](const Point_3& p) { return p == Point_3(0.5, 0.5, 0); }) == 1) {
      segmentation.chart[t] = 2;
      ++third;
    }
  ASSERT_EQ(third, 1u);
  const std::vector<Chart> charts = extract_charts(surface, segmentation);
  ASSERT_TRUE(topology(charts[1]).is_disc());
  internal::Trial_merge(surface, segmentation).merge(charts[0], 1);
  EXPECT_TRUE(topology(extract_charts(surface, segmentation)[1]).is_disc());
}

TEST(Trial_merge, respects_seams_and_patches)
{
  Surface surface = surface_of(planar_grid(cells, cells));
  Segmentation segmentation = charts_by_cell(surface, 3, [](int x, int) -> Index {
    return x < 3 ? 1 : x < 5 ? 0 : 2;
  });
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  surface.patch.assign(surface.number_of_triangles(), 0);
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    if (o != no_index && segmentation.chart[h / 3] + segmentation.chart[o / 3] == 1 &&
        segmentation.chart[h / 3] != segmentation.chart[o / 3])
      surface.constraint[h] = Edge_constraint::seam;
    surface.patch[h / 3] = segmentation.chart[h / 3] == 2;
  }
  const Chart middle = extract_charts(surface, segmentation)[0];
  EXPECT_TRUE(internal::Trial_merge(surface, segmentation).neighbours(middle).empty());
  surface.patch.clear();
  EXPECT_EQ(internal::Trial_merge(surface, segmentation).neighbours(middle), std::vector<Index>{2});
  surface.constraint.clear();
  EXPECT_EQ(internal::Trial_merge(surface, segmentation).neighbours(middle), (std::vector<Index>{1, 2}));
}

/// Keeps two corners of the unit square out of one chart, by cutting strips: more than needed.
struct Corners_apart
{
  int strips = 8;

  static bool has_corner(const Chart& chart, double x)
  {
    return std::any_of(chart.points.begin(), chart.points.end(),
                       [&](const Point_3& p) { return std::abs(p.x() - x) < 1e-9; });
  }
  Chart_verdict validate(const Chart& chart, const Execution& execution) const
  {
    // The pipeline moves the model so that the origin is in the middle, and scales it by a power of two: here
    // to a width of 2.
    if (has_corner(chart, -1) && has_corner(chart, 1))
      return {Chart_status::area_ratio_exceeded, {}};
    return Exact_validator(0).validate(chart, execution);
  }
  std::vector<Index> split(const Chart& chart, const Chart_verdict&) const
  {
    std::vector<Index> part;
    for (const auto& [a, b, c] : chart.triangles)
      part.push_back(static_cast<Index>(
          (CGAL::centroid(chart.points[a], chart.points[b], chart.points[c]).x() + 1) / 2 * strips));
    return part;
  }
};
static_assert(ChartValidator<Corners_apart> && ChartSplitter<Corners_apart>);

Atlas_report atlas_in_strips(unsigned threads, std::vector<Point_2>& uv)
{
  const Surface surface = surface_of(planar_grid(cells, cells));
  return generate_atlas(surface, uv,
                        parameters::segmentation(Patch_segmentation())
                            .validator(Corners_apart())
                            .packer(Rectangle_packer())
                            .number_of_threads(threads));
}

TEST(Fragment_merger, makes_no_more_charts_of_strips_than_the_validator_needs)
{
  std::vector<Point_2> uv;
  const Atlas_report report = atlas_in_strips(1, uv);
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.split_charts, 1u);
  EXPECT_EQ(report.charts.size(), 2u);
  EXPECT_EQ(report.rejoined_pieces, 6u);
  EXPECT_EQ(std::set<Index>(report.face_chart.begin(), report.face_chart.end()), (std::set<Index>{0, 1}));
  std::size_t triangles = 0;
  for (const Chart_report& chart : report.charts)
    triangles += chart.triangles;
  EXPECT_EQ(triangles, 2u * cells * cells);
}

TEST(Fragment_merger, does_not_depend_on_threads)
{
  std::vector<Point_2> one, four;
  const Atlas_report a = atlas_in_strips(1, one);
  const Atlas_report b = atlas_in_strips(4, four);
  EXPECT_EQ(a.face_chart, b.face_chart);
  EXPECT_EQ(one, four);
}

TEST(Fragment_merger, takes_back_what_is_not_accepted)
{
  const Surface surface = surface_of(planar_grid(cells, cells));
  Segmentation segmentation =
      charts_by_cell(surface, 4, [](int x, int y) -> Index { return x / 4 + 2 * (y / 4); });
  const Segmentation before = segmentation;
  std::vector<internal::Flattened_chart> charts;
  for (Chart& chart : extract_charts(surface, segmentation))
    charts.push_back({std::move(chart), {}, {}});
  std::size_t attempts = 0;
  const auto flatten = [&](Chart chart) {
    ++attempts;
    return internal::Flattened_chart{std::move(chart), {}, {}};
  };
  const auto never = [](const auto&, const auto&, const auto&) { return false; };
  const std::size_t joined =
      internal::Fragment_merger(surface, segmentation, charts, flatten, never, 5, Execution(1)).run({0, 3});
  EXPECT_EQ(joined, 0u);
  EXPECT_GE(attempts, 4u) << "each fragment has two neighbours";
  EXPECT_TRUE(equal(segmentation, before));
  for (Index c = 0; c < 4; ++c)
    EXPECT_EQ(charts[c].chart.number_of_triangles(), 2u * cells * cells / 4);
}

TEST(Fragment_merger, does_not_repeat_what_it_refused)
{
  const Surface surface = surface_of(planar_grid(cells, cells));
  Segmentation segmentation =
      charts_by_cell(surface, 4, [](int x, int y) -> Index { return x / 4 + 2 * (y / 4); });
  std::vector<internal::Flattened_chart> charts;
  for (Chart& chart : extract_charts(surface, segmentation))
    charts.push_back({std::move(chart), {}, {}});
  std::multiset<std::vector<Index>> tried;
  const auto flatten = [&](Chart chart) {
    tried.insert(chart.source);
    return internal::Flattened_chart{std::move(chart), {}, {}};
  };
  // Only the first two join. So there is a second pass, in which the last one has the same neighbours.
  const std::size_t two = 2 * charts[0].chart.number_of_triangles();
  const Index first = charts[0].chart.source.front(), second = charts[1].chart.source.front();
  const auto accept = [&](const internal::Flattened_chart& merged, const auto&, const auto&) {
    const std::vector<Index>& source = merged.chart.source;
    return source.size() == two && std::count(source.begin(), source.end(), first) > 0 &&
           std::count(source.begin(), source.end(), second) > 0;
  };
  EXPECT_EQ(
      internal::Fragment_merger(surface, segmentation, charts, flatten, accept, 5, Execution(1)).run({0, 3}),
      1u);
  EXPECT_EQ(tried.size(), 3u);
  for (const std::vector<Index>& source : tried)
    EXPECT_EQ(tried.count(source), 1u);
}

TEST(Fragment_merger, flattens_a_bounded_number_of_triangles)
{
  // Every cell a fragment: unbounded, each would be tried with all its neighbours.
  const Surface surface = surface_of(planar_grid(40, 40));
  Segmentation segmentation = one_chart(surface);
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    segmentation.chart[t] = t / 2;
  segmentation.number_of_charts = 1600;
  std::vector<internal::Flattened_chart> charts;
  std::vector<Index> fragments;
  for (Chart& chart : extract_charts(surface, segmentation)) {
    fragments.push_back(static_cast<Index>(charts.size()));
    charts.push_back({std::move(chart), {}, {}});
  }
  std::size_t triangles = 0;
  const auto flatten = [&](Chart chart) {
    triangles += chart.number_of_triangles();
    return internal::Flattened_chart{std::move(chart), {}, {}};
  };
  const auto never = [](const auto&, const auto&, const auto&) { return false; };
  internal::Fragment_merger(surface, segmentation, charts, flatten, never, 5, Execution(1)).run(fragments);
  EXPECT_GT(triangles, surface.number_of_triangles());
  EXPECT_LE(triangles, 5 * surface.number_of_triangles());
}

} // namespace
} // namespace Atlas::test
