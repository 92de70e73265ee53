// SPDX-License-Identifier: MIT
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/pack_charts.h>

#include "test_charts.h"

namespace Atlas {
namespace {

using namespace test;

void expect_valid(const std::vector<Chart>& charts, const Packing& packing, const Page_options& page,
                  const std::string& what)
{
  ASSERT_EQ(packing.placements.size(), charts.size()) << what;
  EXPECT_EQ(packing.number_of_pages, 1u) << what;
  EXPECT_GT(packing.density, 0) << what;
  for (const Placement& p : packing.placements)
    EXPECT_NEAR(std::hypot(p.a, p.b), packing.density, 1e-9 * packing.density) << what;
  const Packing_clearance clearance = packing_clearance(charts, packing, page, page.gutter);
  EXPECT_GE(clearance.charts, page.gutter) << what;
  EXPECT_GE(clearance.border, page.gutter / 2) << what;
}

template <typename Packer>
class Baseline_packer : public testing::Test
{};
using Baselines = testing::Types<Horizon_packer, Rectangle_packer, Row_packer>;
TYPED_TEST_SUITE(Baseline_packer, Baselines);

TYPED_TEST(Baseline_packer, keeps_the_gutter_on_random_charts)
{
  for (const Chart_family family : all_chart_families)
    for (unsigned seed = 0; seed < 6; ++seed) {
      const std::vector<Chart> charts = random_charts(family, seed, 1 + 7 * seed);
      const Page_options page{seed % 2 ? 256u : 200u, seed % 3 ? 256u : 128u, 1.0 + seed % 4};
      expect_valid(charts, TypeParam().pack(charts, page, Execution(1)), page,
                   "family " + std::to_string(int(family)) + " seed " + std::to_string(seed));
    }
}

TYPED_TEST(Baseline_packer, makes_room_for_more_charts_than_gutters_allow)
{
  const std::vector<Chart> charts = random_charts(Chart_family::blobs, 1, 500);
  const Page_options page{32, 32, 2};
  const Packing packing = TypeParam().pack(charts, page, Execution(1));
  EXPECT_GT(packing.density, 0);
  const Packing_clearance clearance = packing_clearance(charts, packing, page, 2);
  EXPECT_GT(clearance.charts, 0.5);
  EXPECT_GT(clearance.border, 0.25);
}

TYPED_TEST(Baseline_packer, is_the_same_for_any_number_of_threads_and_scale)
{
  std::vector<Chart> charts = random_charts(Chart_family::mixed, 5, 40);
  const Packing one = TypeParam().pack(charts, {}, Execution(1)),
                four = TypeParam().pack(charts, {}, Execution(4));
  for (Chart& chart : charts)
    for (Point_2& p : chart.uv)
      p = Point_2(p.x() * 0x1p-30, p.y() * 0x1p-30);
  const Packing small = TypeParam().pack(charts, {}, Execution(1));
  for (std::size_t i = 0; i < charts.size(); ++i) {
    EXPECT_EQ(one.placements[i].a, four.placements[i].a);
    EXPECT_EQ(one.placements[i].x, four.placements[i].x);
    EXPECT_EQ(one.placements[i].y, four.placements[i].y);
    EXPECT_EQ(one.placements[i].a, small.placements[i].a * 0x1p-30);
    EXPECT_EQ(one.placements[i].x, small.placements[i].x);
  }
}

TYPED_TEST(Baseline_packer, packs_nothing)
{
  const Packing packing = TypeParam().pack({}, {}, Execution(1));
  EXPECT_EQ(packing.number_of_pages, 0u);
}

TEST(Horizon_packer, stands_the_diameter_upright)
{
  const std::vector<Chart> charts{rectangle_chart(4, 1)};
  Page_options page;
  page.rotation = Chart_rotation::free; // else a rectangle stays parallel to the page
  const Packing packing = Horizon_packer().pack(charts, page, Execution(1));
  const Placement& p = packing.placements[0];
  const Point_2 a = p(Point_2(0, 0)), b = p(Point_2(4, 1)), c = p(Point_2(4, 0)), d = p(Point_2(0, 1));
  // Both diagonals are diameters.
  EXPECT_NEAR(std::min(std::abs(a.x() - b.x()), std::abs(c.x() - d.x())), 0, 1e-9);
}

TEST(Rectangle_packer, fills_the_page_with_a_square)
{
  // The page less half a gutter on each side; the search stops within 0.1 %.
  const Packing packing =
      Rectangle_packer().pack(std::vector{rectangle_chart(3, 3)}, {128, 128, 2}, Execution(1));
  EXPECT_LE(packing.density * 3, 126);
  EXPECT_GE(packing.density * 3, 126 * 0.998);
}

TEST(Row_packer, makes_rows_of_decreasing_height)
{
  // Two rows of two on a page that is as wide as the first two; a skyline would put the last beside the
  // third.
  const std::vector<Chart> charts{rectangle_chart(3, 2), rectangle_chart(1, 4), rectangle_chart(1, 1.5),
                                  rectangle_chart(2, 3)};
  const Page_options page{64, 96, 0};
  const Packing packing = Row_packer().pack(charts, page, Execution(1));
  expect_valid(charts, packing, page, "rows");
  std::vector<double> bottom;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    double low = HUGE_VAL, high = -HUGE_VAL, left = HUGE_VAL, right = -HUGE_VAL;
    for (const Point_2& p : charts[i].uv) {
      const Point_2 q = packing.placements[i](p);
      low = std::min(low, q.y());
      high = std::max(high, q.y());
      left = std::min(left, q.x());
      right = std::max(right, q.x());
    }
    EXPECT_GE(high - low, right - left - 1e-9) << i; // upright
    bottom.push_back(low);
  }
  // Heights are 3, 4, 1.5, 3: the second comes first, then, of equal height, the first and the last.
  EXPECT_NEAR(bottom[1], bottom[0], 0.1);
  EXPECT_LT(bottom[1], bottom[2]);
  EXPECT_LE(bottom[3], bottom[2] + 0.1);
}

TEST(Horizon_packer, fits_the_page_with_the_diameter)
{
  Page_options page{128, 128, 2};
  page.rotation = Chart_rotation::free; // else a rectangle stays parallel to the page
  const Packing packing = Horizon_packer().pack(std::vector{rectangle_chart(3, 4)}, page, Execution(1));
  EXPECT_LE(packing.density * 5, 126);
  EXPECT_GE(packing.density * 5, 126 * 0.998);
}

TEST(Horizon_packer, uses_concave_borders)
{
  // Triangles lean into each other under horizons, not under rectangles.
  std::vector<Chart> charts;
  for (int i = 0; i < 20; ++i)
    charts.push_back(flat_chart({{0, 0}, {1, 0}, {0.3, 2}}, {{0, 1, 2}}));
  EXPECT_GT(Horizon_packer().pack(charts, {}, Execution(1)).density,
            1.05 * Rectangle_packer().pack(charts, {}, Execution(1)).density);
}

TEST(Packing_clearance, knows_holes_from_interiors)
{
  const std::vector<Chart> charts{ring_chart(10, 12, 64), rectangle_chart(2, 2)};
  Packing packing{{{1, 0, 50, 50, 0}, {1, 0, 49, 49, 0}}, 1, 1};
  const Page_options page{100, 100, 2};
  const Packing_clearance in_hole = packing_clearance(charts, packing, page, 20);
  EXPECT_NEAR(in_hole.charts, 10 * std::cos(M_PI / 64) - std::sqrt(2), 0.02);
  EXPECT_NEAR(in_hole.border, 38, 1e-4);
  const std::vector<Chart> full{star_chart(64, [](double) { return 12.0; }), rectangle_chart(2, 2)};
  EXPECT_EQ(packing_clearance(full, packing, page, 20).charts, 0);
  packing.placements[1].page = 1;
  packing.number_of_pages = 2;
  EXPECT_EQ(packing_clearance(full, packing, page, 20).charts, 20);
}

} // namespace
} // namespace Atlas
