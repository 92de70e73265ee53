// SPDX-License-Identifier: MIT
#include <Atlas/segmentation/internal/surface/favor_creases.h>

#include "test_meshes.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace Atlas::test {
namespace {

constexpr Index cells = 120;

/// A sheet of 120 x 8 cells over [0, 1] x [0, 0.1] with a height that depends on x alone, or on x and y.
Surface sheet(const std::function<double(double, double)>& height)
{
  return surface_of(
      grid(cells, 8, [&](double x, double y) { return Point_3(x, 0.1 * y, height(x, 0.1 * y)); }));
}

/// The angle across the edges along y between two columns of cells, about in the middle of the sheet.
double angle_at(const Surface& surface, double x)
{
  const internal::Crease_finder finder(surface);
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Point_3 &p = surface.point(h), &q = surface.point(next_halfedge(h));
    if (surface.opposite[h] != no_index && std::abs(p.x() - x) < 0.1 / cells &&
        std::abs(q.x() - x) < 0.1 / cells && std::abs(p.y() + q.y() - 0.1) < 0.02)
      return finder(h);
  }
  return 10;
}

TEST(FavorCreases, ValleysAndRidgesHaveTheAngleOfTheirSides)
{
  const double right_angle = std::numbers::pi / 2;
  EXPECT_NEAR(angle_at(sheet([](double x, double) { return std::abs(x - 0.5); }), 0.5), right_angle, 1e-6);
  EXPECT_NEAR(angle_at(sheet([](double x, double) { return -std::abs(x - 0.5); }), 0.5), -right_angle, 1e-6);
  EXPECT_NEAR(angle_at(sheet([](double x, double) { return -std::abs(x - 0.5); }), 0.25), 0, 1e-6);
}

TEST(FavorCreases, AFilletCountsAndNoiseDoesNot)
{
  // A ridge of 90 degrees, rounded over two cells: no edge turns by more than 31 degrees.
  const double width = 1.0 / cells;
  const Surface fillet =
      sheet([&](double x, double) { return -std::max(std::abs(x - 0.5) - 0.42 * width, 0.0); });
  EXPECT_GT(std::abs(angle_at(fillet, 0.5)), 0.7);
  // Cells that lean to and fro by up to 27 degrees.
  const Surface noise = sheet([&](double x, double y) {
    const long column = std::lround(x * cells), row = std::lround(y * 80);
    return 0.25 * width * (static_cast<double>((column * 7 + row * 3) % 4) - 1.5) / 1.5;
  });
  double sum = 0, count = 0;
  const internal::Crease_finder finder(noise);
  double own = 0;
  for (Index h = 0; h < noise.opposite.size(); ++h)
    if (const Index o = noise.opposite[h]; o != no_index) {
      sum += std::abs(finder(h));
      own +=
          internal::angle_between(internal::unit_normal(noise, h / 3), internal::unit_normal(noise, o / 3));
      ++count;
    }
  EXPECT_LT(sum / count, 0.75 * own / count);
}

TEST(FavorCreases, CreasesAreCheapAndConcaveOnesCheapest)
{
  const auto cost = [](double sign, double x) {
    Surface surface = sheet([&](double at, double) { return sign * std::abs(at - 0.5); });
    internal::favor_creases(surface);
    for (Index h = 0; h < surface.opposite.size(); ++h)
      if (surface.opposite[h] != no_index && surface.point(h).x() == surface.point(next_halfedge(h)).x() &&
          std::abs(surface.point(h).x() - x) < 0.1 / cells) {
        EXPECT_EQ(surface.seam_cost[h], surface.seam_cost[surface.opposite[h]]);
        return surface.seam_cost[h];
      }
    return 10.0;
  };
  EXPECT_NEAR(cost(1, 0.25), 1, 1e-6);
  EXPECT_LT(cost(1, 0.5), cost(-1, 0.5));
  EXPECT_LT(cost(-1, 0.5), 0.8);
}

} // namespace
} // namespace Atlas::test
