// SPDX-License-Identifier: MIT
// How charts stand on the page: parallel to its axes, upright, and on borders of texels.
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/internal/shapes/chart_poses.h>
#include <Atlas/packing/internal/shapes/dominant_direction.h>
#include <Atlas/packing/internal/shapes/up_direction.h>
#include <Atlas/packing/pack_charts.h>

#include "packing_cases.h"
#include "test_charts.h"
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

namespace Atlas {
namespace {

using namespace test;
using internal::Vec2;

Page_options page_of(Index size)
{
  Page_options page;
  page.width = page.height = size;
  return page;
}

std::optional<Vec2> direction_of(const Chart& chart)
{
  return internal::dominant_direction(
      internal::outlines_of(std::vector<Chart>{chart}, Execution(1)).charts[0]);
}

/// An L whose arms are 1 wide.
Chart angle_chart(double length)
{
  return flat_chart({{0, 0}, {length, 0}, {length, 1}, {1, 1}, {1, length}, {0, length}},
                    {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
}

/// The wall of a house: a rectangle with a triangle on it.
Chart gable_chart()
{
  return flat_chart({{0, 0}, {3, 0}, {3, 2}, {1.5, 3}, {0, 2}}, {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}});
}

/// The least angle by which a border edge of a chart is off the axes of the page, of those that are parallel
/// to an axis in the chart's own plane.
double worst_angle(const Chart& chart, double angle, const Placement& placement)
{
  double worst = 0;
  for (const auto& triangle : chart.triangles)
    for (Index i = 0; i < 3; ++i) {
      const Point_2 a = chart.uv[triangle[i]], b = chart.uv[triangle[(i + 1) % 3]];
      const Vector_2 d = b - a, e = placement(b) - placement(a);
      const double own = std::atan2(d.y(), d.x()) - angle, quarter = M_PI / 2;
      if (std::abs(std::remainder(own, quarter)) < 1e-6)
        worst = std::max(worst, std::abs(std::remainder(std::atan2(e.y(), e.x()), quarter)));
    }
  return worst;
}

TEST(DominantDirection, IsThatOfStraightSidesToTheLastDigits)
{
  for (const double angle : {0.0, 0.3, 0.7, 1.1, 2.0})
    for (const Chart& shape : {rectangle_chart(3, 1), rectangle_chart(1, 1), angle_chart(4), gable_chart()}) {
      const std::optional<Vec2> found = direction_of(moved(shape, 2, angle, 5, -7));
      ASSERT_TRUE(found);
      EXPECT_NEAR(std::remainder(std::atan2(found->y, found->x) - angle, M_PI / 2), 0, 1e-14);
    }
}

TEST(DominantDirection, FewCrookedSidesDoNotSpoilIt)
{
  // Two of the sides are off by a fifth of a degree: the direction is that of the others.
  const Chart chart =
      flat_chart({{0, 0}, {4, 0}, {4, 1}, {2, 1.007}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  const std::optional<Vec2> found = direction_of(chart);
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::remainder(std::atan2(found->y, found->x), M_PI / 2), 0, 1e-14);
}

TEST(DominantDirection, RoundAndCrookedChartsHaveNone)
{
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i)
    EXPECT_FALSE(direction_of(blob_chart(random, 1)));
  EXPECT_FALSE(direction_of(ring_chart(1, 2)));
  EXPECT_FALSE(direction_of(flat_chart({{0, 0}, {3, 0}, {1, 2}}, {{0, 1, 2}})));
  EXPECT_FALSE(direction_of(flat_chart({{0, 0}, {0, 0}, {0, 0}}, {{0, 1, 2}})));
  // The longest side has nearly half of the border, but it is only one.
  EXPECT_FALSE(direction_of(flat_chart({{0, 0}, {3, 0}, {1.2, 0.6}}, {{0, 1, 2}})));
}

/// Straight charts turned at random, and round ones.
struct Turned_charts
{
  std::vector<Chart> charts;
  std::vector<std::optional<double>> angles;

  explicit Turned_charts(unsigned seed)
  {
    std::mt19937 random(seed);
    for (int i = 0; i < 24; ++i) {
      const double size = 1 + static_cast<double>(random() % 100) / 50;
      const double angle = static_cast<double>(random() % 628) / 100;
      const Chart shape = i % 4 == 0   ? rectangle_chart(size, 1.5)
                          : i % 4 == 1 ? angle_chart(1 + size)
                          : i % 4 == 2 ? gable_chart()
                                       : blob_chart(random, size);
      charts.push_back(moved(shape, 1, angle, 0, 0));
      angles.push_back(i % 4 == 3 ? std::nullopt : std::optional(angle));
    }
  }
};

TEST(AlignedCharts, LieParallelToThePageAndOthersAsTheyLike)
{
  const Turned_charts set(3);
  const auto pack = [&](const auto& packer, Chart_rotation rotation) {
    Page_options page = page_of(512);
    page.rotation = rotation;
    return packer.pack(set.charts, page, Execution(1)).placements;
  };
  for (const Chart_rotation rotation : {Chart_rotation::aligned, Chart_rotation::any})
    for (const auto& placements : {pack(Raster_packer(), rotation), pack(Horizon_packer(), rotation)})
      for (std::size_t i = 0; i < set.charts.size(); ++i) {
        if (set.angles[i]) {
          EXPECT_LT(worst_angle(set.charts[i], *set.angles[i], placements[i]), 1e-13) << i;
        }
      }
  int turned = 0;
  const auto placements = pack(Raster_packer(), Chart_rotation::aligned);
  for (std::size_t i = 3; i < set.charts.size(); i += 4)
    turned += std::abs(placements[i].a * placements[i].b) > 1e-3;
  EXPECT_GT(turned, 3);
}

TEST(AlignedCharts, GiveThatUpOnlyForAFullerPage)
{
  // A long rectangle alone is larger on the diagonal.
  const std::vector<Chart> charts{moved(rectangle_chart(20, 1), 1, 0.4, 0, 0)};
  Page_options page = page_of(256);
  const Packing aligned = Raster_packer().pack(charts, page, Execution(1));
  page.rotation = Chart_rotation::any;
  const Packing free = Raster_packer().pack(charts, page, Execution(1));
  EXPECT_LT(worst_angle(charts[0], 0.4, aligned.placements[0]), 1e-13);
  EXPECT_GT(worst_angle(charts[0], 0.4, free.placements[0]), 0.5);
  EXPECT_GT(free.density, 1.2 * aligned.density);
}

TEST(UpDirection, IsTheMeanThroughTheMap)
{
  // A wall: u along x, v along z, turned by 0.7, scaled by 3.
  Chart wall = moved(rectangle_chart(2, 1), 3, 0.7, 1, 1);
  const Chart flat = rectangle_chart(2, 1);
  for (std::size_t i = 0; i < wall.points.size(); ++i)
    wall.points[i] = Point_3(flat.uv[i].x(), 0, flat.uv[i].y());
  const std::optional<Vec2> up = internal::mean_direction(wall, Vector_3(0, 0, 1));
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->x, -std::sin(0.7), 1e-14);
  EXPECT_NEAR(up->y, std::cos(0.7), 1e-14);
  EXPECT_FALSE(internal::mean_direction(wall, Vector_3(0, 1, 0))); // it faces that way
  // A pitched roof: what is up in it is its steepest direction.
  for (std::size_t i = 0; i < wall.points.size(); ++i)
    wall.points[i] = Point_3(flat.uv[i].x(), flat.uv[i].y() * 0.8, flat.uv[i].y() * 0.6);
  const std::optional<Vec2> slope = internal::mean_direction(wall, Vector_3(0, 0, 1));
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->y, std::cos(0.7), 1e-14);
}

TEST(UprightCharts, StandAsTheyDoInSpace)
{
  std::mt19937 random(8);
  std::vector<Chart> charts;
  for (int i = 0; i < 8; ++i) {
    const Chart flat = i < 4 ? rectangle_chart(1 + i, 2) : blob_chart(random, 1);
    Chart chart = moved(flat, 1, 0.9 * i + 0.2, 0, 0);
    for (std::size_t k = 0; k < chart.points.size(); ++k) // the last two face up
      chart.points[k] = i % 4 == 3 ? Point_3(flat.uv[k].x(), flat.uv[k].y(), 0)
                                   : Point_3(flat.uv[k].x(), 0, flat.uv[k].y());
    charts.push_back(chart);
  }
  Page_options page = page_of(256);
  page.up = {0, 0, 2};
  const Packing packing = Raster_packer().pack(charts, page, Execution(1));
  ASSERT_EQ(packing.number_of_pages, 1u);
  for (int i = 0; i < 8; ++i)
    if (i % 4 != 3) { // turned back by the angle of the chart
      const Placement& p = packing.placements[i];
      EXPECT_NEAR(std::remainder(std::atan2(p.b, p.a) + 0.9 * i + 0.2, 2 * M_PI), 0, 1e-12) << i;
    }
  EXPECT_LT(worst_angle(charts[3], 0.9 * 3 + 0.2, packing.placements[3]), 1e-13);
}

/// How far a coordinate is from a border of texels.
double off_texel(double x)
{
  return std::abs(x - std::round(x));
}

TEST(SnappedCharts, HaveTheirBordersOnTexelsAndKeepTheGutter)
{
  std::mt19937 random(2);
  std::vector<Chart> charts;
  for (int i = 0; i < 20; ++i)
    charts.push_back(moved(rectangle_chart(1 + static_cast<double>(random() % 100) / 30, 1), 1, i, 0, 0));
  charts.push_back(moved(rectangle_chart(0.05, 0.03), 1, 1, 0, 0)); // of a few texels
  Page_options page = page_of(512);
  const Packing plain = Raster_packer().pack(charts, page, Execution(1));
  page.snaps = true;
  const Packing snapped = Raster_packer().pack(charts, page, Execution(1));
  EXPECT_NEAR(snapped.gutter, page.gutter, 1e-12);
  double worst_without = 0;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Placement& p = snapped.placements[i];
    EXPECT_LE(std::abs(p.stretch_x - 1), max_snap_stretch);
    EXPECT_LE(std::abs(p.stretch_y - 1), max_snap_stretch);
    for (const Point_2& corner : charts[i].uv) {
      const Point_2 texel = p(corner), before = plain.placements[i](corner);
      worst_without = std::max({worst_without, off_texel(before.x()), off_texel(before.y())});
      if (i + 1 < charts.size()) {
        EXPECT_LT(off_texel(texel.x()), 1e-9) << i;
        EXPECT_LT(off_texel(texel.y()), 1e-9) << i;
      }
    }
  }
  EXPECT_GT(worst_without, 0.3);
  const Packing_clearance clearance = packing_clearance(charts, snapped, page, 4);
  EXPECT_GE(clearance.charts, page.gutter - 1e-4);
  EXPECT_GE(clearance.border, page.gutter / 2 - 1e-4);
  EXPECT_GT(snapped.density, 0.92 * plain.density);
}

TEST(SnappedCharts, GroupsMoveAsOne)
{
  std::vector<Chart> charts;
  for (int i = 0; i < 6; ++i)
    charts.push_back(rectangle_chart(1, 1 + i));
  Page_options page = page_of(256);
  page.snaps = true;
  page.stacking = Chart_stacking::copies;
  charts.push_back(moved(charts[2], 1, 0.5, 0, 0));
  page.groups = {0, 0, no_index, no_index, no_index, no_index, no_index};
  const Packing packing = Raster_packer().pack(charts, page, Execution(1));
  const Placement &a = packing.placements[0], &b = packing.placements[1];
  EXPECT_EQ(a.stretch_x, b.stretch_x);
  EXPECT_EQ(a.stretch_y, b.stretch_y);
  EXPECT_NEAR(a.x, b.x, 1e-9);
  EXPECT_NEAR(a.y, b.y, 1e-9);
  EXPECT_EQ(packing.layers[6], 1u);
  EXPECT_EQ(packing.placements[2].stretch_x, packing.placements[6].stretch_x);
}

} // namespace
} // namespace Atlas
