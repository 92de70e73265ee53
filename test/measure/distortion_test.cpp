// SPDX-License-Identifier: MIT
#include <Atlas/measure/distortion.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "test_meshes.h"

namespace Atlas::test {
namespace {

/// The grid, flattened by a linear map.
Chart mapped_grid(double a, double b, double c, double d)
{
  Chart chart = chart_of(planar_grid(5, 4));
  for (const Point_3& p : chart.points)
    chart.uv.emplace_back(a * p.x() + b * p.y(), c * p.x() + d * p.y());
  return chart;
}

TEST(Distortion, SimilaritiesHaveNone)
{
  const Distortion d = measure_distortion(mapped_grid(3, -4, 4, 3));
  EXPECT_EQ(d.triangles, 40u);
  EXPECT_NEAR(d.area_3d, 1, 1e-14);
  EXPECT_NEAR(d.area_uv, 25, 1e-12);
  for (const double one :
       {d.l2_stretch, d.linf_stretch, d.quasi_conformal_mean, d.quasi_conformal_max, d.area_mean, d.area_min,
        d.area_max, d.area_p5, d.area_p95, d.symmetric_dirichlet_mean, d.symmetric_dirichlet_max})
    EXPECT_NEAR(one, 1, 1e-12);
  EXPECT_NEAR(d.angle_mean, 0, 1e-5);
}

TEST(Distortion, OfALinearMapIsKnown)
{
  // Singular values of the plane-to-space map are 1/2 and 2: area is kept.
  const Distortion d = measure_distortion(mapped_grid(2, 0, 0, 0.5));
  EXPECT_NEAR(d.linf_stretch, 2, 1e-12);
  EXPECT_NEAR(d.l2_stretch, std::sqrt((4 + 0.25) / 2), 1e-12);
  EXPECT_NEAR(d.quasi_conformal_mean, 4, 1e-12);
  EXPECT_NEAR(d.symmetric_dirichlet_mean, (4 + 0.25 + 4 + 0.25) / 4, 1e-12);
  EXPECT_NEAR(d.area_mean, 1, 1e-12);
  EXPECT_NEAR(d.angle_mean, 2 * std::atan(4) * 180 / M_PI - 90, 1e-9);
}

TEST(Distortion, AgreesWithTheGradientsOfTheCoordinates)
{
  // Another definition: s and t as functions on the triangle; singular values of their Jacobian are inverse.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const std::array<Point_3, 3> p{Point_3(0, 0, 0), Point_3(uniform(random), 0, 0),
                                   Point_3(uniform(random), uniform(random), 0)};
    const std::array<Point_2, 3> q{Point_2(uniform(random), uniform(random)),
                                   Point_2(uniform(random), uniform(random)),
                                   Point_2(uniform(random), uniform(random))};
    Eigen::Matrix2d e, f;
    for (int k = 0; k < 2; ++k) {
      e.col(k) << p[k + 1].x() - p[0].x(), p[k + 1].y() - p[0].y();
      f.col(k) << q[k + 1].x() - q[0].x(), q[k + 1].y() - q[0].y();
    }
    const Eigen::Vector2d s = (f * e.inverse()).jacobiSvd().singularValues();
    const Triangle_distortion d = triangle_distortion(p, q);
    EXPECT_NEAR(d.largest * s(1), 1, 1e-9);
    EXPECT_NEAR(d.smallest * s(0), 1, 1e-9);
  }
}

TEST(Gradient_angle, OfLinearMapsIsKnown)
{
  // u = x and v = y + x tan(30 degrees): the gradients are (1, 0) and (tan 30, 1).
  const double t = std::tan(M_PI / 6);
  for (const double angle : gradient_angles(mapped_grid(1, 0, t, 1)))
    EXPECT_NEAR(angle, 60, 1e-9);
  for (const double angle : gradient_angles(mapped_grid(1, 0, -t, 1)))
    EXPECT_NEAR(angle, 120, 1e-9);
  for (const double angle : gradient_angles(mapped_grid(3, -4, 4, 3)))
    EXPECT_NEAR(angle, 90, 1e-9);
  EXPECT_TRUE(std::isnan(gradient_angle({Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0)},
                                        {Point_2(0, 0), Point_2(1, 1), Point_2(2, 2)})));
}

TEST(Distortion, AtOwnScaleKnowsNoScale)
{
  // Twice as wide as high, and 10 times as large in all: the area comes out as in space.
  const Chart chart = mapped_grid(20, 0, 0, 10);
  double area = 0;
  for (const Triangle_distortion& d : triangle_distortions_at_own_scale(chart, chart.uv)) {
    area += d.area_uv;
    EXPECT_NEAR(d.largest, std::sqrt(2), 1e-12);
    EXPECT_NEAR(d.smallest, std::sqrt(0.5), 1e-12);
  }
  EXPECT_NEAR(area, 1, 1e-12);
}

TEST(Distortion, TwoDensitiesShowInAreaOnly)
{
  std::vector<Chart> charts{mapped_grid(1, 0, 0, 1), mapped_grid(3, 0, 0, 3)};
  const Distortion d = measure_distortion(charts);
  EXPECT_NEAR(d.quasi_conformal_mean, 1, 1e-12);
  EXPECT_NEAR(d.area_min, 1.0 / 5, 1e-12);
  EXPECT_NEAR(d.area_max, 9.0 / 5, 1e-12);
  EXPECT_NEAR(d.area_p5, d.area_min, 1e-15);
  EXPECT_NEAR(d.area_p95, d.area_max, 1e-15);
}

TEST(Distortion, FlatTrianglesAreLeftOut)
{
  Chart chart = mapped_grid(1, 0, 0, 1);
  chart.points.push_back(chart.points[0]);
  chart.uv.push_back(chart.uv[0]);
  chart.triangles.push_back({0, 1, static_cast<Index>(chart.points.size() - 1)});
  EXPECT_EQ(measure_distortion(chart).triangles, 40u);
}

TEST(Area, OfSurfaceAndChartAgree)
{
  const Surface surface = surface_of(cube());
  EXPECT_NEAR(area_3d(surface), 6, 1e-14);
  EXPECT_NEAR(area_3d(chart_of(cube())), 6, 1e-14);
  EXPECT_NEAR(area_uv(mapped_grid(0, 2, 2, 0)), -4, 1e-13);
}

TEST(SeamLength, CountsEachSeamOnceAndNoBorder)
{
  const Surface surface = surface_of(cube());
  Segmentation faces = one_chart(surface);
  EXPECT_EQ(seam_length(surface, faces), 0);
  faces.chart = surface.face;
  faces.number_of_charts = 6;
  EXPECT_NEAR(seam_length(surface, faces), 12, 1e-14);
  EXPECT_EQ(seam_length(surface_of(planar_grid(2, 2)), one_chart(surface_of(planar_grid(2, 2)))), 0);
}

} // namespace
} // namespace Atlas::test
