// SPDX-License-Identifier: MIT
// Faces of mixed orientation.
#include <Atlas/core/build_surface.h>
#include <Atlas/soup/internal/turn_face.h>
#include <Atlas/soup/internal/weld_points.h>
#include <Atlas/soup/orient_faces.h>

#include "baked_soups.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace Atlas {
namespace {

/// Turns some faces around, each with the given chance.
std::vector<Index> shuffle(Polygon_soup& soup, double chance)
{
  std::mt19937 random(7);
  std::vector<Index> turned;
  for (Index f = 0; f < soup.number_of_faces(); ++f)
    if (static_cast<double>(random()) < chance * 4294967296.0) {
      std::reverse(soup.vertices.begin() + static_cast<std::ptrdiff_t>(soup.first[f]),
                   soup.vertices.begin() + static_cast<std::ptrdiff_t>(soup.first[f + 1]));
      turned.push_back(f);
    }
  return turned;
}

/// The same question by another way: directed edges that occur twice.
std::size_t repeated_edges(const Polygon_soup& soup)
{
  std::map<std::pair<Index, Index>, int> count;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (std::size_t i = 0; i < soup.face(f).size(); ++i)
      ++count[{soup.face(f)[i], soup.face(f)[(i + 1) % soup.face(f).size()]}];
  return static_cast<std::size_t>(
      std::count_if(count.begin(), count.end(), [](const auto& c) { return c.second > 1; }));
}

TEST(Orient_faces, gives_back_what_was_turned)
{
  for (const double chance : {0.0, 0.2, 0.4}) {
    Polygon_soup soup = test::polygon_soup_of(test::sphere(3));
    const Polygon_soup before = soup;
    const std::vector<Index> turned = shuffle(soup, chance);
    EXPECT_EQ(turned.empty(), chance == 0);
    EXPECT_EQ(disagreeing_edges(soup), repeated_edges(soup));
    EXPECT_EQ(orient_faces(soup), turned);
    EXPECT_EQ(disagreeing_edges(soup), 0u);
    EXPECT_EQ(repeated_edges(soup), 0u);
    EXPECT_EQ(soup.first, before.first);
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f) { // the same faces, from any corner on
      std::vector<Index> face(soup.face(f).begin(), soup.face(f).end());
      std::rotate(face.begin(), std::find(face.begin(), face.end(), before.face(f)[0]), face.end());
      EXPECT_TRUE(std::equal(face.begin(), face.end(), before.face(f).begin(), before.face(f).end()));
    }
  }
}

TEST(Orient_faces, the_majority_of_each_part_wins)
{
  Polygon_soup soup = test::polygon_soup_of(test::sphere(2));
  const auto half = soup.number_of_faces();
  const auto points = static_cast<Index>(soup.points.size());
  const Polygon_soup other = test::polygon_soup_of(test::torus(9, 7));
  for (const Point_3& p : other.points)
    soup.points.push_back(p + Vector_3(5, 0, 0));
  for (std::size_t f = 0; f < other.number_of_faces(); ++f) {
    for (const Index v : other.face(f))
      soup.vertices.push_back(points + v);
    soup.close_face();
  }
  const auto turn = [&](std::size_t f) { internal::turn_face(soup, static_cast<Index>(f)); };
  for (std::size_t f = 5; f < half; ++f)
    turn(f); // all but five of the sphere
  turn(half);
  EXPECT_EQ(orient_faces(soup), (std::vector<Index>{0, 1, 2, 3, 4, static_cast<Index>(half)}));
}

TEST(Orient_faces, corners_keep_what_is_theirs)
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  soup.first = {0, 4, 8, 12};
  soup.vertices = {0, 1, 2, 3, 1, 2, 5, 4, 3, 2, 6, 7}; // the second one is turned
  for (const Index v : soup.vertices) {
    soup.uv.emplace_back(v, 0);
    soup.old_uv.emplace_back(0, v);
    soup.corner_normal.push_back(v);
  }
  EXPECT_EQ(orient_faces(soup), std::vector<Index>{1});
  EXPECT_EQ(soup.vertices, (std::vector<Index>{0, 1, 2, 3, 1, 4, 5, 2, 3, 2, 6, 7}));
  for (std::size_t c = 0; c < soup.vertices.size(); ++c) {
    EXPECT_EQ(soup.uv[c], Point_2(soup.vertices[c], 0));
    EXPECT_EQ(soup.old_uv[c], Point_2(0, soup.vertices[c]));
    EXPECT_EQ(soup.corner_normal[c], soup.vertices[c]);
  }
}

TEST(Orient_faces, neighbours_may_have_vertices_of_their_own)
{
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  soup.first = {0, 3, 6, 9};
  soup.vertices = {0, 1, 2, 4, 3, 5, 0, 6, 1}; // all three agree
  EXPECT_EQ(disagreeing_edges(soup), 0u);
  soup.vertices = {0, 1, 2, 3, 4, 5, 0, 6, 1};
  EXPECT_EQ(disagreeing_edges(soup), 1u);
  EXPECT_EQ(orient_faces(soup), std::vector<Index>{1});
}

TEST(Orient_faces, what_has_no_orientation_ends_too)
{
  // A Moebius strip of seven quads; an edge of three faces; faces that are none.
  Polygon_soup strip;
  constexpr Index n = 7;
  for (Index i = 0; i < 2 * n; ++i)
    strip.points.emplace_back(i, i % 3, i % 5);
  for (Index i = 0; i < n; ++i) {
    const Index j = (i + 1) % n;
    const bool is_last = j == 0;
    for (const Index v : {2 * i, 2 * j + is_last, 2 * j + !is_last, 2 * i + 1})
      strip.vertices.push_back(v);
    strip.close_face();
  }
  orient_faces(strip);
  EXPECT_EQ(disagreeing_edges(strip), 1u);

  Polygon_soup odd;
  odd.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  odd.first = {0, 3, 6, 9, 9, 10, 13};
  odd.vertices = {0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 2, 2, 9};
  EXPECT_EQ(disagreeing_edges(odd), 0u);
  EXPECT_TRUE(orient_faces(odd).empty());
  Polygon_soup nothing;
  EXPECT_TRUE(orient_faces(nothing).empty());
}

/// A mesh whose corners are vertices of their own, each moved a little.
Polygon_soup torn(const test::Soup& mesh, double distance)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(-distance, distance);
  Polygon_soup soup;
  for (const auto& polygon : mesh.polygons) {
    for (const Index v : polygon) {
      const Point_3& p = mesh.points[v];
      soup.vertices.push_back(static_cast<Index>(soup.points.size()));
      soup.points.emplace_back(p.x() + offset(random), p.y() + offset(random), p.z() + offset(random));
    }
    soup.close_face();
  }
  return soup;
}

std::ptrdiff_t open_halfedges(const Polygon_soup& soup)
{
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  return std::count(surface.opposite.begin(), surface.opposite.end(), no_index);
}

TEST(Weld_points, near_vertices_are_one_at_any_scale)
{
  for (const double scale : {1e-9, 1.0, 1e9}) {
    Polygon_soup soup = torn(test::sphere(3), 1e-6);
    for (Point_3& p : soup.points)
      p = Point_3(p.x() * scale, p.y() * scale, p.z() * scale);
    EXPECT_EQ(open_halfedges(soup), 3 * 512);
    EXPECT_EQ(internal::weld_points(soup.points, 1e-8), 0u); // they are farther apart
    EXPECT_EQ(internal::weld_points(soup.points, 1e-5), 3u * 512 - 258);
    EXPECT_EQ(open_halfedges(soup), 0);
    EXPECT_EQ(internal::weld_points(soup.points, 1e-5), 0u);
  }
}

TEST(Weld_points, chains_go_to_their_first_and_the_infinite_stay)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Point_3> points = {{1, 0, 0}, {1.0009, 0, 0}, {1.0018, 0, 0},
                                 {0, 0, 0}, {nan, 0, 0},    {1.0028, 0, 0}};
  EXPECT_EQ(internal::weld_points(points, 1e-3), 3u);
  EXPECT_EQ(points[2], points[0]);
  EXPECT_EQ(points[5], points[0]);
  EXPECT_EQ(points[3], Point_3(0, 0, 0));
  EXPECT_TRUE(std::isnan(points[4].x()));
  std::vector<Point_3> same(3, Point_3(1, 1, 1));
  EXPECT_EQ(internal::weld_points(same, 0.1), 0u);
}

} // namespace
} // namespace Atlas
