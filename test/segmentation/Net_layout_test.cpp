// SPDX-License-Identifier: MIT
#include <Atlas/core/internal/bounding_box.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/segmentation/internal/developable/Net_builder.h>

#include "test_meshes.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace Atlas::test {
namespace {

using namespace Atlas::internal;

std::vector<Vec2> turned(std::vector<Vec2> points, double angle)
{
  for (Vec2& p : points)
    p = rotated({std::cos(angle), std::sin(angle)}, p);
  return points;
}

std::vector<Vec2> sides(const std::vector<Vec2>& polygon)
{
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    result.push_back(polygon[(i + 1) % polygon.size()] - polygon[i]);
  return result;
}

std::vector<Vec2> regular_polygon(int n)
{
  std::vector<Vec2> result;
  for (int i = 0; i < n; ++i)
    result.push_back({std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n)});
  return result;
}

/// 0 if the directions are the same up to quarter turns.
double difference(Vec2 a, Vec2 b)
{
  return std::min(std::abs(dot(a, b)), std::abs(cross(a, b)));
}

const std::vector<Vec2> l_shape{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 5}, {0, 5}};

TEST(Net_layout, right_angled_borders_have_a_dominant_direction)
{
  for (const double angle : {0.0, 0.3, 0.7, 1.2, 2.9, 4.0}) {
    const Alignment border = alignment_of(sides(turned(l_shape, angle)));
    EXPECT_TRUE(border.is_dominant());
    EXPECT_NEAR(border.aligned, 16, 1e-9);
    EXPECT_NEAR(border.border, 16, 1e-9);
    EXPECT_NEAR(difference(border.direction, {std::cos(angle), std::sin(angle)}), 0, 1e-9);
  }
  EXPECT_FALSE(alignment_of(sides(regular_polygon(12))).is_dominant());
  EXPECT_FALSE(alignment_of(sides({{0, 0}, {10, 0}, {0.5, 0.3}})).is_dominant());
}

TEST(Net_layout, points_are_sorted_whatever_runs_they_come_in)
{
  const auto is_less = [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::vector<Vec2> points;
  for (int parts = 0; parts < 8; ++parts) { // two polygons are few runs, seven are many
    std::vector<Vec2> sorted = points, expected = points;
    sort_along_x(sorted);
    std::sort(expected.begin(), expected.end(), is_less);
    EXPECT_TRUE(sorted == expected);
    for (const Vec2 p : turned(regular_polygon(3 + 7 * parts), 0.3 * parts))
      points.push_back(p + Vec2{0.25 * parts, 0});
    points.push_back(points.front());
  }
}

TEST(Net_layout, smaller_squares_are_looked_for_only_where_they_matter)
{
  const std::vector<Vec2> bar = turned({{0, 0}, {8, 0}, {8, 1}, {0, 1}}, 0.2);
  const Extent whole = extent_of_hull(bar, Alignment()), quick = extent_of_hull(bar, Alignment(), 8.5);
  EXPECT_LT(whole.square, 6.5); // along the diagonal of the square
  EXPECT_NEAR(quick.square, 8, 1e-9);
  EXPECT_EQ(quick.rectangle, whole.rectangle);
  EXPECT_EQ(quick.hull, whole.hull);
  EXPECT_EQ(extent_of_hull(bar, Alignment(), 7.5).square, whole.square);
}

TEST(Net_layout, joined_borders_take_the_direction_that_more_of_them_has)
{
  const Alignment large = alignment_of(sides(l_shape)),
                  small = alignment_of(sides({{0, 0}, {1, 0}, {1, 1}, {0, 1}})),
                  oblique = alignment_of(sides(turned({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.4)));
  EXPECT_NEAR(joined(large, small).aligned, 20, 1e-9);
  for (const Alignment& both : {joined(large, oblique), joined(oblique, large)}) {
    EXPECT_NEAR(both.aligned, 16, 1e-9);
    EXPECT_NEAR(both.border, 20, 1e-9);
    EXPECT_NEAR(difference(both.direction, {1, 0}), 0, 1e-9);
  }
}

TEST(Net_layout, what_is_aligned_takes_a_square_along_its_direction)
{
  // A strip of stairs: it is narrow along the diagonal, but lies along its steps
  std::vector<Vec2> stairs{{0, 0}};
  for (int i = 0; i < 5; ++i)
    stairs.insert(stairs.end(), {{i + 2.0, i + 0.0}, {i + 2.0, i + 1.0}});
  stairs.back().y = 6;
  for (int i = 4; i >= 0; --i)
    stairs.insert(stairs.end(), {{i + 0.0, i + 2.0}, {i + 0.0, i + 1.0}});
  stairs.pop_back();
  for (const double angle : {0.0, 0.5, 1.1}) {
    const std::vector<Vec2> points = turned(stairs, angle);
    const Extent aligned = extent_of_hull(convex_hull(points), alignment_of(sides(points)));
    EXPECT_NEAR(aligned.square, 6, 1e-9);
    EXPECT_NEAR(aligned.rectangle, 36, 1e-9);
    const Extent free = extent_of_hull(convex_hull(points), alignment_of(sides(regular_polygon(12))));
    EXPECT_LE(free.square, 6 + 1e-9);
    EXPECT_NEAR(free.rectangle, 24, 1e-9);
  }
}

/// The wall of an L, as a solid.
Soup l_prism()
{
  Soup soup;
  const Index n = static_cast<Index>(l_shape.size());
  for (const double z : {0.0, 2.5})
    for (const Vec2 p : l_shape)
      soup.points.emplace_back(p.x, p.y, z);
  soup.polygons = {{4, 3, 0, 5}, {3, 2, 1, 0}, {6, 9, 10, 11}, {6, 7, 8, 9}};
  for (Index i = 0; i < n; ++i) {
    const Index k = (i + 1) % n;
    soup.polygons.push_back({i, k, n + k, n + i});
  }
  return soup;
}

TEST(Net_layout, estimated_fullness_of_a_page_is_that_of_the_packer)
{
  const Surface surface = surface_of(l_prism());
  const double noise = relative_position_noise * 2 * bounding_box(surface).half_side;
  const Facets facets = coplanar_facets(surface, noise);
  const Hard_facets hard(surface, facets, noise);
  const Net_facets parts(surface, facets, hard, noise);
  int single = 0;
  for (const double share : {0.2, 0.3, 0.4, 0.5})
    for (unsigned variation = 0; variation < 8; ++variation) {
      Net_builder builder(parts);
      builder.glue_rulings(share, Execution(1));
      builder.glue_creases({0.01, share, variation}, Execution(1));
      Page_options page;
      page.width = page.height = 512;
      page.gutter = 1;
      const double density = Raster_packer().pack(builder.charts(), page, Execution(1)).density;
      const double fullness = parts.whole_area * density * density / (512 * 512);
      EXPECT_LT(fullness, 1.02 * builder.most_fullness());
      if (builder.number_of_nets() > 1)
        continue;
      ++single;
      EXPECT_NEAR(fullness, builder.fullness(), 0.02);
    }
  EXPECT_GT(single, 4);
}

} // namespace
} // namespace Atlas::test
