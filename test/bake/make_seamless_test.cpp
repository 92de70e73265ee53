// SPDX-License-Identifier: MIT
#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/errors.h>

#include "baked_soups.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace Atlas;

namespace {

constexpr std::size_t side = 192;

/// The faces of a cube on a page, each a square that is turned by another angle, far from the others.
Polygon_soup turned_faces()
{
  Polygon_soup soup = test::polygon_soup_of(test::cube());
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (std::size_t i = 0; i < 4; ++i) {
      const double angle = 0.37 * double(f) + (double(i) + .5) * 1.5707963267948966;
      soup.uv.emplace_back((double(f % 3) + .5 + .3 * std::cos(angle)) / 3,
                           (double(f / 3) + .5 + .3 * std::sin(angle)) / 3);
    }
  return soup;
}

Color waves(const Point_3& p)
{
  return color_of({.5 + .3 * std::sin(3 * p.x() + p.y()), .5 + .4 * std::sin(2 * p.y() - 3 * p.z()),
                   .4 + .2 * std::sin(4 * p.z() + p.x())});
}

using Numbers = std::vector<std::array<double, 4>>; // per texel

Numbers numbers_of(const Image& image)
{
  Numbers result;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Color& c = image.pixels[i];
    result.push_back({double(c[0]), double(c[1]), double(c[2]), image.alpha.empty() ? 255. : image.alpha[i]});
  }
  return result;
}

/// Of pages whose sides are multiples of 4.
Numbers half_of(const Numbers& fine, std::size_t width)
{
  Numbers coarse;
  for (std::size_t y = 0; y + 1 < fine.size() / width; y += 2)
    for (std::size_t x = 0; x + 1 < width; x += 2) {
      coarse.emplace_back();
      for (std::size_t k = 0; k < 4; ++k)
        coarse.back()[k] = (fine[y * width + x][k] + fine[y * width + x + 1][k] +
                            fine[(y + 1) * width + x][k] + fine[(y + 1) * width + x + 1][k]) /
                           4;
    }
  return coarse;
}

/// As tents around the centres of texels.
std::array<double, 4> shown(const Numbers& texels, std::size_t width, const Point_2& uv)
{
  const std::size_t height = texels.size() / width;
  const double x = uv.x() * double(width), y = (1 - uv.y()) * double(height);
  std::array<double, 4> sum{};
  for (std::size_t j = std::size_t(y) - 1; j <= std::size_t(y) + 1; ++j)
    for (std::size_t i = std::size_t(x) - 1; i <= std::size_t(x) + 1; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        sum[k] += std::max(0., 1 - std::abs(x - double(i) - .5)) *
                  std::max(0., 1 - std::abs(y - double(j) - .5)) * texels[j * width + i][k];
  return sum;
}

Point_2 between(const Point_2& a, const Point_2& b, double t)
{
  return Point_2(a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y()));
}

/// The largest difference at a mip level, by looking at very many places of all edges of the soup.
double difference_seen(const Polygon_soup& soup, const std::vector<Image>& pages, int level)
{
  std::vector<Numbers> levels;
  std::size_t width = pages[0].width;
  for (const Image& page : pages)
    levels.push_back(numbers_of(page));
  for (int i = 0; i < level; ++i, width /= 2)
    for (Numbers& page : levels)
      page = half_of(page, width);
  const auto corner = [&](std::size_t f, std::size_t i) { return soup.first[f] + i % 4; };
  double largest = 0;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (std::size_t g = 0; g < f; ++g)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          const std::size_t a = corner(f, i), b = corner(f, i + 1), c = corner(g, j), d = corner(g, j + 1);
          if (soup.vertices[a] != soup.vertices[d] || soup.vertices[b] != soup.vertices[c])
            continue;
          for (int n = 0; n <= 999; ++n) {
            const auto one = shown(levels[soup.page(f)], width, between(soup.uv[a], soup.uv[b], n / 999.));
            const auto two = shown(levels[soup.page(g)], width, between(soup.uv[d], soup.uv[c], n / 999.));
            for (std::size_t k = 0; k < 4; ++k)
              largest = std::max(largest, std::abs(one[k] - two[k]));
          }
        }
  return largest;
}

void expect_as_seen(const Seam_difference& difference, const Polygon_soup& soup,
                    const std::vector<Image>& pages)
{
  EXPECT_EQ(difference.seams, 12u);
  for (int level = 0; level < 3; ++level) {
    const double seen = difference_seen(soup, pages, level), told = difference.largest[std::size_t(level)];
    EXPECT_LE(seen, told + 1e-4) << level;
    EXPECT_GE(seen, 0.98 * told) << level;
  }
}

void expect_below(const Seam_difference& difference, double bound)
{
  for (const double largest : difference.largest)
    EXPECT_LE(largest, bound);
}

} // namespace

TEST(Make_seamless, both_sides_of_a_seam_show_the_same)
{
  const Polygon_soup soup = turned_faces();
  std::vector<Image> pages{bake_procedural(soup, side, waves)};
  const Seam_difference before = seam_difference(soup, pages);
  expect_as_seen(before, soup, pages);
  for (const double largest : before.largest)
    EXPECT_GT(largest, 2); // it is worth the while
  const Seam_difference after = make_seamless(soup, pages);
  expect_as_seen(after, soup, pages);
  expect_below(after, 1);
}

TEST(Make_seamless, changes_little_and_nothing_far_from_seams)
{
  const Polygon_soup soup = turned_faces();
  const Image before = bake_procedural(soup, side, waves);
  std::vector<Image> pages{before};
  make_seamless(soup, pages);
  double sum = 0, covered = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    const auto x = static_cast<std::size_t>((double(f % 3) + .5) / 3 * double(side)),
               y = static_cast<std::size_t>((1 - (double(f / 3) + .5) / 3) * double(side));
    for (std::size_t j = y - 12; j < y + 12; ++j) // half of the diagonal of a face is 19 texels
      for (std::size_t i = x - 12; i < x + 12; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const double change = double(pages[0].at(i, j)[k]) - double(before.at(i, j)[k]);
          sum += change * change;
          ++covered;
          if (std::max(i - x + 4, j - y + 4) < 8) {
            EXPECT_EQ(change, 0) << f;
          }
        }
  }
  EXPECT_LT(std::sqrt(sum / covered), 8);
}

TEST(Make_seamless, works_across_pages_and_in_alpha_alike_on_any_number_of_threads)
{
  Polygon_soup soup = turned_faces();
  soup.face_page = {0, 1, 0, 1, 1, 0};
  std::vector<Image> pages{bake_procedural(soup, side, waves, 0), bake_procedural(soup, side, waves, 1)};
  pages[1].alpha.resize(pages[1].pixels.size());
  for (std::size_t i = 0; i < pages[1].alpha.size(); ++i)
    pages[1].alpha[i] = static_cast<std::uint8_t>(150 + i / side / 4);
  expect_as_seen(seam_difference(soup, pages), soup, pages);
  std::vector<Image> again = pages;
  const Seam_difference after = make_seamless(soup, pages);
  expect_as_seen(after, soup, pages);
  expect_below(after, 1);
  make_seamless(soup, again, Texel_meaning::colors, Execution(2));
  for (std::size_t page = 0; page < 2; ++page) {
    EXPECT_EQ(again[page].pixels, pages[page].pixels);
    EXPECT_EQ(again[page].alpha, pages[page].alpha);
  }
}

TEST(Make_seamless, of_normals_in_tangent_space_compares_the_normals)
{
  Polygon_soup soup = turned_faces();
  for (const Point_3& p : soup.points) // as smooth as a sphere
    soup.normals.push_back(p - Point_3(.5, .5, .5));
  soup.corner_normal = soup.vertices;
  const Bake_normal smooth = shading_normal(soup);
  const auto bumpy = [&](const Bake_sample& s) {
    const auto p = s.mean<std::array<double, 3>>(
        [&](Index c) -> const Point_3& { return soup.points[soup.vertices[c]]; });
    return smooth(s) + .3 * Vector_3(std::sin(9 * p[0]), std::sin(8 * p[1]), std::sin(7 * p[2]));
  };
  const Bake_normal normal = in_tangent_space(soup, bumpy);
  std::vector<Image> pages{
      bake_texture(soup, side, [&](const Bake_sample& s) { return color_of_normal(normal(s)); })};
  const auto meaning = Texel_meaning::tangent_normals;
  const Seam_difference before = seam_difference(soup, pages, meaning),
                        as_colors = seam_difference(soup, pages);
  EXPECT_EQ(before.seams, 12u);
  EXPECT_GT(as_colors.largest[0], 3 * before.largest[0]); // the colours of one normal differ
  EXPECT_GT(before.largest[2], 2);
  const Seam_difference after = make_seamless(soup, pages, meaning);
  expect_below(after, 1);
  EXPECT_GT(seam_difference(soup, pages).largest[0], 10);
}

TEST(Make_seamless, leaves_creases_of_tangent_space_alone)
{
  const Polygon_soup soup = turned_faces(); // each face has a normal of its own
  std::vector<Image> pages{Image(side, side, {128, 128, 255})};
  EXPECT_EQ(make_seamless(soup, pages, Texel_meaning::tangent_normals).seams, 0u);
  EXPECT_EQ(pages[0].pixels, std::vector<Color>(side * side, Color{128, 128, 255}));
}

TEST(Make_seamless, refuses_what_does_not_fit_together)
{
  Polygon_soup soup = turned_faces();
  std::vector<Image> none, two{Image(8, 8), Image(8, 16)};
  EXPECT_THROW(make_seamless(soup, none), Invalid_argument);
  EXPECT_THROW(make_seamless(soup, two), Invalid_argument);
  soup.uv.pop_back();
  std::vector<Image> one{Image(8, 8)};
  EXPECT_THROW(seam_difference(soup, one), Invalid_argument);
}
