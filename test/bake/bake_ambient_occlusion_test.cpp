// SPDX-License-Identifier: MIT
#include <Atlas/bake/bake_ambient_occlusion.h>

#include "baked_soups.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace Atlas;

namespace {

/// A floor of 1 x 1 in the middle of the lower border of a wall that is much longer and of height `height`.
test::Soup floor_and_wall(double height)
{
  test::Soup soup;
  soup.points = {{0, 0, 0},   {1, 0, 0},  {1, 1, 0},       {0, 1, 0},
                 {-50, 1, 0}, {50, 1, 0}, {50, 1, height}, {-50, 1, height}};
  soup.polygons = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  return soup;
}

const std::vector<Color> white(64 * 64, Color{255, 255, 255}), black(64 * 64, Color{0, 0, 0});

} // namespace

TEST(Bake_ambient_occlusion, nothing_hides_the_outside_of_a_convex_body)
{
  EXPECT_EQ(bake_ambient_occlusion(test::faces_side_by_side(test::cube()), 64).pixels, white);
  EXPECT_EQ(bake_ambient_occlusion(
                test::faces_side_by_side(test::grid(
                    1, 1, [](double x, double y) { return Point_3(x, y, x + y); }, false, false, true)),
                64)
                .pixels,
            white);
}

TEST(Bake_ambient_occlusion, the_inside_of_a_closed_body_sees_nothing)
{
  test::Soup room = test::cube();
  for (auto& polygon : room.polygons)
    std::reverse(polygon.begin(), polygon.end());
  EXPECT_EQ(bake_ambient_occlusion(test::faces_side_by_side(room), 64).pixels, black);
  // Neither turned, nor far from the origin, nor of any size.
  for (Point_3& p : room.points)
    p = Point_3(1e-20 * (p.x() + .3 * p.y() + 1000), 1e-20 * (p.y() - .7 * p.z()),
                1e-20 * (p.z() + .1 * p.x()));
  EXPECT_EQ(bake_ambient_occlusion(test::faces_side_by_side(room), 64).pixels, black);
}

TEST(Bake_ambient_occlusion, of_a_floor_before_a_wall)
{
  const double height = 0.5;
  const Polygon_soup soup = test::faces_side_by_side(floor_and_wall(height));
  const Image image = bake_ambient_occlusion(soup, 64, {.samples = 1024});
  for (std::size_t j = 0; j < 64; ++j)
    for (std::size_t i = 0; i < 64; ++i) {
      const double u = (double(i) + .5) / 64, v = 1 - (double(j) + .5) / 64;
      const double x = (u - .125) * 4, y = (v - .125) * 4; // the floor is on [1/8, 3/8]^2
      if (x < 0 || x > 1 || y < 0 || y > 1)
        continue;
      // The form factor of a strip that stands at a right angle.
      const double d = 1 - y, hidden = (1 - d / std::hypot(d, height)) / 2;
      EXPECT_NEAR(image.at(i, j)[0], 255 * (1 - hidden), 255 * 0.015) << x << ' ' << y;
    }
}

TEST(Bake_ambient_occlusion, what_is_far_away_hides_nothing)
{
  const Polygon_soup soup = test::faces_side_by_side(floor_and_wall(0.5));
  const Image image = bake_ambient_occlusion(soup, 64, {.samples = 64, .distance = 0.3});
  EXPECT_EQ(test::texel_in_face(image, soup, 0, .5, .5), (Color{255, 255, 255}));
  EXPECT_EQ(test::texel_in_face(image, soup, 0, .5, .66), (Color{255, 255, 255}));
  EXPECT_LT(test::texel_in_face(image, soup, 0, .5, .95)[0], 200);
}

TEST(Bake_ambient_occlusion, any_number_of_threads_and_faces_without_a_shape)
{
  test::Soup shape = floor_and_wall(0.5);
  shape.polygons.push_back({0, 0, 0, 1});
  shape.polygons.push_back({0, 1, 0, 1});
  shape.polygons.push_back({0, 1, 99, 2});
  const Polygon_soup soup = test::faces_side_by_side(shape);
  const Image image = bake_ambient_occlusion(soup, 64);
  EXPECT_EQ(bake_ambient_occlusion(soup, 64, {}, 0, Execution(2)).pixels, image.pixels);
  EXPECT_NE(image.pixels, white);
  EXPECT_EQ(test::texel_in_face(image, soup, 3, .5, .5), (Color{255, 255, 255})); // flat: open to all sides
}
