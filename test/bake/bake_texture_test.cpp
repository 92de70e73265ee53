// SPDX-License-Identifier: MIT
#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/nearest_texels.h>

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace Atlas;

namespace {

/// A unit square in space on [0.25, 0.75]^2 of the page; colours are (x, y, 0).
Polygon_soup square()
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.vertices = {0, 1, 2, 3};
  soup.close_face();
  soup.uv = {{.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}};
  soup.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
  return soup;
}

} // namespace

TEST(Nearest_texels, equals_brute_force)
{
  std::mt19937 random(3);
  for (const int share : {1, 5, 40, 200}) {
    const std::size_t width = 23, height = 17;
    std::vector<bool> is_covered(width * height);
    for (std::size_t i = 0; i < is_covered.size(); ++i)
      is_covered[i] = static_cast<int>(random() % 400) < share;
    is_covered[77] = true;
    const std::vector<Index> nearest = internal::nearest_texels(is_covered, width, height);
    const auto squared_distance = [&](std::size_t i, std::size_t j) {
      const double dx = double(i % width) - double(j % width), dy = double(i / width) - double(j / width);
      return dx * dx + dy * dy;
    };
    for (std::size_t i = 0; i < is_covered.size(); ++i) {
      double best = INFINITY;
      for (std::size_t j = 0; j < is_covered.size(); ++j)
        if (is_covered[j])
          best = std::min(best, squared_distance(i, j));
      ASSERT_TRUE(is_covered.at(nearest[i]));
      EXPECT_EQ(squared_distance(i, nearest[i]), best);
    }
  }
}

TEST(Nearest_texels, without_any_covered_texel)
{
  EXPECT_EQ(internal::nearest_texels(std::vector<bool>(12, false), 4, 3), std::vector<Index>(12, no_index));
}

TEST(Bake_vertex_colors, fills_pages_that_are_not_square)
{
  const Image_size size(64, 16);
  const Image image = bake_vertex_colors(square(), size);
  ASSERT_EQ(image.width, size.width);
  ASSERT_EQ(image.height, size.height);
  for (std::size_t y = 0; y < size.height; ++y)
    for (std::size_t x = 0; x < size.width; ++x) {
      const double u = (double(x) + 0.5) / double(size.width),
                   v = 1 - (double(y) + 0.5) / double(size.height);
      // The nearest texel of the square, by its centre.
      const double s = 2 * (std::clamp(u, 16.5 / 64, 47.5 / 64) - 0.25),
                   t = 2 * (std::clamp(v, 4.5 / 16, 11.5 / 16) - 0.25);
      EXPECT_NEAR(image.at(x, y)[0], 255 * s, 1) << x << ' ' << y;
      EXPECT_NEAR(image.at(x, y)[1], 255 * t, 1) << x << ' ' << y;
    }
}

TEST(Bake_vertex_colors, interpolates_inside_and_extends_outside)
{
  const std::size_t size = 64;
  const Image image = bake_vertex_colors(square(), size);
  for (std::size_t j = 0; j < size; ++j)
    for (std::size_t i = 0; i < size; ++i) {
      // The nearest texel centre inside, seen from the middle of this one; the first row is the top one.
      const double u = (std::clamp<double>(double(i), 16, 47) + .5) / 64,
                   v = 1 - (std::clamp<double>(double(j), 16, 47) + .5) / 64;
      EXPECT_NEAR(image.at(i, j)[0], 255 * (u - .25) * 2, 0.51) << i << ' ' << j;
      EXPECT_NEAR(image.at(i, j)[1], 255 * (v - .25) * 2, 0.51) << i << ' ' << j;
      EXPECT_EQ(image.at(i, j)[2], 0);
    }
}

TEST(Bake_vertex_colors, triangles_between_texel_centres_are_seen)
{
  Polygon_soup soup = square();
  for (Point_2& p : soup.uv)
    p = Point_2(p.x() / 1000 + .501, p.y() / 1000 + .501);
  soup.colors.assign(4, {1, 0, 0, 1});
  EXPECT_EQ(bake_vertex_colors(soup, 16).pixels, std::vector<Color>(256, Color{255, 0, 0}));
}

TEST(Bake_vertex_colors, colours_of_faces_count_where_vertices_are_white_or_have_none)
{
  Polygon_soup soup = square();
  soup.colors.clear();
  soup.face_colors = {{1, 0, 0, 1}};
  EXPECT_EQ(bake_vertex_colors(soup, 4).pixels, std::vector<Color>(16, Color{255, 0, 0}));
  soup.colors.assign(4, {1, 1, 1, 1});
  EXPECT_EQ(bake_vertex_colors(soup, 4).pixels, std::vector<Color>(16, Color{255, 0, 0}));
  soup.colors.assign(4, {0, 1, 0, 1});
  EXPECT_EQ(bake_vertex_colors(soup, 4).pixels, std::vector<Color>(16, Color{0, 255, 0}));
  soup.colors.clear();
  soup.face_colors.clear();
  EXPECT_THROW(bake_vertex_colors(soup, 4), Invalid_argument);
}

TEST(Bake_procedural, knows_the_position)
{
  const Image image = bake_procedural(square(), 32, [](const Point_3& p) {
    return color_of({p.x(), p.y(), 1});
  });
  EXPECT_NEAR(image.at(16, 15)[0], 255 * (16.5 / 32 - .25) * 2, 0.51);
  EXPECT_NEAR(image.at(16, 15)[1], 255 * (16.5 / 32 - .25) * 2, 0.51);
  EXPECT_EQ(image.at(0, 0)[2], 255);
}

TEST(Bake_texture, faces_without_coordinates_are_left_out)
{
  Polygon_soup soup = square();
  soup.uv[0] = Point_2(NAN, 0);
  soup.vertices = {0, 1, 2};
  soup.first = {0, 3};
  soup.uv.resize(3);
  EXPECT_EQ(bake_vertex_colors(soup, 4).pixels, std::vector<Color>(16, Color{128, 128, 128}));
}
