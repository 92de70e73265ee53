// SPDX-License-Identifier: MIT
#include <Atlas/core/errors.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/pack_charts.h>

#include "test_charts.h"
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <vector>

namespace Atlas {
namespace {

using namespace test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Page_options page_of(Index size, double gutter = 2)
{
  Page_options page;
  page.width = page.height = size;
  page.gutter = gutter;
  return page;
}

/// Puts pieces on a square grid, then spoils the layout.
struct Grid_engine
{
  std::function<void(Page_layout&, const Page_task&)> spoil = [](Page_layout&, const Page_task&) {};

  std::optional<Page_layout> lay_out(const Page_task& task, const Execution&) const
  {
    const double columns = std::ceil(std::sqrt(double(task.pieces.size())));
    const double cell = std::min(task.width, task.height) / columns;
    double scale = task.most_scale;
    for (const Page_piece& piece : task.pieces)
      scale = std::min(scale, (cell / 2 - task.margin) / piece.radius);
    if (!(scale > 0))
      return std::nullopt;
    Page_layout layout{scale, task.margin, {}, {}};
    for (std::size_t i = 0; i < task.pieces.size(); ++i) {
      const double row = std::floor(double(i) / columns);
      layout.turns.emplace_back(1);
      layout.positions.emplace_back(cell * (double(i) - row * columns + 0.5), cell * (row + 0.5));
    }
    spoil(layout, task);
    return layout;
  }
};

struct Returns_a_bool
{
  bool lay_out(const Page_task&, const Execution&) const { return true; }
};

static_assert(PageEngine<Grid_engine> && !ObstaclePageEngine<Grid_engine> && !PageEngine<Returns_a_bool>);
static_assert(PageEngine<Horizon_packer> && PageEngine<Rectangle_packer> &&
              !ObstaclePageEngine<Horizon_packer>);
static_assert(ObstaclePageEngine<Raster_packer>);

TEST(Page_packer, makes_a_packer_of_an_engine)
{
  const std::vector<Chart> charts = random_charts(Chart_family::blobs, 31, 20);
  const Page_packer packer{Grid_engine()};
  Page_options page = page_of(256, 3);
  const Packing one = packer.pack(charts, page, Execution(1));
  EXPECT_EQ(one.number_of_pages, 1u);
  EXPECT_EQ(one.gutter, 3);
  const Packing_clearance clearance = packing_clearance(charts, one, page, 3);
  EXPECT_GE(clearance.charts, 3);
  EXPECT_GE(clearance.border, 1.5);

  page.density = 4 * one.density;
  page.groups.assign(20, no_index);
  page.groups[4] = page.groups[7] = 1;
  page.locked.resize(20);
  page.locked[0] = Placement{page.density, 0, 128, 128};
  const Packing many = packer.pack(charts, page, Execution(1));
  EXPECT_GT(many.number_of_pages, 1u);
  EXPECT_DOUBLE_EQ(many.density, page.density);
  EXPECT_EQ(many.placements[4].x, many.placements[7].x);
  EXPECT_EQ(many.placements[0].x, 128);
}

TEST(Page_packer, names_the_engine_that_broke_its_contract)
{
  using Spoil = std::function<void(Page_layout&, const Page_task&)>;
  const std::vector<std::pair<std::string, Spoil>> faults = {
      {"turns", [](Page_layout& l, const Page_task&) { l.turns.pop_back(); }},
      {"positions", [](Page_layout& l, const Page_task&) { l.positions.emplace_back(); }},
      {"scale", [](Page_layout& l, const Page_task&) { l.scale = nan; }},
      {"scale", [](Page_layout& l, const Page_task&) { l.scale = 0; }},
      {"above", [](Page_layout& l, const Page_task& task) { l.scale = 1.001 * task.most_scale; }},
      {"margin", [](Page_layout& l, const Page_task&) { l.margin = -1; }},
      {"turned piece 1", [](Page_layout& l, const Page_task&) { l.turns[1] = 1.01; }},
      {"turned piece 1", [](Page_layout& l, const Page_task&) { l.turns[1] = std::polar(1.0, 0.5); }},
      {"put piece 2",
       [](Page_layout& l, const Page_task&) {
         l.positions[2] = {nan, 0};
       }},
      {"keep its margin", [](Page_layout& l, const Page_task&) { l.positions[2] = l.positions[1]; }},
      {"keep its margin", [](Page_layout& l, const Page_task&) { l.positions[0] = 0; }},
      {"keep its margin",
       [](Page_layout& l, const Page_task&) {
         l.margin = 0;
         l.positions[0] = l.positions[1];
       }},
      {"keep its margin", [](Page_layout& l, const Page_task&) { l.margin += 30; }},
  };
  const std::vector<Chart> charts(4, rectangle_chart(1, 2));
  Page_options page = page_of(128);
  page.rotation = Chart_rotation::quarter_turns;
  page.density = 10;
  for (const auto& [words, spoil] : faults)
    try {
      (void)Page_packer(Grid_engine{spoil}).pack(charts, page, Execution(1));
      ADD_FAILURE() << "nobody noticed: " << words;
    } catch (const Policy_error& error) {
      EXPECT_EQ(error.role(), "page engine");
      EXPECT_NE(error.type().find("Grid_engine"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(Page_packer, has_no_page_where_an_engine_finds_no_room)
{
  struct No_room
  {
    std::optional<Page_layout> lay_out(const Page_task&, const Execution&) const { return std::nullopt; }
  };
  const std::vector<Chart> charts(4, rectangle_chart(1, 2));
  EXPECT_EQ(Page_packer(No_room()).pack(charts, page_of(64), Execution(1)).number_of_pages, 0u);
}

/// The raster packer without its search around obstacles.
struct Without_obstacles
{
  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const
  {
    EXPECT_TRUE(task.obstacles.empty());
    return Raster_packer().lay_out(task, execution);
  }
};

/// Locked charts are part of the search: pages with them become denser than without it.
TEST(Raster_packer, searches_around_locked_charts)
{
  double gain = 0;
  int cases = 0;
  for (const Chart_family family : {Chart_family::blobs, Chart_family::mixed})
    for (const unsigned seed : {50u, 51u}) {
      std::vector<Chart> charts = random_charts(family, seed, 14);
      charts.push_back(rectangle_chart(3, 1));
      charts.push_back(ring_chart(8, 10, 48));
      Page_options page = page_of(256, 3);
      page.locked.resize(charts.size());
      page.locked[14] = Placement{20, 15, 150, 180, 0, true};
      page.locked[15] = Placement{7, 0, 90, 90};
      const Packing searched = Raster_packer().pack(charts, page, Execution(2));
      const Packing simple = Page_packer(Without_obstacles()).pack(charts, page, Execution(2));
      const Packing_clearance clearance = packing_clearance(charts, searched, page, 3);
      EXPECT_GE(clearance.charts, 3);
      EXPECT_GE(clearance.border, 1.5);
      EXPECT_EQ(searched.gutter, 3);
      EXPECT_GE(searched.density, simple.density);
      for (const std::size_t i : {14u, 15u})
        EXPECT_EQ(searched.placements[i].x, page.locked[i]->x);
      gain += std::log(searched.density / simple.density);
      ++cases;
    }
  RecordProperty("density_gain_percent", std::to_string(100 * std::expm1(gain / cases)));
  EXPECT_GT(std::expm1(gain / cases), 0.03);
}

TEST(Page_options, keeps_charts_of_a_group_in_the_places_that_are_given)
{
  const std::vector<Chart> charts = random_charts(Chart_family::blobs, 33, 4);
  Page_options page = page_of(256);
  page.groups = {3, no_index, 3, no_index};
  page.places_in_group.resize(4);
  page.places_in_group[0] = Placement{0, 2, 10, 20};
  page.places_in_group[2] = Placement{-2, 0, 16, 22, 0, true};
  const Packing packing = Horizon_packer().pack(charts, page, Execution(1));
  const Placement &p = packing.placements[0], &q = packing.placements[2];
  EXPECT_TRUE(q.is_mirrored);
  // The group is scaled as a whole: a unit of its charts has the density of all, since both places have one
  // scale.
  EXPECT_NEAR(std::hypot(p.a, p.b), packing.density, 1e-9 * packing.density);
  EXPECT_NEAR(std::hypot(q.a, q.b), packing.density, 1e-9 * packing.density);
  const auto distance = [](const Point_2& a, const Point_2& b) {
    return std::sqrt(CGAL::squared_distance(a, b));
  };
  const Point_2 a = charts[0].uv[0], b = charts[2].uv[1];
  EXPECT_NEAR(distance(p(a), q(b)) / packing.density,
              distance(page.places_in_group[0](a), page.places_in_group[2](b)) / 2, 1e-6);
}

TEST(Page_options, that_cannot_be_are_refused_by_name)
{
  const std::vector<Chart> charts(3, rectangle_chart(1, 2));
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<std::string, std::function<void(Page_options&)>>> faults = {
      {"width", [](auto& p) { p.width = 0; }},
      {"width", [](auto& p) { p.width = 65537; }},
      {"height", [](auto& p) { p.height = 0; }},
      {"height", [](auto& p) { p.height = Index(-5); }},
      {"gutter", [](auto& p) { p.gutter = 1e9; }},
      {"gutter", [](auto& p) { p.gutter = 64; }},
      {"gutter", [](auto& p) { p.gutter = -1; }},
      {"gutter", [](auto& p) { p.gutter = nan; }},
      {"gutter", [](auto& p) { p.block = 64; }},
      {"gutter", [](auto& p) { p.mip_levels = 6; }},
      {"mip_levels", [](auto& p) { p.mip_levels = 17; }},
      {"block", [](auto& p) { p.block = 4097; }},
      {"pages", [](auto& p) { p.pages = 0; }},
      {"pages", [](auto& p) { p.pages = 9000; }},
      {"density", [](auto& p) { p.density = -1; }},
      {"density", [infinity](auto& p) { p.density = infinity; }},
      {"weights",
       [](auto& p) {
         p.weights = {1, 2};
       }},
      {"weights",
       [](auto& p) {
         p.weights = {1, 2, 0};
       }},
      {"weights",
       [](auto& p) {
         p.weights = {1, 2, nan};
       }},
      {"groups",
       [](auto& p) {
         p.groups = {1, 2, 3, 4};
       }},
      {"places_in_group", [](auto& p) { p.places_in_group.resize(2); }},
      {"places_in_group", [](auto& p) { p.places_in_group.resize(3), p.places_in_group[1].a = nan; }},
      {"locked", [](auto& p) { p.locked.resize(1); }},
      {"locked",
       [](auto& p) {
         p.locked.resize(3), p.locked[0] = Placement{1, 0, nan, 0};
       }},
      {"locked",
       [](auto& p) {
         p.locked.resize(3), p.locked[0] = Placement{1, 0, 0, 0, no_index};
       }},
  };
  for (const auto& [argument, spoil] : faults) {
    Page_options page = page_of(128);
    spoil(page);
    try {
      (void)Horizon_packer().pack(charts, page, Execution(1));
      ADD_FAILURE() << "nobody noticed: " << argument;
    } catch (const Invalid_argument& error) {
      EXPECT_EQ(error.argument(), argument) << error.what();
    }
  }
  EXPECT_NO_THROW(check(page_of(65536, 32767), 3));
}

} // namespace
} // namespace Atlas
