// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/mirror/find_mirror_plane.h>

#include "segmentation_checks.h"
#include "test_meshes.h"
#include <algorithm>
#include <map>
#include <optional>

namespace Atlas::test {
namespace {

static_assert(BoundedSegmentation<Mirrored_segmentation>);

using Placement = std::function<Point_3(const Point_3&)>;

Merged_segmentation merged()
{
  Merge_options options;
  options.orders = 1;
  options.max_stretch = 2.5; // a chart of the coarse test surfaces is a whole side
  return {Variational_segmentation(), Bijective_parameterizer(), Identity_optimizer(), options};
}

Segmentation segment(const Surface& surface, Symmetry symmetry, unsigned threads = 1)
{
  Segmentation g = Mirrored_segmentation(merged(), symmetry).segment(surface, Execution(threads));
  cut_to_discs(surface, g);
  return g;
}

/// A body with two horns to the left and to the right, symmetric in x and in nothing else. `turn` turns the
/// mesh but not the body.
Surface horned(int levels, const Placement& turn = {}, const Placement& place = {})
{
  Soup soup = sphere(levels);
  for (Point_3& p : soup.points) {
    if (turn)
      p = turn(p);
    const auto bump = [&](double x, double y, double z) {
      return std::exp(-10 * CGAL::squared_distance(p, Point_3(x, y, z)));
    };
    const double r = 1 + 0.9 * (bump(0.6, 0.2, 0.7) + bump(-0.6, 0.2, 0.7)) + 0.5 * bump(0, 0.9, -0.3) +
                     0.3 * (bump(0.8, -0.6, 0) + bump(-0.8, -0.6, 0));
    p = Point_3(r * p.x(), 1.3 * r * p.y(), r * p.z());
    if (place)
      p = place(p);
  }
  return surface_of(soup);
}

/// A rotation about no axis of the model.
Point_3 rotated(const Point_3& p)
{
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Point_3 q(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
  return Point_3(c * q.x() - s * q.z(), q.y(), s * q.x() + c * q.z());
}

double mean_edge(const Surface& surface)
{
  double sum = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    sum += internal::edge_length(surface, h);
  return sum / static_cast<double>(surface.opposite.size());
}

Point_3 middle(const Surface& surface, Index h)
{
  return CGAL::midpoint(surface.point(h), surface.point(next_halfedge(h)));
}

std::vector<Index> seams_of(const Surface& surface, const Segmentation& g)
{
  std::vector<Index> seams;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (h < surface.opposite[h] && !g.is_glued(surface, h))
      seams.push_back(h);
  return seams;
}

/// How far the seams are from their mirror image at most, in edges of mean length.
double asymmetry(const Surface& surface, const Segmentation& g, const internal::Mirror_plane& plane)
{
  const std::vector<Index> seams = seams_of(surface, g);
  double largest = 0;
  for (const Index h : seams) {
    const Point_3 image = plane.image(middle(surface, h));
    double nearest = std::numeric_limits<double>::infinity();
    for (const Index k : seams)
      nearest = std::min(nearest, CGAL::squared_distance(middle(surface, k), image));
    largest = std::max(largest, nearest);
  }
  return std::sqrt(largest) / mean_edge(surface);
}

/// The share of the seams that is on the plane.
double share_on_plane(const Surface& surface, const Segmentation& g, const internal::Mirror_plane& plane)
{
  double all = 0, on_plane = 0;
  for (const Index h : seams_of(surface, g)) {
    const double length = internal::edge_length(surface, h);
    all += length;
    if (std::abs(plane.distance(middle(surface, h))) < 0.4 * length)
      on_plane += length;
  }
  return on_plane / all;
}

const internal::Mirror_plane across_x{Vector_3(1, 0, 0), 0};

TEST(Mirrored_segmentation, finds_the_plane_of_a_body_in_any_place)
{
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Vector_3 shift(3 * scale, -2 * scale, scale);
    const Surface surface = horned(
        4, {}, [&](const Point_3& p) { return CGAL::ORIGIN + scale * (rotated(p) - CGAL::ORIGIN) + shift; });
    const auto plane = internal::Mirror_plane_finder(surface, Execution(1))(Symmetry::automatic);
    ASSERT_TRUE(plane);
    const Vector_3 normal = rotated(Point_3(1, 0, 0)) - CGAL::ORIGIN;
    EXPECT_NEAR(std::abs(plane->normal * normal), 1, 1e-4);
    EXPECT_NEAR(plane->distance(CGAL::ORIGIN + shift) / scale, 0, 0.01);
  }
}

TEST(Mirrored_segmentation, finds_no_plane_where_there_is_none)
{
  const Surface lopsided = horned(4, {}, [](const Point_3& p) {
    return p.x() > 0.5 ? Point_3(p.x() + 0.3 * (p.x() - 0.5), p.y(), p.z()) : p;
  });
  EXPECT_FALSE(internal::Mirror_plane_finder(lopsided, Execution(1))(Symmetry::automatic));
  const Surface body = horned(4);
  EXPECT_FALSE(internal::Mirror_plane_finder(body, Execution(1))(Symmetry::y));
  EXPECT_FALSE(internal::Mirror_plane_finder(body, Execution(1))(Symmetry::z));
  EXPECT_TRUE(internal::Mirror_plane_finder(body, Execution(1))(Symmetry::x));
  EXPECT_FALSE(internal::Mirror_plane_finder(Surface(), Execution(1))(Symmetry::automatic));
}

TEST(Mirrored_segmentation, charts_of_a_symmetric_mesh_are_images_of_each_other)
{
  const Surface surface = horned(4);
  const Segmentation g = segment(surface, Symmetry::automatic);
  expect_discs(surface, g);
  EXPECT_GT(g.number_of_charts, 1u);
  EXPECT_LT(asymmetry(surface, g, across_x), 1e-9);
  EXPECT_LT(share_on_plane(surface, g, across_x), 0.5);
  std::map<Index, Index> image;
  for (Index t = 0; t < surface.number_of_triangles(); ++t) {
    const Point_3 p = across_x.image(internal::centroid_of_triangle(surface, t));
    Index u = 0;
    while (CGAL::squared_distance(p, internal::centroid_of_triangle(surface, u)) > 1e-18)
      ++u;
    EXPECT_EQ(image.try_emplace(g.chart[t], g.chart[u]).first->second, g.chart[u]);
  }
}

TEST(Mirrored_segmentation, seams_are_mirrored_on_meshes_that_are_not_symmetric)
{
  const Surface surface = horned(5, rotated);
  const Segmentation without = segment(surface, Symmetry::off), with = segment(surface, Symmetry::x);
  expect_discs(surface, with);
  EXPECT_GT(asymmetry(surface, without, across_x), 3);
  // Snapped to edges, then smoothed by a ring: about an edge each.
  EXPECT_LE(asymmetry(surface, with, across_x), 2.25);
  EXPECT_LE(with.number_of_charts, without.number_of_charts + 2);
}

TEST(Mirrored_segmentation, without_symmetry_all_is_as_it_was)
{
  const Surface surface = horned(3);
  const Segmentation plain = merged().segment(surface, Execution(1));
  for (const Symmetry symmetry : {Symmetry::off, Symmetry::y, Symmetry::z}) {
    const Segmentation g = Mirrored_segmentation(merged(), symmetry).segment(surface, Execution(1));
    EXPECT_EQ(g.chart, plain.chart);
    EXPECT_EQ(g.cut, plain.cut);
  }
}

TEST(Mirrored_segmentation, does_not_depend_on_the_number_of_threads)
{
  const Surface surface = horned(4);
  const Segmentation one = segment(surface, Symmetry::automatic, 1),
                     many = segment(surface, Symmetry::automatic, 4);
  EXPECT_EQ(one.chart, many.chart);
  EXPECT_EQ(one.cut, many.cut);
}

TEST(Mirrored_segmentation, respects_patches_and_seams)
{
  Surface surface = horned(4);
  surface.constraint.resize(surface.opposite.size(), Edge_constraint::none);
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    surface.patch.push_back(internal::centroid_of_triangle(surface, t).y() > 0.2);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (const double x = middle(surface, h).x(); x > -0.5 && x < -0.4)
      surface.constraint[h] = Edge_constraint::seam;
  expect_discs(surface, segment(surface, Symmetry::x));
}

TEST(Mirrored_segmentation, halves_may_meet_nowhere)
{
  Soup soup = sphere(3);
  const std::size_t n = soup.points.size();
  for (std::size_t v = 0; v < n; ++v) {
    Point_3& p = soup.points[v];
    p = Point_3(p.x() + 2, 1.2 * p.y() + 0.2 * p.x(), 1.5 * p.z());
    const Point_3 image(-p.x(), p.y(), p.z());
    soup.points.push_back(image);
  }
  const std::size_t triangles = soup.polygons.size();
  for (std::size_t t = 0; t < triangles; ++t) {
    std::vector<Index> image;
    for (const Index v : soup.polygons[t])
      image.insert(image.begin(), v + static_cast<Index>(n));
    soup.polygons.push_back(image);
  }
  const Surface surface = surface_of(soup);
  const Segmentation g = segment(surface, Symmetry::x);
  expect_discs(surface, g);
  EXPECT_LT(asymmetry(surface, g, across_x), 1e-9);
}

} // namespace
} // namespace Atlas::test
