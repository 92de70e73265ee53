// SPDX-License-Identifier: MIT
#include <Atlas/core/extract_charts.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include "segmentation_checks.h"
#include "test_meshes.h"
#include <random>

namespace Atlas {
namespace {

using test::Soup;

/// The border of the union of unit cubes at integer places, one quad a face; vertices merge by number.
Soup voxels(Index n, const std::function<bool(Index, Index, Index)>& is_solid)
{
  Soup soup;
  std::map<std::array<Index, 3>, Index> number;
  const auto vertex = [&](std::array<Index, 3> p) {
    const auto [it, is_new] = number.try_emplace(p, static_cast<Index>(soup.points.size()));
    if (is_new)
      soup.points.emplace_back(p[0], p[1], p[2]);
    return it->second;
  };
  const auto solid = [&](std::array<Index, 3> c) {
    return c[0] < n && c[1] < n && c[2] < n && is_solid(c[0], c[1], c[2]);
  };
  for (Index z = 0; z < n; ++z)
    for (Index y = 0; y < n; ++y)
      for (Index x = 0; x < n; ++x)
        for (int axis = 0; axis < 3 && solid({x, y, z}); ++axis)
          for (Index side = 0; side < 2; ++side) {
            std::array<Index, 3> beyond{x, y, z}, p{x, y, z};
            beyond[axis] += side ? 1u : no_index;
            if (solid(beyond))
              continue;
            p[axis] += side;
            std::vector<Index> quad;
            for (Index k = 0; k < 4; ++k) {
              std::array<Index, 3> corner = p;
              corner[(axis + 1) % 3] += k == 1 || k == 2;
              corner[(axis + 2) % 3] += k >= 2;
              quad.push_back(vertex(corner));
            }
            if (!side)
              std::reverse(quad.begin(), quad.end());
            soup.polygons.push_back(quad);
          }
  return soup;
}

/// A cube of 3^level cells with holes through everywhere: genus 1, 5, 81 by level 0(not), 1, 2.
Soup menger_sponge(Index size)
{
  return voxels(size, [&](Index x, Index y, Index z) {
    for (; x || y || z; x /= 3, y /= 3, z /= 3)
      if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) >= 2)
        return false;
    return true;
  });
}

/// A sheet of n x n cells where every second one in each direction is missing.
Soup sheet_with_holes(Index n)
{
  Soup soup = test::grid(
      n, n, [](double x, double y) { return Point_3(x, y, 0); }, false, false, true);
  std::vector<std::vector<Index>> kept;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      if (i % 2 == 0 || j % 2 == 0)
        kept.push_back(soup.polygons[j * n + i]);
  soup.polygons = kept;
  return soup;
}

Soup tetrahedron()
{
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

Soup pillow()
{
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
}

std::vector<std::pair<const char*, Soup>> families()
{
  return {
      {"grid", test::planar_grid(7, 5)},
      {"sphere", test::sphere(3)},
      {"torus", test::torus(24, 12)},
      {"cube of quads", test::cube()},
      {"cylinder",
       test::grid(
           16, 5,
           [](double x, double y) { return Point_3(std::cos(2 * M_PI * x), std::sin(2 * M_PI * x), 3 * y); },
           true, false, true)},
      {"quad torus of voxels",
       voxels(3, [](Index x, Index y, Index z) { return z == 0 && (x != 1 || y != 1); })},
      {"sponge of genus 5", menger_sponge(3)},
      {"sheet with 25 holes", sheet_with_holes(11)},
      {"tetrahedron", tetrahedron()},
      {"pillow", pillow()},
      {"two quads back to back",
       {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}, {3, 2, 1, 0}}}},
      {"triangle", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}},
      {"random voxels",
       voxels(6, [](Index x, Index y, Index z) { return (x * 73 + y * 151 + z * 283 + x * y * z) % 7 < 3; })},
      {"polygon with a bridge to its hole",
       {{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}},
        {{0, 1, 2, 3, 0, 4, 7, 6, 5, 4}}}}};
}

double cut_length(const Surface& surface, const Segmentation& segmentation)
{
  double sum = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && !segmentation.is_glued(surface, h))
      sum += internal::edge_length(surface, h) / 2;
  return sum;
}

TEST(Cut_to_discs, Whole_surfaces_of_every_kind)
{
  for (const auto& [name, soup] : families()) {
    SCOPED_TRACE(name);
    const Surface surface = test::surface_of(soup);
    Segmentation segmentation = test::one_chart(surface);
    cut_to_discs(surface, segmentation);
    test::expect_discs(surface, segmentation);
    test::expect_numbered_by_first_triangle(segmentation);
  }
}

TEST(Cut_to_discs, A_connected_manifold_stays_one_chart)
{
  for (const Soup& soup : {test::sphere(3), test::torus(24, 12), menger_sponge(9), sheet_with_holes(11),
                           tetrahedron(), pillow(), test::cube()}) {
    const Surface surface = test::surface_of(soup);
    Segmentation segmentation = test::one_chart(surface);
    cut_to_discs(surface, segmentation);
    EXPECT_EQ(segmentation.number_of_charts, 1u);
    test::expect_discs(surface, segmentation);
  }
}

TEST(Cut_to_discs, Random_charts_and_cuts)
{
  std::mt19937 random(7);
  for (const auto& [name, soup] : families()) {
    SCOPED_TRACE(name);
    const Surface surface = test::surface_of(soup);
    for (int round = 0; round < 40; ++round) {
      SCOPED_TRACE(round);
      Segmentation segmentation = test::one_chart(surface);
      const auto charts = static_cast<Index>(1 + random() % 3);
      const auto one_in = 2 + random() % 20;
      for (Index t = 0; t < segmentation.chart.size(); ++t) // patches of neighbouring numbers, some noise
        segmentation.chart[t] = (t / 13 + (random() % 9 == 0)) % charts;
      segmentation.number_of_charts = charts;
      for (Index h = 0; h < segmentation.cut.size(); ++h)
        segmentation.cut[h] = random() % one_in == 0;
      cut_to_discs(surface, segmentation);
      test::expect_discs(surface, segmentation);
      test::expect_numbered_by_first_triangle(segmentation);
    }
  }
}

TEST(Cut_to_discs, Discs_are_left_alone_and_a_second_call_changes_nothing)
{
  const Surface surface = test::surface_of(test::torus(24, 12));
  Segmentation segmentation = test::one_chart(surface);
  cut_to_discs(surface, segmentation);
  const Segmentation before = segmentation;
  cut_to_discs(surface, segmentation);
  EXPECT_EQ(segmentation.chart, before.chart);
  EXPECT_EQ(segmentation.cut, before.cut);
}

TEST(Cut_to_discs, The_cuts_of_a_torus_are_its_short_loops)
{
  const Index m = 40, n = 20;
  const Surface surface = test::surface_of(test::torus(m, n, 1, 0.25));
  Segmentation segmentation = test::one_chart(surface);
  cut_to_discs(surface, segmentation);
  // Around the tube, and along the inner equator: edges of the grid run along both.
  const double tube = n * 2 * 0.25 * std::sin(M_PI / n), inner = m * 2 * 0.75 * std::sin(M_PI / m);
  EXPECT_NEAR(cut_length(surface, segmentation), tube + inner, 1e-9);
}

TEST(Cut_to_discs, Holes_are_joined_by_a_minimum_spanning_tree)
{
  const Index n = 11; // 25 holes, each one edge away from its neighbours and the border
  const Surface surface = test::surface_of(sheet_with_holes(n));
  Segmentation segmentation = test::one_chart(surface);
  cut_to_discs(surface, segmentation);
  EXPECT_NEAR(cut_length(surface, segmentation), 25. / n, 1e-9);
}

TEST(Cut_to_discs, Sharp_edges_are_cut_first)
{
  // A prism with a square base and open ends, the lengthwise edges finely meshed on the flat sides too.
  const Soup soup = test::grid(
      16, 4,
      [](double x, double y) {
        const double s = 4 * x, r = s - std::floor(s);
        const std::array<std::pair<double, double>, 5> c{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
        const auto [a, b] = c[static_cast<std::size_t>(s)];
        const auto [d, e] = c[static_cast<std::size_t>(s) + 1];
        return Point_3(a + r * (d - a), b + r * (e - b), y);
      },
      true);
  const Surface surface = test::surface_of(soup);
  Segmentation segmentation = test::one_chart(surface);
  cut_to_discs(surface, segmentation);
  test::expect_discs(surface, segmentation);
  int cuts = 0;
  for (Index h = 0; h < segmentation.cut.size(); ++h)
    if (segmentation.cut[h]) {
      ++cuts;
      const Vector_3 a = internal::unit_normal(surface, h / 3),
                     b = internal::unit_normal(surface, surface.opposite[h] / 3);
      EXPECT_NEAR(a * b, 0, 1e-12);
    }
  EXPECT_EQ(cuts, 2 * 4);
}

TEST(Cut_to_discs, Constraints_and_patches)
{
  Surface surface = test::surface_of(test::torus(24, 12));
  const auto at = [&](Index h) { return surface.triangles[h / 3][h % 3]; };
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  surface.patch.assign(surface.number_of_triangles(), 0);
  Index isolated = no_index;
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index a = at(h), b = at(next_halfedge(h));
    if (a % 24 == 3 && b % 24 == 3) // one ring around the tube must not be cut
      surface.constraint[h] = Edge_constraint::no_seam;
    if (std::minmax(a, b) == std::minmax(Index(30), Index(31))) {
      surface.constraint[h] = Edge_constraint::seam; // a slit of a single edge
      isolated = h;
    }
  }
  ASSERT_NE(isolated, no_index);
  for (Index t = 100; t < 200; ++t)
    surface.patch[t] = 1 + (t >= 150);
  Segmentation segmentation = test::one_chart(surface);
  cut_to_discs(surface, segmentation);
  test::expect_discs(surface, segmentation);
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    if (surface.constraint[h] == Edge_constraint::no_seam &&
        surface.patch[h / 3] == surface.patch[surface.opposite[h] / 3]) {
      EXPECT_TRUE(segmentation.is_glued(surface, h));
    }
  }
}

TEST(Cut_to_discs, Some_charts_only)
{
  const Surface surface = test::surface_of(test::grid(
      12, 12, [](double x, double y) { return Point_3(x, y, 0); }, false, false, true));
  Segmentation segmentation = test::one_chart(surface);
  const auto cell = [&](Index t) { return std::pair(surface.face[t] % 12, surface.face[t] / 12); };
  for (Index t = 0; t < segmentation.chart.size(); ++t) {
    const auto [x, y] = cell(t);
    segmentation.chart[t] = x < 6 ? (x == 2 && y == 2) : 2 + (x == 9 && y > 5);
  }
  segmentation.number_of_charts = 4;
  const Segmentation before = segmentation;
  const std::vector<Index> chosen{2, 3};
  EXPECT_EQ(cut_to_discs(surface, segmentation, chosen), (std::vector<Index>{2, 3}));
  EXPECT_EQ(segmentation.chart, before.chart); // both were discs

  Segmentation split = before; // the first chart has a hole; the third one falls apart
  for (Index t = 0; t < split.chart.size(); ++t)
    if (split.chart[t] == 2 && cell(t).second == 3)
      split.chart[t] = 3;
  const Segmentation unsplit = split;
  EXPECT_EQ(cut_to_discs(surface, split, chosen), (std::vector<Index>{2, 3, 4, 5}));
  EXPECT_EQ(split.number_of_charts, 6u);
  for (Index t = 0; t < split.chart.size(); ++t)
    if (unsplit.chart[t] < 2) {
      EXPECT_EQ(split.chart[t], unsplit.chart[t]);
    }
  EXPECT_EQ(cut_to_discs(surface, split, std::vector<Index>{0}), std::vector<Index>{0});
  test::expect_discs(surface, split);
}

TEST(Cut_to_discs, A_chart_of_half_faces_vanishes)
{
  const Surface surface = test::surface_of(test::grid(
      4, 1, [](double x, double y) { return Point_3(x, y, 0); }, false, false, true));
  Segmentation segmentation = test::one_chart(surface);
  segmentation.chart = {0, 1, 0, 1, 2, 2, 3, 3};
  segmentation.number_of_charts = 4;
  EXPECT_EQ(cut_to_discs(surface, segmentation, std::vector<Index>{0, 1}), std::vector<Index>{0});
  EXPECT_EQ(segmentation.number_of_charts, 3u);
  EXPECT_EQ(segmentation.chart, (std::vector<Index>{0, 0, 0, 0, 2, 2, 1, 1}));
}

TEST(Cut_to_discs, Same_result_on_any_number_of_threads_and_scale)
{
  Soup soup = menger_sponge(9);
  const Surface surface = test::surface_of(soup);
  Segmentation one = test::one_chart(surface), four = one, tiny = one;
  for (Index t = 0; t < one.chart.size(); ++t)
    one.chart[t] = four.chart[t] = tiny.chart[t] = surface.face[t] / 100;
  one.number_of_charts = four.number_of_charts = tiny.number_of_charts = one.chart.back() + 1;
  cut_to_discs(surface, one, Execution(1));
  cut_to_discs(surface, four, Execution(4));
  for (Point_3& p : soup.points)
    p = Point_3(p.x() * 0x1p-60, p.y() * 0x1p-60, p.z() * 0x1p-60);
  cut_to_discs(test::surface_of(soup), tiny);
  EXPECT_EQ(one.chart, four.chart);
  EXPECT_EQ(one.cut, four.cut);
  EXPECT_EQ(one.chart, tiny.chart);
  EXPECT_EQ(one.cut, tiny.cut);
}

TEST(Cut_to_discs, A_slit_of_one_edge_in_a_sphere_becomes_longer)
{
  for (const Soup& soup : {tetrahedron(), test::sphere(2)}) {
    const Surface surface = test::surface_of(soup);
    Segmentation segmentation = test::one_chart(surface);
    segmentation.cut[0] = 1;
    cut_to_discs(surface, segmentation);
    test::expect_discs(surface, segmentation);
    EXPECT_EQ(segmentation.number_of_charts, 1u);
    EXPECT_TRUE(segmentation.cut[0]);
  }
}

TEST(Cut_to_discs, Faces_that_an_indexed_mesh_cannot_glue_leave_the_chart)
{
  // A square with a back of its own vertices in the same places: glued along the rim by place, so that both
  // diagonals join the same two vertices.
  const Soup soup{
      {{-1, 0, 1}, {1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {-1, 0, -1}, {1, 0, -1}},
      {{2, 1, 0}, {5, 6, 4}, {2, 3, 1}, {5, 7, 6}}};
  const Surface surface = test::surface_of(soup);
  Segmentation segmentation = test::one_chart(surface);
  cut_to_discs(surface, segmentation);
  test::expect_discs(surface, segmentation);
}

TEST(Cut_to_discs, Corners_in_one_place)
{
  // Every corner at the origin: lengths are all zero, topology still counts.
  Soup soup = test::sphere(1);
  for (Point_3& p : soup.points)
    p = Point_3(0, 0, 0);
  const Surface surface = test::surface_of(soup);
  Segmentation segmentation = test::one_chart(surface);
  cut_to_discs(surface, segmentation);
  test::expect_discs(surface, segmentation);
}

} // namespace
} // namespace Atlas
