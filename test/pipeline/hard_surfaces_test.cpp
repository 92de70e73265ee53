// SPDX-License-Identifier: MIT
#include <Atlas/generate_atlas.h>

#include "test_meshes.h"

namespace Atlas::test {
namespace {

/// A plate of n x n cells, those with odd row and column left out.
Soup plate(Index n)
{
  Soup soup = grid(
      n, n, [](double x, double y) { return Point_3(x, 0.6 * y, 0.8 * y); }, false, false, true);
  std::vector<std::vector<Index>> kept;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      if (i % 2 == 0 || j % 2 == 0)
        kept.push_back(soup.polygons[j * n + i]);
  soup.polygons = std::move(kept);
  return soup;
}

TEST(hard_surfaces, plate_with_holes_is_one_chart_without_a_seam)
{
  const Surface surface = surface_of(plate(5));
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface, uv);
  ASSERT_TRUE(report.is_valid());
  EXPECT_EQ(report.charts.size(), 1u);
  EXPECT_EQ(report.certificate.charts, 1u);
  EXPECT_EQ(report.certificate.non_disc_charts, 1u);
  EXPECT_EQ(report.seam_length, 0);
  EXPECT_EQ(report.certificate.seam_length, 0);
  EXPECT_NEAR(report.distortion.symmetric_dirichlet_max, 1, 1e-4); // rounding to floats
}

TEST(hard_surfaces, wanted_seam_between_holes_stays_one)
{
  Surface surface = surface_of(plate(5));
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  double length = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    // The edges between the first two holes in the middle of the bar
    if (o == no_index || surface.is_diagonal(h))
      continue;
    const Point_3 m = CGAL::midpoint(surface.point(h), surface.point(next_halfedge(h)));
    if (std::abs(m.x() - 0.5) < 0.1 + 1e-9 && std::abs(m.y() - 0.6 * 0.2) < 1e-9 &&
        std::abs(surface.point(h).y() - m.y()) < 1e-9) {
      surface.constraint[h] = Edge_constraint::seam;
      length += std::sqrt(CGAL::squared_distance(surface.point(h), surface.point(next_halfedge(h)))) / 2;
    }
  }
  ASSERT_GT(length, 0);
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface, uv);
  ASSERT_TRUE(report.is_valid());
  EXPECT_NEAR(report.seam_length, length, 1e-9);
  double open = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (const Index o = surface.opposite[h];
        o != no_index && (uv[surface.corner[h]] != uv[surface.corner[next_halfedge(o)]] ||
                          uv[surface.corner[next_halfedge(h)]] != uv[surface.corner[o]]))
      open += std::sqrt(CGAL::squared_distance(surface.point(h), surface.point(next_halfedge(h)))) / 2;
  EXPECT_NEAR(open, length, 1e-9) << "no other edge is open in the coordinates";
}

TEST(hard_surfaces, box_is_not_deformed)
{
  Soup soup = cube();
  for (Point_3& p : soup.points)
    p = Point_3(p.x(), 2 * p.y(), 3 * p.z());
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(surface_of(soup), uv);
  ASSERT_TRUE(report.is_valid());
  EXPECT_LE(report.charts.size(), 2u);
  EXPECT_NEAR(report.distortion.symmetric_dirichlet_max, 1, 1e-4);
}

} // namespace
} // namespace Atlas::test
