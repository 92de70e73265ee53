// SPDX-License-Identifier: MIT
// What is curved and what unrolls, at any resolution.
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/segmentation/Merged_segmentation.h>

#include "test_meshes.h"
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>

namespace Atlas::test {
namespace {

/// Counts the triangles that it is asked to segment.
struct Count
{
  std::size_t* triangles;
  Segmentation segment(const Surface& surface, const Execution&) const
  {
    *triangles = surface.number_of_triangles();
    return one_chart(surface);
  }
};

/// How many triangles are taken for curved.
std::size_t number_of_curved_triangles(const Surface& surface, const Execution& execution = Execution(1))
{
  std::size_t count = 0;
  (void)Developable_segmentation(Count{&count}, Raster_packer()).segment(surface, execution);
  return count;
}

/// A cylinder of radius 1 and height 2 about the z axis, of `n` sides and `rows` rows of quads.
Soup cylinder(Index n, Index rows)
{
  return grid(
      n, rows,
      [](double x, double y) { return Point_3(std::cos(2 * M_PI * x), std::sin(2 * M_PI * x), 2 * y); }, true,
      false, true);
}

/// The points as files with six digits keep them.
Soup rounded(Soup soup)
{
  const auto round = [](double x) { return std::round(x * 1e5) / 1e5; };
  for (Point_3& p : soup.points)
    p = Point_3(round(p.x()), round(p.y()), round(p.z()));
  return soup;
}

TEST(Curved_regions, curved_surfaces_are_left_alone)
{
  for (const Soup& soup : {sphere(3), sphere(4), torus(40, 30), torus(120, 60)}) {
    const Surface surface = surface_of(soup);
    EXPECT_EQ(number_of_curved_triangles(surface), surface.number_of_triangles());
  }
}

// Each triangle alone is plane there, and each vertex without angle defect, as far as six digits tell.
TEST(Curved_regions, fine_curved_surfaces_are_left_alone)
{
  const Soup waves = grid(
      300, 300,
      [](double x, double y) { return Point_3(3 * x, 3 * y, 0.2 * std::sin(5 * x) * std::cos(6 * y)); },
      false, false);
  for (const Soup& soup : {torus(600, 300), sphere(7), waves, rounded(waves)}) {
    const Surface surface = surface_of(soup);
    EXPECT_EQ(number_of_curved_triangles(surface), surface.number_of_triangles());
  }
}

TEST(Curved_regions, fine_cylinders_unroll_in_spite_of_rounding)
{
  EXPECT_EQ(number_of_curved_triangles(surface_of(cylinder(300, 100))), 0u);
  EXPECT_EQ(number_of_curved_triangles(surface_of(rounded(cylinder(300, 100)))), 0u);
}

TEST(Curved_regions, hears_that_it_is_cancelled_while_it_glues)
{
  const Surface surface = surface_of(cylinder(2000, 1));
  int calls = 0;
  const Execution execution(1, [&](double) { return ++calls < 5; });
  EXPECT_EQ(number_of_curved_triangles(surface, execution), surface.number_of_triangles())
      << "no net is kept that is not done";
  EXPECT_EQ(calls, 5);
}

} // namespace
} // namespace Atlas::test
