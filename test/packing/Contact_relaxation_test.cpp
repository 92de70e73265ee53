// SPDX-License-Identifier: MIT
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/packing/internal/raster/raster_layout.h>
#include <Atlas/packing/internal/search/Contact_relaxation.h>

#include "test_charts.h"
#include <cmath>
#include <random>
#include <vector>

namespace Atlas::internal {
namespace {

constexpr double side = 128; ///< of the page

/// Squares of one unit on a page with a square of 40 texels in its middle that does not move; they overlap
/// it.
struct Around_an_obstacle : testing::Test
{
  Outlines outlines = outlines_of(std::vector<Chart>(3, test::rectangle_chart(1, 1)), Execution(1));
  Obstacles obstacles;
  std::vector<Packing_shape> shapes;
  Shape_layout layout{20, std::vector<Vec2>(4, Vec2{1, 0}), {{40, 64}, {64, 90}, {88, 70}}};
  const Relaxation_options options{side, side, 2, 1, 0.01, 1};

  Around_an_obstacle()
  {
    obstacles.add(test::rectangle_chart(40, 40), Placement{1, 0, 44, 44});
    for (Outline& outline : outlines.charts) {
      outline.rotation = Chart_rotation::none; // keeps the frame
      shapes.push_back(packing_shape(outline, {0.001, 0.02, 0.02, 0.15, 20}));
      shapes.back().rotation = Chart_rotation::any;
    }
    shapes.push_back(packing_shape(obstacles.outlines[0], {0.01, 0.5, 0.5, 3, 20}));
    layout.positions.push_back(obstacles.outlines[0].centre);
  }

  bool is_clear(const Shape_layout& found, double margin) const
  {
    return keeps_margin(outlines, {found.scale, margin, found.turns, found.positions}, margin, obstacles,
                        side, side);
  }
};

TEST_F(Around_an_obstacle, shapes_move_and_the_obstacle_does_not)
{
  Contact_relaxation relaxation(shapes, options);
  relaxation.assign(layout);
  ASSERT_FALSE(is_clear(layout, 0));
  ASSERT_TRUE(relaxation.relax(200));
  EXPECT_TRUE(is_clear(relaxation.layout(), 0.99));
  EXPECT_EQ(relaxation.layout().positions[3], layout.positions[3]);
  EXPECT_EQ(relaxation.layout().turns[3], layout.turns[3]);
}

TEST_F(Around_an_obstacle, shapes_grow_and_the_obstacle_does_not)
{
  Contact_relaxation relaxation(shapes, options);
  relaxation.assign(layout);
  ASSERT_TRUE(relaxation.relax(200));
  relaxation.set_scale(30); // of the 41 texels that the obstacle leaves beside it
  EXPECT_TRUE(relaxation.relax(400));
  EXPECT_TRUE(is_clear(relaxation.layout(), 0.99));
  EXPECT_EQ(relaxation.layout().positions[3], layout.positions[3]);
}

/// Bars that are 30 times as long as wide, on a page without obstacles.
struct Bars
{
  Outlines outlines;
  std::vector<Packing_shape> shapes;
  const Relaxation_options options{side, side, 2, 1, 0.01, 0};

  explicit Bars(std::size_t number)
      : outlines(outlines_of(std::vector<Chart>(number, test::rectangle_chart(3, 0.1)), Execution(1)))
  {
    for (Outline& outline : outlines.charts) {
      outline.rotation = Chart_rotation::none; // keeps the frame
      shapes.push_back(packing_shape(outline, {0.001, 0.02, 0.02, 0.15, 20}));
      shapes.back().rotation = Chart_rotation::any;
    }
  }
};

TEST(Contact_relaxation, long_shapes_side_by_side_are_passed_over)
{
  const Bars bars(2);
  const Vec2 slanted{std::cos(0.6), std::sin(0.6)};
  Contact_relaxation relaxation(bars.shapes, bars.options);
  relaxation.assign({20, {slanted, slanted}, {{64, 61}, {64, 67}}});
  EXPECT_TRUE(relaxation.relax(1));
  EXPECT_LT(relaxation.work(), 100u); // their circles overlap, and no sample has been looked at
}

TEST(Contact_relaxation, long_shapes_across_each_other_are_pushed_apart)
{
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const Bars bars(8);
  int apart = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Shape_layout layout{20, {}, {}};
    for (std::size_t i = 0; i < bars.shapes.size(); ++i) {
      const double angle = 6.28 * uniform();
      layout.turns.push_back({std::cos(angle), std::sin(angle)});
      layout.positions.push_back({64 + 40 * (uniform() - 0.5), 64 + 40 * (uniform() - 0.5)});
    }
    Contact_relaxation relaxation(bars.shapes, bars.options);
    relaxation.assign(layout);
    if (!relaxation.relax(400))
      continue;
    ++apart;
    const Shape_layout& found = relaxation.layout();
    EXPECT_TRUE(keeps_margin(bars.outlines, {found.scale, 0.99, found.turns, found.positions}, 0.99,
                             Obstacles(), side, side));
  }
  EXPECT_GE(apart, 3);
}

TEST(Packing_search, starts_as_one_with_the_same_order)
{
  std::vector<Chart> charts;
  for (const double size : {3.0, 2.0, 1.0})
    charts.push_back(test::rectangle_chart(size, size));
  const Execution one(1);
  const Outlines outlines = outlines_of(charts, one);
  Page_task page;
  page.width = page.height = 256;
  page.gutter = 2;
  page.margin = 1;
  const std::optional<Layout> fallback = horizon_layout(outlines, page, Horizon_source::outline, one);
  ASSERT_TRUE(fallback);
  const Packing_problem problem =
      packing_problem(outlines, Obstacles(), page, *fallback, Search_budget(), one);
  Packing_search first(problem, 0), same(problem, 1), copy(problem, 1);
  ASSERT_TRUE(same.starts_like(first));
  first.start(one);
  same.start(one);
  copy.start_like(first);
  EXPECT_GT(first.best().scale, fallback->scale);
  for (const Packing_search* search : {&same, &copy}) {
    EXPECT_EQ(search->best().scale, first.best().scale);
    EXPECT_EQ(search->best().positions, first.best().positions);
    EXPECT_EQ(search->work(), first.work());
  }
  same.explore(same.work() + 2'000'000, one);
  copy.explore(copy.work() + 2'000'000, one);
  EXPECT_EQ(same.best().scale, copy.best().scale);
  EXPECT_EQ(same.best().positions, copy.best().positions);
}

} // namespace
} // namespace Atlas::internal
