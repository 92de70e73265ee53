// SPDX-License-Identifier: MIT
#include <Atlas/bake/bake_ambient_occlusion.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>

#include "baked_soups.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

using namespace Atlas;

namespace {

using Height = std::function<double(double, double)>;

/// Quads over the unit square, looking up.
test::Soup sheet(Index n, const Height& height)
{
  test::Soup soup;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      const double x = double(i) / n, y = double(j) / n;
      soup.points.emplace_back(x, y, height(x, y));
    }
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i;
      soup.polygons.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return soup;
}

Point_3 point_of(const Polygon_soup& soup, const Bake_sample& sample)
{
  const auto p = sample.mean<std::array<double, 3>>(
      [&](Index c) -> const Point_3& { return soup.points[soup.vertices[c]]; });
  return Point_3(p[0], p[1], p[2]);
}

/// Places spread over the triangles of a soup.
std::vector<Bake_sample> samples_of(const Polygon_soup& soup)
{
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  std::vector<Bake_sample> result;
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    for (const std::array<double, 3>& weights :
         {std::array{.2, .3, .5}, std::array{.7, .2, .1}, std::array{.05, .9, .05}}) {
      Bake_sample& sample = result.emplace_back();
      sample.texel = result.size();
      sample.face = surface.face[t];
      sample.triangle = t;
      sample.weights = weights;
      for (std::size_t i = 0; i < 3; ++i)
        sample.corners[i] = surface.corner[3 * t + i];
    }
  return result;
}

Polygon_soup scaled(Polygon_soup soup, double factor)
{
  for (Point_3& p : soup.points)
    p = Point_3(factor * p.x(), factor * p.y(), factor * p.z());
  return soup;
}

const Height waves = [](double x, double y) { return .01 * std::sin(9 * x) * std::cos(7 * y); };

} // namespace

TEST(Place_on, is_straight_above_or_below_in_the_cage)
{
  for (const double factor : {1.0, 1e-20, 1e20}) {
    const Polygon_soup flat =
        scaled(test::polygon_soup_of(sheet(4, [](double, double) { return 0; })), factor);
    const Polygon_soup detail = scaled(test::polygon_soup_of(sheet(50, waves)), factor);
    const Bake_place place = place_on(flat, detail);
    bool is_above = false, is_below = false;
    for (const Bake_sample& sample : samples_of(flat)) {
      const Bake_sample found = place(sample);
      EXPECT_EQ(found.texel, sample.texel);
      const Point_3 p = point_of(flat, sample), q = point_of(detail, found);
      EXPECT_NEAR(q.x() / factor, p.x() / factor, 1e-9);
      EXPECT_NEAR(q.y() / factor, p.y() / factor, 1e-9);
      EXPECT_NEAR(q.z() / factor, waves(q.x() / factor, q.y() / factor), 1e-4);
      is_above = is_above || q.z() > 0;
      is_below = is_below || q.z() < 0;
    }
    EXPECT_TRUE(is_above && is_below);
  }
}

TEST(Place_on, is_the_nearest_point_beyond_the_cage)
{
  const Polygon_soup flat = test::polygon_soup_of(sheet(4, [](double, double) { return 0; }));
  // A plane that rises by 1 in 2: what is nearest lies downhill.
  const Polygon_soup slope = test::polygon_soup_of(sheet(3, [](double x, double) { return .5 * x; }));
  for (const double cage : {0.0, 0.001, 1.0}) {
    const Bake_place place = place_on(flat, slope, cage);
    for (const Bake_sample& sample : samples_of(flat)) {
      const Point_3 p = point_of(flat, sample), q = point_of(slope, place(sample));
      const bool is_hit = .5 * p.x() <= cage * 1.5; // the diagonal
      EXPECT_NEAR(q.x(), is_hit ? p.x() : .8 * p.x(), 1e-9) << cage;
      EXPECT_NEAR(q.y(), p.y(), 1e-9);
    }
  }
}

TEST(Place_on, is_on_the_side_that_looks_the_same_way)
{
  // Of a sheet of two sides, the lower one is nearer.
  test::Soup two = sheet(5, [](double, double) { return .01; }),
             below = sheet(5, [](double, double) { return .002; });
  const auto n = static_cast<Index>(two.points.size());
  two.points.insert(two.points.end(), below.points.begin(), below.points.end());
  for (auto polygon : below.polygons) {
    std::reverse(polygon.begin(), polygon.end());
    for (auto& v : polygon)
      v += n;
    two.polygons.push_back(polygon);
  }
  const Polygon_soup flat = test::polygon_soup_of(sheet(1, [](double, double) { return 0; })),
                     detail = test::polygon_soup_of(two);
  const Bake_place place = place_on(flat, detail);
  for (const Bake_sample& sample : samples_of(flat))
    EXPECT_NEAR(point_of(detail, place(sample)).z(), .01, 1e-9);
}

TEST(Place_on, the_mesh_itself_is_the_place)
{
  const Polygon_soup cube = test::polygon_soup_of(test::cube());
  for (const double cage : {0.0, 0.02}) {
    const Bake_place place = place_on(cube, cube, cage);
    for (const Bake_sample& sample : samples_of(cube)) {
      const Point_3 p = point_of(cube, sample), q = point_of(cube, place(sample));
      EXPECT_NEAR(CGAL::squared_distance(p, q), 0, 1e-15);
      EXPECT_EQ(place(sample).face, sample.face);
    }
  }
}

TEST(Place_on, refuses_what_has_no_place)
{
  const Polygon_soup cube = test::polygon_soup_of(test::cube());
  EXPECT_THROW(place_on(cube, Polygon_soup()), Invalid_argument);
  EXPECT_THROW(place_on(cube, scaled(cube, 0)), Invalid_argument);
  EXPECT_THROW(place_on(cube, cube, -1), Invalid_argument);
  EXPECT_THROW(place_on(cube, cube, NAN), Invalid_argument);
}
