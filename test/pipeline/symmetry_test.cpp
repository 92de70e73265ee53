// SPDX-License-Identifier: MIT
#include <Atlas/generate_atlas.h>

#include "test_meshes.h"
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Atlas::test {
namespace {

/// A body with two horns, symmetric in x and in nothing else.
Surface body()
{
  Soup soup = sphere(4);
  for (Point_3& p : soup.points) {
    const auto bump = [&](double x, double y, double z) {
      return std::exp(-10 * CGAL::squared_distance(p, Point_3(x, y, z)));
    };
    const double r = 1 + 2.5 * (bump(0.6, 0.2, 0.7) + bump(-0.6, 0.2, 0.7)) + 0.5 * bump(0, 0.9, -0.3);
    p = Point_3(r * p.x(), 1.3 * r * p.y(), r * p.z());
  }
  return surface_of(soup);
}

/// The middles of seams, rounded, in order.
std::vector<std::vector<long>> seams(const Surface& surface, const Segmentation& g, double side)
{
  std::vector<std::vector<long>> result;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (h < surface.opposite[h] && !g.is_glued(surface, h)) {
      const Point_3 p = CGAL::midpoint(surface.point(h), surface.point(next_halfedge(h)));
      result.push_back({std::lround(1e6 * side * p.x()), std::lround(1e6 * p.y()), std::lround(1e6 * p.z())});
    }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(symmetry, seams_of_an_atlas_are_mirrored_on_request)
{
  const Surface surface = body();
  std::vector<Point_2> uv;
  Page_options page;
  page.stacking = Chart_stacking::copies_and_mirrored;
  Merge_options tight; // so that there are charts on either side of the body
  tight.max_stretch = 1.15;
  const Atlas_report report = generate_atlas(
      surface, uv,
      parameters::page_options(page).merge_options(tight).symmetry(Symmetry::x).number_of_threads(1));
  ASSERT_TRUE(report.is_valid());
  EXPECT_EQ(seams(surface, report.segmentation, 1), seams(surface, report.segmentation, -1));
  EXPECT_GT(report.stacked_charts, 0u);
}

TEST(symmetry, speaks_to_the_default_segmentation)
{
  const Surface surface = surface_of(cube());
  std::vector<Point_2> uv;
  EXPECT_THROW(generate_atlas(surface, uv, parameters::policies(preset()).symmetry(Symmetry::x)),
               Invalid_argument);
}

} // namespace
} // namespace Atlas::test
