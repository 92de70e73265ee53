// SPDX-License-Identifier: MIT
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/packing/internal/search/Contact_relaxation.h>

#include "test_charts.h"
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

} // namespace
} // namespace Atlas::internal
