// SPDX-License-Identifier: MIT
// The LSCM paper from end to end: its segmentation, conjugate gradients, the stencil test, the horizon
// packer.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/errors.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/validation/Stencil_validator.h>

#include "test_meshes.h"
#include <string>

namespace Atlas {
namespace {

/// A mesh of Debian's package libcgal-demo.
Surface demo_mesh(const std::string& name)
{
  Polygon_soup soup = read_polygon_soup(std::string(ATLAS_DEMO_MESHES) + "/" + name + ".off");
  return build_surface(std::move(soup.points), soup.first, soup.vertices);
}

/// What the paper's mode made of a mesh when it was looked at.
struct Recorded
{
  const char* mesh;
  std::size_t segmented, charts, split;
  double l2_stretch, packing;
};

class Paper_mode : public testing::TestWithParam<Recorded>
{};

TEST_P(Paper_mode, makes_the_recorded_atlas)
{
  const Recorded& recorded = GetParam();
  const Surface surface = demo_mesh(recorded.mesh);
  std::vector<Point_2> uv;
  const Atlas_report report = generate_atlas(
      surface, uv, parameters::mode(Atlas_mode::paper).validator(Stencil_validator()).number_of_threads(1));
  EXPECT_TRUE(report.is_valid()) << message(report.status);
  EXPECT_EQ(report.segmented_charts, recorded.segmented);
  EXPECT_EQ(report.charts.size(), recorded.charts);
  EXPECT_EQ(report.split_charts, recorded.split);
  EXPECT_EQ(report.rejoined_pieces, 0u);
  EXPECT_NEAR(report.distortion.l2_stretch, recorded.l2_stretch, 2e-3);
  EXPECT_NEAR(report.packing_efficiency, recorded.packing, 5e-3);
  for (const Chart_report& chart : report.charts) {
    // The area rule to the letter, but for what rounding to single precision does; and conformal maps.
    EXPECT_LT(chart.distortion.area_max / chart.distortion.area_min, 2.02);
    EXPECT_EQ(chart.status, Chart_status::valid);
  }
  EXPECT_LT(report.distortion.quasi_conformal_mean, 1.05);
}

INSTANTIATE_TEST_SUITE_P(Demo_meshes, Paper_mode,
                         testing::Values(Recorded{"bunny00", 42, 112, 39, 1.0044, 0.5656},
                                         Recorded{"camel", 16, 405, 229, 1.0041, 0.5445}),
                         [](const auto& test) { return std::string(test.param.mesh); });

TEST(Paper_mode, needs_a_validator)
{
  const Surface surface = test::surface_of(test::cube());
  std::vector<Point_2> uv;
  try {
    (void)generate_atlas(surface, uv, parameters::mode(Atlas_mode::paper));
    FAIL() << "no exception";
  } catch (const Invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("Stencil_validator"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)preset(Atlas_mode::paper), Invalid_argument);
}

TEST(Paper_mode, optimizes_charts_when_they_are_accepted)
{
  // A cap that the area rule accepts: the number of charts stays, stretch falls.
  const Surface surface = test::surface_of(test::grid(
      20, 20, [](double x, double y) { return Point_3(x, y, 0.15 * std::sin(3 * x) * std::sin(3 * y)); }));
  Policies policies = paper_preset(Stencil_validator());
  policies.optimizer = Stretch_optimizer();
  std::vector<Point_2> uv;
  const auto atlas = [&](const Policies& p) {
    return generate_atlas(surface, uv, parameters::policies(p).number_of_threads(1));
  };
  const Atlas_report plain = atlas(paper_preset(Stencil_validator())), optimized = atlas(policies);
  EXPECT_EQ(plain.charts.size(), optimized.charts.size());
  EXPECT_NEAR(optimized.unoptimized.l2_stretch, plain.distortion.l2_stretch, 1e-5);
  EXPECT_LT(optimized.distortion.l2_stretch, optimized.unoptimized.l2_stretch);
  EXPECT_EQ(plain.unoptimized.l2_stretch, plain.distortion.l2_stretch);
}

TEST(Paper_mode, finds_the_enclosing_rectangle_of_least_area)
{
  // A strip covers hardly more than its part of a square, and nearly all of a page of its own shape.
  const Surface surface =
      test::surface_of(test::grid(40, 10, [](double x, double y) { return Point_3(4 * x, y, 0); }));
  std::vector<Point_2> uv;
  Page_options page;
  page.width = page.height = 256;
  page.has_free_aspect = true;
  // The horizon packer stands the diagonal of the strip upright, so not that one.
  const Atlas_report report = generate_atlas(surface, uv,
                                             parameters::page_options(page)
                                                 .mode(Atlas_mode::paper)
                                                 .validator(Stencil_validator())
                                                 .packer(Rectangle_packer())
                                                 .number_of_threads(1));
  EXPECT_TRUE(report.is_valid());
  EXPECT_EQ(report.page_width, 128u);
  EXPECT_EQ(report.page_height, 512u);
  EXPECT_GT(report.packing_efficiency, 0.9);
}

} // namespace
} // namespace Atlas
