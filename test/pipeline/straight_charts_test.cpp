// SPDX-License-Identifier: MIT
// Charts with straight borders, through the whole pipeline: parallel to the page to the last bit, upright, on
// borders of texels.
#include <Atlas/generate_atlas.h>
#include <Atlas/pipeline/internal/straighten_borders.h>

#include "test_charts.h"
#include "test_meshes.h"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace Atlas::test {
namespace {

/// A box of 1 x 2 x 3, its third side turned from the z axis.
struct Turned_box
{
  Surface surface;
  Vector_3 up;

  explicit Turned_box(double angle)
  {
    Soup soup = cube();
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](const Point_3& p) {
      return Point_3(p.x(), c * p.y() - s * p.z(), s * p.y() + c * p.z());
    };
    for (Point_3& p : soup.points)
      p = turned(Point_3(p.x(), 2 * p.y(), 3 * p.z()));
    surface = surface_of(soup);
    up = turned(Point_3(0, 0, 1)) - CGAL::ORIGIN;
  }

  /// Calls `f(direction in space, one end in the plane, the other)` for the sides of the box's faces.
  template <typename F>
  void for_each_side(const std::vector<Point_2>& uv, F f) const
  {
    for (Index h = 0; h < surface.opposite.size(); ++h) {
      const Vector_3 d = surface.point(next_halfedge(h)) - surface.point(h);
      int parallel = 0; // sides of the box are parallel to its axes; diagonals of its faces are not
      const Vector_3 x(1, 0, 0), y = CGAL::cross_product(up, x);
      for (const Vector_3& axis : {x, y, up})
        parallel += std::abs(d * axis) > 1e-6;
      if (parallel == 1)
        f(d, uv[surface.corner[h]], uv[surface.corner[next_halfedge(h)]]);
    }
  }
};

TEST(StraightCharts, RectanglesAreRectanglesOfThePageToTheLastBit)
{
  for (const double angle : {0.0, 0.3, 1.2}) {
    const Turned_box box(angle);
    for (const Index size : {512u, 1000u}) {
      std::vector<Point_2> uv;
      const Atlas_report report =
          generate_atlas(box.surface, uv, parameters::texture_size(size).hard_angle(30));
      ASSERT_TRUE(report.is_valid());
      ASSERT_EQ(report.charts.size(), 6u);
      int sides = 0;
      box.for_each_side(uv, [&](const Vector_3&, const Point_2& a, const Point_2& b) {
        EXPECT_TRUE(a.x() == b.x() || a.y() == b.y()) << a << "  " << b;
        ++sides;
      });
      EXPECT_EQ(sides, 24);
    }
  }
}

TEST(StraightCharts, StandUpright)
{
  const Turned_box box(0.3);
  Page_options page;
  page.up = {box.up.x(), box.up.y(), box.up.z()};
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(box.surface, uv, parameters::page_options(page).hard_angle(30));
  ASSERT_TRUE(report.is_valid());
  int upright = 0;
  box.for_each_side(uv, [&](const Vector_3& d, const Point_2& a, const Point_2& b) {
    if (std::abs(d * box.up) < 1e-6)
      return;
    ++upright;
    EXPECT_EQ(a.x(), b.x());
    EXPECT_EQ(b.y() > a.y(), d * box.up > 0);
  });
  EXPECT_EQ(upright, 8);
}

TEST(StraightCharts, SnapToTexels)
{
  const Turned_box box(0.3);
  Page_options page;
  page.snaps = true;
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(box.surface, uv, parameters::page_options(page).hard_angle(30));
  ASSERT_TRUE(report.is_valid());
  EXPECT_TRUE(report.certificate.keeps_gutter());
  for (const Point_2& p : uv)
    for (const double x : {p.x(), p.y()})
      EXPECT_EQ(x * page.width, std::round(x * page.width));
}

TEST(StraightBorders, GetOneCoordinateAndCrookedOnesStay)
{
  const double cell = 1 / internal::grid_cells;
  // The left side is off by two cells, the right one by forty.
  Chart chart = flat_chart({{0.1, 0.1}, {0.5, 0.1}, {0.5 + 40 * cell, 0.4}, {0.1 + 2 * cell, 0.4}},
                           {{0, 1, 2}, {0, 2, 3}});
  internal::straighten_borders(chart);
  EXPECT_EQ(chart.uv[0].x(), chart.uv[3].x());
  EXPECT_NEAR(chart.uv[0].x(), 0.1 + cell, 1e-12);
  EXPECT_EQ(chart.uv[2].x(), 0.5 + 40 * cell);
  EXPECT_EQ(chart.uv[0].y(), chart.uv[1].y());
}

} // namespace
} // namespace Atlas::test
