// SPDX-License-Identifier: MIT
#include <Atlas/core/errors.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/pages.h>
#include <Atlas/image/render_model.h>

#include "temporary_folder.h"
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <png.h>
#include <vector>

using namespace Atlas;

namespace {

/// Two quads on the page: [0.1, 0.4] x [0.1, 0.4] and [0.5, 0.9]^2, and a face without coordinates.
Polygon_soup two_quads()
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto add = [&](double low, double high) {
    soup.vertices.insert(soup.vertices.end(), {0, 1, 2, 3});
    soup.uv.insert(soup.uv.end(), {{low, low}, {high, low}, {high, high}, {low, high}});
    soup.close_face();
  };
  add(0.1, 0.4);
  add(0.5, 0.9);
  add(NAN, NAN);
  return soup;
}

std::size_t count(const Image& image, const Color& color)
{
  return static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), color));
}

} // namespace

TEST(Draw_atlas, charts_cover_their_area_in_their_place)
{
  const Image image = draw_atlas(two_quads(), {0, 1, no_index}, 200);
  const Color first = image.at(50, 150), second = image.at(140, 60), background = image.at(50, 50);
  EXPECT_NE(first, second);
  EXPECT_NE(first, background);
  EXPECT_NEAR(static_cast<double>(count(image, first)), 60. * 60, 4 * 60 + 4);
  EXPECT_NEAR(static_cast<double>(count(image, second)), 80. * 80, 4 * 80 + 4);
  EXPECT_LT(image.at(20, 150)[0], 150); // the border is dark
}

TEST(Draw_atlas, flagged_faces_are_red)
{
  const Image image = draw_atlas(two_quads(), {0, 1, no_index}, 200, {1});
  EXPECT_EQ(image.at(140, 60), (Color{230, 20, 20}));
  EXPECT_NE(image.at(50, 150), (Color{230, 20, 20}));
}

TEST(Draw_atlas, inner_edges_are_no_borders)
{
  Polygon_soup soup;
  soup.vertices = {0, 1, 2, 0, 2, 3};
  soup.first = {0, 3, 6};
  soup.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  const Image image = draw_atlas(soup, {0, 0}, 100);
  EXPECT_GT(image.at(50, 49)[0], 60); // on the diagonal
}

TEST(Draw_atlas, coordinates_far_off_the_page_do_no_harm)
{
  Polygon_soup soup;
  soup.vertices = {0, 1, 2};
  soup.first = {0, 3};
  soup.uv = {{-1e300, 0}, {1e300, 1e300}, {0, 1e9}};
  EXPECT_EQ(draw_atlas(soup, {0}, 32).width, 32u);
}

TEST(Write_png, comes_back_the_same)
{
  const Image image = checkerboard(48, 6);
  const std::string bytes = png_bytes(image);
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&description, bytes.data(), bytes.size()));
  description.format = PNG_FORMAT_RGB;
  Image back(description.width, description.height);
  ASSERT_TRUE(png_image_finish_read(&description, nullptr, back.pixels.data(), 0, nullptr));
  EXPECT_EQ(back.pixels, image.pixels);
  EXPECT_THROW(png_bytes(Image()), IO_error);
}

TEST(Write_png, heights_come_back_the_same)
{
  const std::vector<std::uint16_t> heights{0, 1, 255, 256, 32768, 65535};
  const std::string bytes = png_bytes(heights, Image_size(3, 2));
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&description, bytes.data(), bytes.size()));
  EXPECT_EQ(description.format, std::uint32_t(PNG_FORMAT_LINEAR_Y));
  EXPECT_EQ(description.width, 3u);
  std::vector<std::uint16_t> back(heights.size());
  ASSERT_TRUE(png_image_finish_read(&description, nullptr, back.data(), 0, nullptr));
  EXPECT_EQ(back, heights);
  EXPECT_THROW((void)png_bytes(heights, Image_size(3, 3)), Invalid_argument);
}

TEST(Checkerboard, squares_alternate)
{
  const Image image = checkerboard(64, 8);
  const auto sum = [&](std::size_t x, std::size_t y) {
    return image.at(x, y)[0] + image.at(x, y)[1] + image.at(x, y)[2];
  };
  for (std::size_t j = 0; j < 8; ++j)
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_EQ(sum(8 * i + 4, 8 * j + 4) > 600, (i + j) % 2 == 1) << i << ' ' << j;
}

TEST(Render_model, shows_the_texture_the_right_way_up)
{
  Polygon_soup soup = two_quads();
  soup.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Image texture(64, 64, {255, 0, 0});
  for (std::size_t y = 0; y < 32; ++y)
    for (std::size_t x = 0; x < 64; ++x)
      texture.at(x, y) = x < 32 ? Color{0, 255, 0} : Color{0, 0, 255};
  const Image image = render_model(soup, texture, 100, {{0, 0}});
  ASSERT_EQ(image.width, 100u);
  const auto strongest = [&](std::size_t x, std::size_t y) {
    const Color& c = image.at(x, y);
    return std::max_element(c.begin(), c.end()) - c.begin();
  };
  EXPECT_EQ(strongest(35, 35), 1); // top left: green
  EXPECT_EQ(strongest(65, 35), 2); // top right: blue
  EXPECT_EQ(strongest(50, 65), 0); // bottom: red
  EXPECT_GT(image.at(2, 2)[0], 240);
}

TEST(Draw_atlas, has_the_shape_of_the_page)
{
  const Image_size shape = Image_size(300, 100).with_longer_side(30);
  const Image image = draw_atlas(two_quads(), {0, 1, no_index}, shape),
              square = draw_atlas(two_quads(), {0, 1, no_index}, 30);
  ASSERT_EQ(image.width, 30u);
  ASSERT_EQ(image.height, 10u);
  for (std::size_t y = 0; y < 10; ++y) // each pixel shows three of the square, where they are not on a border
    for (std::size_t x = 0; x < 30; ++x)
      if (square.at(x, 3 * y) == square.at(x, 3 * y + 1) && square.at(x, 3 * y) == square.at(x, 3 * y + 2) &&
          square.at(x, 3 * y) == square.at(0, 0)) {
        EXPECT_EQ(image.at(x, y), square.at(x, 3 * y));
      }
  const Image_size thin = Image_size(4096, 1).with_longer_side(64),
                   tall = Image_size(3, 9).with_longer_side(30);
  EXPECT_EQ(thin.height, 1u);
  EXPECT_EQ(tall.width, 10u);
}

TEST(Checkerboard, has_squares_on_any_page)
{
  const Image wide = checkerboard({64, 16}, 8), square = checkerboard(64, 8);
  ASSERT_EQ(wide.height, 16u);
  for (std::size_t y = 0; y < 16; ++y)
    for (std::size_t x = 0; x < 64; ++x)
      EXPECT_EQ(wide.at(x, y), square.at(x, y));
}

TEST(Halved, goes_down_to_one_pixel)
{
  Image image(4, 1);
  image.pixels = {{0, 8, 1}, {2, 8, 1}, {100, 0, 1}, {102, 0, 1}};
  image = halved(image);
  EXPECT_EQ(image.pixels, (std::vector<Color>{{1, 8, 1}, {101, 0, 1}}));
  image = halved(image);
  EXPECT_EQ(image.pixels, (std::vector<Color>{{51, 4, 1}}));
  EXPECT_EQ(halved(image).pixels, image.pixels);
}

/// Smaller versions of a texture go down to one pixel in both directions, or nothing is drawn.
TEST(Render_model, shows_textures_that_are_not_square)
{
  const Polygon_soup soup = two_quads();
  const Image red(64, 4, {250, 0, 0}), red_square(64, 64, {250, 0, 0});
  EXPECT_EQ(render_model(soup, red, 64).pixels, render_model(soup, red_square, 64).pixels);
}

TEST(Render_model, does_not_depend_on_scale)
{
  Polygon_soup soup = two_quads(), huge = soup;
  for (Point_3& p : huge.points)
    p = Point_3(1e300 * p.x(), 1e300 * p.y(), 0);
  const Image texture = checkerboard(64, 8);
  EXPECT_EQ(render_model(soup, texture, 64).pixels, render_model(huge, texture, 64).pixels);
}
