// SPDX-License-Identifier: MIT
#include <Atlas/core/errors.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/segmentation/internal/visibility/Visibility.h>
#include <Atlas/segmentation/smooth_borders.h>

#include "test_meshes.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace Atlas::test {
namespace {

std::vector<double> visibility_of(const Surface& surface, const Seam_hiding& from)
{
  return internal::Visibility(surface).run(from.toward, from.max_angle * std::numbers::pi / 180, 64,
                                           Execution());
}

std::vector<double> costs_of(Surface surface, const Seam_hiding& from = {}, unsigned threads = 1)
{
  hide_seams(surface, from, Execution(threads));
  return surface.seam_cost;
}

/// The length of the seams on a sphere, each edge times its height above the middle: what is seen from above.
double length_seen_from_above(const Surface& surface, const Segmentation& segmentation)
{
  double sum = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (!segmentation.is_glued(surface, h)) {
      const Point_3 &p = surface.point(h), &q = surface.point(next_halfedge(h));
      sum += std::sqrt(CGAL::squared_distance(p, q)) * std::max(0., p.z() + q.z()) / 4; // from both sides
    }
  return sum;
}

/// The name of the argument that is refused; empty if none is.
template <typename Call>
std::string refused(Call call)
{
  try {
    call();
  } catch (const Invalid_argument& fault) {
    return fault.argument();
  }
  return "";
}

TEST(HideSeams, NothingHidesASphere)
{
  const Surface surface = surface_of(sphere(4));
  for (const double seen : visibility_of(surface, Seam_hiding::openness()))
    EXPECT_NEAR(seen, 1, 0.05);
}

TEST(HideSeams, ADomeLightsASphereAsTheSkyDoes)
{
  // Half of the sky in front of a place that leans by an angle is that of the dome: (1 + cos) / 2.
  const Surface surface = surface_of(sphere(4));
  const std::vector<double> seen = visibility_of(surface, Seam_hiding::dome(Vector_3(0, 0, 1)));
  for (Index v = 0; v < seen.size(); ++v)
    EXPECT_NEAR(seen[v], (1 + surface.points[v].z()) / 2, 0.05);
}

TEST(HideSeams, AViewerSeesTheSideThatFacesHim)
{
  const Surface surface = surface_of(sphere(4));
  const std::vector<double> seen = visibility_of(surface, Seam_hiding::view(Vector_3(0, 1, 0)));
  for (Index v = 0; v < seen.size(); ++v) {
    if (surface.points[v].y() > 0.4) {
      EXPECT_NEAR(seen[v], surface.points[v].y(), 0.05);
    }
    if (surface.points[v].y() < -0.4) {
      EXPECT_EQ(seen[v], 0);
    }
  }
}

TEST(HideSeams, TheHoleOfATorusIsHidden)
{
  const Surface surface = surface_of(torus(60, 40));
  const std::vector<double> seen = visibility_of(surface, Seam_hiding::openness());
  double inside = 0, outside = 1;
  for (Index v = 0; v < seen.size(); ++v) {
    const double radius = std::hypot(surface.points[v].x(), surface.points[v].y());
    if (radius < 0.61)
      inside = std::max(inside, seen[v]);
    if (radius > 1.39)
      outside = std::min(outside, seen[v]);
  }
  EXPECT_LT(inside, 0.75);
  EXPECT_GT(outside, 0.95);
}

TEST(HideSeams, InsideOutAndScaledModelsHaveTheSameCosts)
{
  const Soup soup = torus(30, 20);
  const std::vector<double> costs = costs_of(surface_of(soup));
  Soup scaled = soup, reversed = soup;
  for (Point_3& p : scaled.points)
    p = Point_3(p.x() * 0x1p-300, p.y() * 0x1p-300, p.z() * 0x1p-300);
  EXPECT_EQ(costs_of(surface_of(scaled)), costs);
  for (auto& polygon : reversed.polygons)
    std::reverse(polygon.begin(), polygon.end());
  std::vector<double> sorted = costs, others = costs_of(surface_of(reversed));
  std::sort(sorted.begin(), sorted.end());
  std::sort(others.begin(), others.end());
  ASSERT_EQ(others.size(), sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    EXPECT_NEAR(others[i], sorted[i], 1e-9);
}

TEST(HideSeams, CostsAreThoseOfEdgesAndDoNotDependOnThreads)
{
  const Surface surface = surface_of(torus(30, 20));
  const std::vector<double> costs = costs_of(surface);
  EXPECT_EQ(costs_of(surface, {}, 4), costs);
  EXPECT_LT(*std::min_element(costs.begin(), costs.end()), 0.4);
  for (Index h = 0; h < costs.size(); ++h)
    EXPECT_EQ(costs[h], costs[surface.opposite[h]]);
}

TEST(HideSeams, PaintedVisibilityMultipliesTheCost)
{
  Surface surface = surface_of(planar_grid(4, 4));
  surface.seam_cost.assign(surface.opposite.size(), 2);
  std::vector<double> seen(surface.points.size(), 1);
  seen[12] = 0; // the one in the middle
  hide_seams(surface, seen);
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const auto& triangle = surface.triangles[h / 3];
    const bool is_at_middle = triangle[h % 3] == 12 || triangle[next_halfedge(h) % 3] == 12;
    if (is_at_middle) {
      EXPECT_LT(surface.seam_cost[h], 1);
    } else {
      EXPECT_EQ(surface.seam_cost[h], 2);
    }
  }
}

TEST(HideSeams, SeamsOfAnAtlasGoOutOfSight)
{
  const Surface surface = surface_of(sphere(4));
  const auto seen = [&](const auto& np) {
    std::vector<Point_2> uv;
    const Atlas_report report = generate_atlas(surface, uv, np);
    EXPECT_TRUE(report.is_valid());
    return length_seen_from_above(surface, report.segmentation);
  };
  Merge_options loose; // a tight bound on the tail leaves seams no choice
  loose.max_stretch = 2.5;
  const auto np = parameters::texture_size(256).merge_options(loose);
  EXPECT_LT(seen(np.hide_seams(Seam_hiding::dome(Vector_3(0, 0, 1)))), 0.6 * seen(np));
}

TEST(HideSeams, ChartsOfTheOversegmentationMeetOutOfSight)
{
  Surface surface = surface_of(sphere(5));
  const Variational_segmentation segmentation;
  const double usual = length_seen_from_above(surface, segmentation.segment(surface, Execution()));
  hide_seams(surface, Seam_hiding::dome(Vector_3(0, 0, 1)));
  EXPECT_LT(length_seen_from_above(surface, segmentation.segment(surface, Execution())), 0.95 * usual);
}

TEST(HideSeams, ModelsWithoutExtentAndCancelledRunsAreLeftAlone)
{
  Surface point = surface_of({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}});
  hide_seams(point);
  for (const double cost : point.seam_cost)
    EXPECT_GT(cost, 0);
  Surface empty;
  hide_seams(empty);
  Surface surface = surface_of(sphere(2));
  const Execution cancelled;
  cancelled.cancel();
  hide_seams(surface, {}, cancelled);
  EXPECT_TRUE(surface.seam_cost.empty());
}

TEST(HideSeams, WhatCannotBeIsRefusedByName)
{
  Surface surface = surface_of(sphere(1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto from = [&](const Vector_3& toward, double angle) {
    return refused([&] { hide_seams(surface, {toward, angle}); });
  };
  EXPECT_EQ(from({0, 0, 0}, 90), "hide_seams.toward");
  EXPECT_EQ(from({nan, 0, 1}, 90), "hide_seams.toward");
  EXPECT_EQ(from({0, 0, 1}, 0), "hide_seams.max_angle");
  EXPECT_EQ(from({0, 0, 1}, 181), "hide_seams.max_angle");
  EXPECT_EQ(from({0, 0, 1}, nan), "hide_seams.max_angle");
  EXPECT_EQ(from({0, 0, 1e-200}, 180), "");
  EXPECT_EQ(refused([&] { hide_seams(surface, std::vector<double>(3, 1)); }), "visibility");
  EXPECT_EQ(refused([&] { hide_seams(surface, std::vector<double>(surface.points.size(), 2)); }),
            "visibility");
}

} // namespace
} // namespace Atlas::test
