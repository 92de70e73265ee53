// SPDX-License-Identifier: MIT
#include <Atlas/bake/bake_texture.h>

#include "baked_soups.h"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace Atlas;

namespace {

/// The direction that a colour stands for.
Vector_3 direction(const Color& c)
{
  const auto component = [](int x) { return x / 127.5 - 1; };
  return Vector_3(component(c[0]), component(c[1]), component(c[2]));
}

/// The upper half of a unit sphere, seen from above on the page.
Polygon_soup hemisphere(int levels)
{
  Polygon_soup soup = test::polygon_soup_of(test::sphere(levels));
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    bool is_above = true;
    for (const Index v : soup.face(f))
      is_above &= soup.points[v].z() >= 0;
    for (const Index v : soup.face(f)) {
      const Point_3& p = soup.points[v];
      soup.uv.push_back(is_above ? Point_2((p.x() + 1) / 2, (p.y() + 1) / 2) : Point_2(NAN, NAN));
    }
  }
  return soup;
}

void expect_sphere(const Image& image, double tolerance)
{
  const double side = static_cast<double>(image.width);
  for (std::size_t j = 0; j < image.height; ++j)
    for (std::size_t i = 0; i < image.width; ++i) {
      const double x = 2 * (double(i) + .5) / side - 1, y = 1 - 2 * (double(j) + .5) / side;
      if (x * x + y * y > 0.9)
        continue;
      const Vector_3 wanted(x, y, std::sqrt(1 - x * x - y * y));
      EXPECT_LT((direction(image.at(i, j)) - wanted).squared_length(), tolerance * tolerance)
          << i << ' ' << j;
    }
}

} // namespace

TEST(Bake_normals, of_a_sphere_are_its_positions)
{
  expect_sphere(bake_normals(hemisphere(5), 64), 0.03);
}

TEST(Bake_normals, of_the_file_come_first)
{
  Polygon_soup soup = hemisphere(5);
  for (const Point_3& p : soup.points)
    soup.normals.push_back(2 * (p - CGAL::ORIGIN)); // of any length
  soup.corner_normal = soup.vertices;
  expect_sphere(bake_normals(soup, 64), 0.03);
  for (Vector_3& n : soup.normals)
    n = Vector_3(0, -1, 0);
  EXPECT_EQ(bake_normals(soup, 8).pixels, std::vector<Color>(64, Color{128, 0, 128}));
  for (Vector_3& n : soup.normals)
    n = Vector_3(0, NAN, 0); // no normals: those of the surface
  expect_sphere(bake_normals(soup, 64), 0.03);
}

TEST(Bake_normals, are_sharp_at_the_edges_of_a_cube)
{
  const Polygon_soup soup = test::faces_side_by_side(test::cube());
  const Image image = bake_normals(soup, 64);
  const Color wanted[] = {{128, 128, 0},   {128, 128, 255}, {128, 0, 128},
                          {128, 255, 128}, {0, 128, 128},   {255, 128, 128}};
  for (std::size_t f = 0; f < 6; ++f)
    for (const double s : {0.01, 0.5, 0.99})
      EXPECT_EQ(test::texel_in_face(image, soup, f, s, 1 - s), wanted[f]) << f;
}

TEST(Bake_normals, do_not_depend_on_scale_or_threads)
{
  Polygon_soup soup = hemisphere(2);
  const Image image = bake_normals(soup, 32);
  EXPECT_EQ(bake_normals(soup, 32, 0, Execution(2)).pixels, image.pixels);
  for (Point_3& p : soup.points)
    p = Point_3(1e-30 * p.x(), 1e-30 * p.y(), 1e-30 * p.z());
  EXPECT_EQ(bake_normals(soup, 32).pixels, image.pixels);
}
