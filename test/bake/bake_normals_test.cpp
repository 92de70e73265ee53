// SPDX-License-Identifier: MIT
#include <Atlas/bake/bake_texture.h>

#include "baked_soups.h"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>
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

TEST(Tangent_space, own_normals_point_up)
{
  const Polygon_soup soup = hemisphere(4);
  const Image image =
      bake_texture(soup, 64, [normal = in_tangent_space(soup, shading_normal(soup))](const Bake_sample& s) {
        return color_of_normal(normal(s));
      });
  EXPECT_EQ(image.pixels, std::vector<Color>(64 * 64, Color{128, 128, 255}));
}

TEST(Tangent_space, x_is_along_u_and_y_along_v_however_the_chart_lies)
{
  const Vector_3 tilted(.6, 0, .8); // of a square that looks up, in which u is along one of these
  const std::vector<std::pair<Point_2, Vector_3>> cases{
      {{1, 0}, {.6, 0, .8}}, {{0, 1}, {0, -.6, .8}}, {{-1, 0}, {-.6, 0, .8}}, {{0, -1}, {0, .6, .8}}};
  for (const auto& [u, expected] : cases)
    for (const double mirrored : {1., -1.}) { // v is to the left of u, or to its right
      Polygon_soup soup =
          test::polygon_soup_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}});
      for (const Point_3& p : soup.points)
        soup.uv.emplace_back(.5 + .4 * (p.x() * u.x() + p.y() * u.y()),
                             .5 + mirrored * .4 * (p.y() * u.x() - p.x() * u.y()));
      const Bake_normal normal = in_tangent_space(soup, [&](const Bake_sample&) { return tilted; });
      Bake_sample sample;
      sample.triangle = 1;
      sample.weights = {.2, .3, .5};
      const Vector_3 n = normal(sample), wanted(expected.x(), mirrored * expected.y(), expected.z());
      EXPECT_LT((n - wanted).squared_length(), 1e-20) << u << ' ' << mirrored << ": " << n;
    }
}

TEST(Tangent_space, frames_of_a_curved_surface_are_smooth)
{
  const Polygon_soup soup = hemisphere(6);
  const Bake_normal normal = in_tangent_space(soup, [](const Bake_sample&) { return Vector_3(0, 0, 1); });
  std::size_t tested = 0;
  bake_texture(soup, 32, [&](const Bake_sample& sample) {
    const auto p = sample.mean<std::array<double, 3>>(
        [&](Index c) -> const Point_3& { return soup.points[soup.vertices[c]]; });
    if (p[2] < .5)
      return Color{};
    // u and v are x and y: the tangent is the way on which y stays.
    const Vector_3 n(p[0], p[1], p[2]), along(p[2], 0, -p[0]), t = along / std::sqrt(along.squared_length());
    const Vector_3 wanted(t.z(), CGAL::cross_product(n, t).z(), n.z()), found = normal(sample);
    EXPECT_LT((found / std::sqrt(found.squared_length()) - wanted).squared_length(), .03 * .03);
    ++tested;
    return Color{};
  });
  EXPECT_GT(tested, 100u);
}

TEST(Tangent_space, normals_that_a_soup_gets_are_those_that_are_baked)
{
  Polygon_soup soup = test::polygon_soup_of(test::cube());
  add_normals(soup);
  EXPECT_EQ(soup.normals.size(), 6u);
  for (std::size_t f = 0; f < 6; ++f)
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c)
      EXPECT_EQ(soup.corner_normal[c], soup.corner_normal[soup.first[f]]);
  const auto before = soup.normals;
  add_normals(soup);
  EXPECT_EQ(soup.normals, before);
  Polygon_soup round = hemisphere(5);
  add_normals(round);
  EXPECT_LE(round.normals.size(), round.points.size()); // one a vertex, where it is smooth
}
