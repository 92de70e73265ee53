// SPDX-License-Identifier: MIT
#include <Atlas/core/concepts.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>

#include "flattening_checks.h"

namespace {

using namespace Atlas;
using test::is_one_to_one;
using test::tube;

static_assert(ChartParameterizer<Schnyder_parameterizer>);

TEST(Schnyder_parameterizer, draws_every_disc_one_to_one)
{
  test::Soup sphere = test::sphere(3);
  sphere.polygons.pop_back();
  std::vector<Chart> charts{test::chart_of(test::planar_grid(1, 1)), test::chart_of(test::planar_grid(7, 9)),
                            test::chart_of(test::planar_grid(200, 1)), tube(150), test::chart_of(sphere)};
  Chart triangle = charts.front();
  triangle.triangles.pop_back();
  const Index unused = 6 - triangle.triangles[0][0] - triangle.triangles[0][1] - triangle.triangles[0][2];
  triangle.points.erase(triangle.points.begin() + unused);
  for (Index& v : triangle.triangles[0])
    v -= v > unused;
  charts.push_back(triangle);
  for (Chart& chart : charts) {
    ASSERT_EQ(Schnyder_parameterizer().parameterize(chart, Execution()), Chart_status::valid);
    EXPECT_TRUE(is_one_to_one(chart));
  }
  Chart closed = test::chart_of(test::sphere(1)), torus = test::chart_of(test::torus(5, 4));
  EXPECT_EQ(Schnyder_parameterizer().parameterize(closed, Execution()), Chart_status::not_a_disc);
  EXPECT_EQ(Schnyder_parameterizer().parameterize(torus, Execution()), Chart_status::not_a_disc);
}

} // namespace
