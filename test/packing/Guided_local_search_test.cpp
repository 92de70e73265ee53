// SPDX-License-Identifier: MIT
#include <Atlas/packing/internal/search/Guided_local_search.h>

#include "test_charts.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace Atlas::internal {
namespace {

std::vector<Coarse_shape> coarse_shapes(const std::vector<Chart>& charts)
{
  Outlines outlines = outlines_of(charts, Execution());
  std::vector<Coarse_shape> result;
  for (Outline& outline : outlines.charts) {
    outline.rotation = Chart_rotation::none; // keeps the frame
    Packing_shape shape = packing_shape(outline, {0.001, 0.01, 0.01, 0.01, 20});
    shape.rotation = Chart_rotation::any;
    result.emplace_back().build(shape, 0.01, 0.3, 48);
  }
  return result;
}

TEST(Coarse_shape, clusters_hold_every_disc_once_and_lie_around_it)
{
  for (const test::Chart_family family : test::all_chart_families)
    for (const Coarse_shape& shape : coarse_shapes(test::random_charts(family, 6, 3))) {
      std::size_t next = 0;
      for (const Coarse_shape::Cluster& cluster : shape.clusters) {
        EXPECT_EQ(cluster.begin, next);
        next = cluster.end;
        for (std::size_t k = cluster.begin; k < cluster.end; ++k) {
          const auto& d = shape.discs[k];
          EXPECT_LE(std::hypot(d.x - cluster.x, d.y - cluster.y) + d.radius, cluster.radius * 1.0001f);
        }
      }
      EXPECT_EQ(next, shape.discs.size());
    }
}

TEST(Coarse_shape, has_the_same_distances_in_another_unit)
{
  for (const test::Chart_family family : test::all_chart_families)
    for (const Coarse_shape& shape : coarse_shapes(test::random_charts(family, 6, 3))) {
      const Coarse_shape twice = shape.scaled(2);
      EXPECT_EQ(twice.radius, 2 * shape.radius);
      EXPECT_EQ(twice.extent(0.3), 2 * shape.extent(0.3));
      for (const float x : {-0.7f, -0.1f, 0.2f})
        for (const float y : {-0.3f, 0.05f, 0.8f})
          EXPECT_NEAR(twice.distance(2 * x, 2 * y), 2 * shape.distance(x, y), 1e-5);
    }
}

TEST(Coarse_shape, slopes_are_those_of_its_distances)
{
  for (const test::Chart_family family : test::all_chart_families)
    for (const Coarse_shape& shape : coarse_shapes(test::random_charts(family, 6, 3))) {
      if (!(shape.radius > 0))
        continue; // a point: its grid is finer than the differences
      std::mt19937 random(1);
      std::uniform_real_distribution<float> coordinate(static_cast<float>(-1.5 * shape.radius),
                                                       static_cast<float>(1.5 * shape.radius));
      constexpr float h = 0x1p-13f;
      int inside = 0, wrong = 0;
      for (int k = 0; k < 400; ++k) {
        const float x = coordinate(random), y = coordinate(random);
        const Coarse_shape::Slope slope = shape.slope(x, y);
        EXPECT_NEAR(slope.distance, shape.distance(x, y), 1e-6);
        if (slope.x == 0 && slope.y == 0)
          continue;
        ++inside;
        const float dx = (shape.distance(x + h, y) - shape.distance(x - h, y)) / (2 * h);
        const float dy = (shape.distance(x, y + h) - shape.distance(x, y - h)) / (2 * h);
        wrong += std::abs(dx - slope.x) > 0.02f || std::abs(dy - slope.y) > 0.02f;
      }
      EXPECT_GT(inside, 40);
      EXPECT_LE(wrong, inside / 10); // those at the sides of cells
    }
}

/// Four unit squares on a page of side 2.1 in any arrangement, at first all in the middle.
Shape_layout pile(double scale)
{
  return {scale, std::vector<Vec2>(4, Vec2{1, 0}), std::vector<Vec2>(4, Vec2{105, 105})};
}

std::vector<Chart> four_squares()
{
  Chart square;
  square.uv = {Point_2(0, 0), Point_2(1, 0), Point_2(1, 1), Point_2(0, 1)};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  return std::vector<Chart>(4, square);
}

TEST(Guided_local_search, spreads_what_has_room_and_tells_what_has_none)
{
  auto shapes = coarse_shapes(four_squares());
  for (Coarse_shape& shape : shapes)
    shape.rotation = Chart_rotation::none;
  Guided_local_search search(shapes, {210, 210, 0, 0}, 1);
  Shape_layout layout = pile(100);
  EXPECT_EQ(search.solve(layout, 40, 100'000'000), 0);
  // One square to each quarter of the page.
  std::array<int, 4> quarters{};
  for (const Vec2& p : layout.positions)
    ++quarters[(p.x > 105 ? 1u : 0u) + (p.y > 105 ? 2u : 0u)];
  EXPECT_EQ(quarters, (std::array<int, 4>{1, 1, 1, 1}));

  layout = pile(130);
  EXPECT_GT(search.solve(layout, 10, search.work() + 100'000'000), 0);
}

TEST(Guided_local_search, goes_around_obstacles)
{
  auto shapes = coarse_shapes(four_squares());
  for (Coarse_shape& shape : shapes)
    shape.rotation = Chart_rotation::none;
  shapes[3] = shapes[3].scaled(100); // in texels
  Guided_local_search search(shapes, {210, 210, 0, 0, 1}, 1);
  Shape_layout layout = pile(100);
  layout.positions[3] = {155, 55};
  EXPECT_EQ(search.solve(layout, 40, 100'000'000), 0);
  EXPECT_EQ(layout.positions[3], (Vec2{155, 55}));
  std::array<int, 4> quarters{};
  for (const Vec2& p : layout.positions)
    ++quarters[(p.x > 105 ? 1u : 0u) + (p.y > 105 ? 2u : 0u)];
  EXPECT_EQ(quarters, (std::array<int, 4>{1, 1, 1, 1}));
}

TEST(Guided_local_search, goes_down_the_slope_of_overlaps)
{
  // The squares cover nearly all of the page: only upright ones fit, and trying at random takes long.
  const auto shapes = coarse_shapes(four_squares());
  std::uint64_t work = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    Guided_local_search search(shapes, {210, 210, 0, 0}, seed);
    Shape_layout layout = pile(104);
    search.solve(layout, 40, 20'000'000);
    work += search.work();
  }
  EXPECT_LT(work, 17'000'000u);
}

} // namespace
} // namespace Atlas::internal
