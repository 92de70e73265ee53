// SPDX-License-Identifier: MIT
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/internal/features/Fast_marching.h>
#include <Atlas/segmentation/internal/features/Feature_distance.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>

#include "segmentation_shapes.h"

namespace Atlas {
namespace {

std::vector<std::uint8_t> no_features(const Surface& surface)
{
  return std::vector<std::uint8_t>(surface.opposite.size(), 0);
}

Point_3 middle(const Surface& surface, Index t)
{
  return CGAL::centroid(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2));
}

TEST(Distance_to_features, To_the_border_of_a_square)
{
  const Surface surface = test::surface_of(test::planar_grid(32, 32));
  const std::vector<double> distance = distance_to_features(surface, no_features(surface));
  for (Index t = 0; t < distance.size(); ++t) {
    const Point_3 c = middle(surface, t);
    EXPECT_NEAR(distance[t], std::min({c.x(), 1 - c.x(), c.y(), 1 - c.y()}), 0.5 / 32);
  }
}

TEST(Distance_to_features, To_a_feature_and_along_the_surface)
{
  // A tube of height 4, open at both ends; the upper border is far, a feature ring is at height 1.
  const Surface surface = test::surface_of(test::lathe({{1, 0}, {1, 1}, {1, 2}, {1, 3}, {1, 4}}, 48, 10));
  std::vector<std::uint8_t> is_feature = no_features(surface);
  for (Index h = 0; h < is_feature.size(); ++h)
    is_feature[h] = surface.point(h).z() == 1 && surface.point(next_halfedge(h)).z() == 1;
  const std::vector<double> distance = distance_to_features(surface, is_feature);
  for (Index t = 0; t < distance.size(); ++t) {
    const double z = middle(surface, t).z();
    EXPECT_NEAR(distance[t], std::min({z, std::abs(z - 1), 4 - z}), 0.04);
  }
}

TEST(Distance_to_features, A_plane_wave_is_exact_and_a_round_one_nearly)
{
  const Surface surface = test::surface_of(test::planar_grid(40, 40));
  const internal::Submesh submesh = internal::surface_connectivity(surface);
  internal::Fast_marching marching(surface, submesh);
  std::vector<Index> left;
  Index centre = no_index;
  for (Index h = 0; h < submesh.vertex.size(); ++h) {
    if (surface.point(h).x() == 0)
      left.push_back(submesh.vertex[h]);
    if (surface.point(h) == Point_3(0.5, 0.5, 0))
      centre = submesh.vertex[h];
  }
  marching.run(left);
  for (Index h = 0; h < submesh.vertex.size(); ++h)
    ASSERT_NEAR(marching.distance()[submesh.vertex[h]], surface.point(h).x(), 1e-12);
  ASSERT_NE(centre, no_index);
  marching.run({centre});
  for (Index h = 0; h < submesh.vertex.size(); ++h) {
    const double exact = std::sqrt(CGAL::squared_distance(surface.point(h), Point_3(0.5, 0.5, 0)));
    const double d = marching.distance()[submesh.vertex[h]];
    EXPECT_GE(d, exact * (1 - 1e-9));
    EXPECT_LE(d, exact * 1.03 + 0.02);
  }
}

TEST(Distance_to_features, Diameter_of_closed_components)
{
  test::Soup soup = test::ellipsoid(3);
  test::Soup other = test::sphere(2);
  for (Point_3& p : other.points)
    p = p + Vector_3(10, 0, 0);
  test::append(soup, other);
  const Surface surface = test::surface_of(soup);
  const std::vector<double> distance = distance_to_features(surface, no_features(surface));
  for (Index t = 0; t < distance.size(); ++t) {
    const Point_3 c = middle(surface, t);
    ASSERT_TRUE(std::isfinite(distance[t]));
    EXPECT_GE(distance[t], 0);
    if (c.x() < 5 && std::abs(c.z()) > 2.95) { // near the ends it is highest
      EXPECT_GT(distance[t], 2.6);
    }
    if (c.x() < 5 && std::abs(c.z()) < 0.1) {
      EXPECT_LT(distance[t], 0.9);
    }
  }
}

TEST(Distance_to_features, The_longer_of_two_ways_is_the_diameter)
{
  // The first sweeps start at an end of the second longest axis, and do not get far from there.
  test::Soup soup = test::sphere(4);
  for (Point_3& p : soup.points)
    p = Point_3(2 * p.x(), p.y(), 2.2 * p.z());
  const Surface surface = test::surface_of(soup);
  ASSERT_EQ(surface.point(0), Point_3(2, 0, 0));
  const std::vector<double> distance = distance_to_features(surface, no_features(surface));
  const auto highest = std::max_element(distance.begin(), distance.end()) - distance.begin();
  EXPECT_GT(std::abs(middle(surface, static_cast<Index>(highest)).z()), 1.5);
}

TEST(Distance_to_features, One_value_a_face)
{
  const Surface surface = test::surface_of(test::capped_cylinder(true));
  const std::vector<double> distance = distance_to_features(surface, no_features(surface));
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.is_diagonal(h)) {
      EXPECT_EQ(distance[h / 3], distance[surface.opposite[h] / 3]);
    }
}

TEST(Distance_to_features, Patch_borders_and_wanted_seams_are_sources)
{
  Surface surface = test::surface_of(test::torus(24, 12));
  surface.patch.assign(surface.number_of_triangles(), 0);
  for (Index t = 0; t < 48; ++t)
    surface.patch[t] = 1;
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  const Index seam = 3 * 300;
  surface.constraint[seam] = surface.constraint[surface.opposite[seam]] = Edge_constraint::seam;
  const internal::Submesh submesh = internal::surface_connectivity(surface);
  const auto field = internal::distance_to_features(surface, submesh, no_features(surface));
  EXPECT_EQ(field.vertex[submesh.vertex[seam]], 0);
  EXPECT_EQ(field.vertex[submesh.head(seam)], 0);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.patch[h / 3] != surface.patch[surface.opposite[h] / 3]) {
      EXPECT_EQ(field.vertex[submesh.vertex[h]], 0);
    }
}

} // namespace
} // namespace Atlas
