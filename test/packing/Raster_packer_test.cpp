// SPDX-License-Identifier: MIT
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/internal/pages/single_layout.h>
#include <Atlas/packing/internal/raster/Raster_page.h>
#include <Atlas/packing/pack_charts.h>

#include "short_raster_packer.h"
#include "test_charts.h"
#include "test_meshes.h"

namespace Atlas {
namespace {

using namespace test;

Page_options page_of(Index size, double gutter = 2)
{
  Page_options page;
  page.width = page.height = size;
  page.gutter = gutter;
  return page;
}

void expect_clear(const std::vector<Chart>& charts, const Packing& packing, const Page_options& page,
                  double gutter)
{
  const Packing_clearance clearance = packing_clearance(charts, packing, page, gutter);
  EXPECT_GE(clearance.charts, gutter);
  EXPECT_GE(clearance.border, gutter / 2);
}

/// From 0 to n - 1.
Index pick(std::mt19937& random, Index n)
{
  return static_cast<Index>(random() % n);
}

/// A mask of one run in each row, with a ring of which nothing counts.
internal::Raster_mask random_mask(std::mt19937& random)
{
  internal::Raster_mask mask;
  mask.width = 1 + pick(random, 30);
  mask.height = 1 + pick(random, 9);
  for (Index row = 0; row < mask.height; ++row) {
    const Index begin = pick(random, mask.width);
    mask.runs.push_back({row, begin, begin + 1 + pick(random, mask.width - begin)});
  }
  mask.ring.assign((mask.height + 2 * mask.ring_width) * mask.ring_words(), 0);
  return mask;
}

/// The first place of the mask from below and from the left, pixel by pixel; x beyond the page if there is
/// none.
std::array<Index, 2> first_place(const std::vector<std::vector<bool>>& is_free,
                                 const internal::Raster_mask& mask)
{
  const Index rows = static_cast<Index>(is_free.size()), columns = static_cast<Index>(is_free[0].size());
  for (Index y = 0; y + mask.height <= rows; ++y)
    for (Index x = 0; x + mask.width <= columns; ++x)
      if (std::all_of(mask.runs.begin(), mask.runs.end(), [&](const auto& run) {
            const auto row = is_free[y + run.row].begin() + x;
            return std::all_of(row + run.begin, row + run.end, [](bool b) { return b; });
          }))
        return {x, y};
  return {columns, rows};
}

TEST(Raster_page, finds_what_a_search_by_pixels_finds)
{
  std::mt19937 random(7);
  for (const Index columns : {40, 60, 61, 100, 124, 125, 170, 188, 189, 230, 252, 253, 300})
    for (int k = 0; k < 60; ++k) {
      const Index rows = 12;
      internal::Raster_page page(columns, rows);
      std::vector<std::vector<bool>> is_free(rows, std::vector<bool>(columns, true));
      for (int i = 0; i < 3 * k; ++i) {
        const Index x = pick(random, columns), y = pick(random, rows);
        page.put_pixel(x, y);
        is_free[y][x] = false;
      }
      page.update();
      const internal::Raster_mask mask = random_mask(random);
      std::uint64_t work = 0;
      const auto found = page.search(mask, 0, rows, -1, work);
      const auto [x, y] = first_place(is_free, mask);
      ASSERT_EQ(found.has_value(), x < columns);
      if (found) {
        EXPECT_EQ(found->x, x + internal::Raster_page::border);
        EXPECT_EQ(found->y, y + internal::Raster_page::border);
      }
    }
}

/// By trying very many turns.
double scale_by_trials(const std::vector<internal::Vec2>& hull, double width, double height)
{
  double best = 0;
  for (int k = 0; k < 20000; ++k) {
    const double a = M_PI * k / 20000;
    const internal::Vec2 size = internal::size_along(hull, {std::cos(a), std::sin(a)});
    best = std::max(best, std::min(width / size.x, height / size.y));
  }
  return best;
}

TEST(largest_scale_alone, is_what_no_turn_exceeds)
{
  using internal::Vec2;
  for (const Vec2 box : {Vec2{1, 1}, Vec2{2, 1}, Vec2{10, 0.1}})
    for (const double height : {100.0, 40.0}) {
      const std::vector<Vec2> hull{{0, 0}, {box.x, 0}, {0.8 * box.x, box.y}, {0, box.y}};
      const double scale = internal::largest_scale_alone(hull, 100, height),
                   tried = scale_by_trials(hull, 100, height);
      EXPECT_GE(scale, tried * (1 - 1e-9));
      EXPECT_LE(scale, tried * 1.001);
    }
}

/// The density at which each chart fits the page alone, within its margin.
double density_alone(const std::vector<Chart>& charts, const Page_options& page)
{
  double density = HUGE_VAL;
  for (const Chart& chart : charts) {
    std::vector<internal::Vec2> points;
    for (const Point_2& p : chart.uv)
      points.push_back({p.x(), p.y()});
    density =
        std::min(density, internal::largest_scale_alone(internal::convex_hull(std::move(points)),
                                                        page.width - page.gutter, page.height - page.gutter));
  }
  return density;
}

TEST(largest_scale_alone, is_never_below_what_a_packing_reaches)
{
  for (const Chart_family family : all_chart_families)
    for (const std::size_t n : {2, 3, 6}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(family) << " " << n);
      const std::vector<Chart> charts = random_charts(family, 29, n);
      const Page_options page = page_of(256, 3);
      const double most = density_alone(charts, page);
      EXPECT_LE(Raster_packer().pack(charts, page, Execution(1)).density, most * (1 + 1e-9));
      EXPECT_LE(Horizon_packer().pack(charts, page, Execution(1)).density, most * (1 + 1e-9));
    }
}

/// A chart that is as long as the page, and parallel to it, leaves nothing to search for.
TEST(Raster_packer, a_chart_that_is_too_long_lies_as_if_it_were_alone)
{
  const std::vector<Chart> charts{rectangle_chart(40, 0.5), rectangle_chart(2, 3)};
  const Page_options page = page_of(512, 4);
  const double alone = (page.width - page.gutter) / 40;
  const Packing packing = Raster_packer().pack(charts, page, Execution(1));
  EXPECT_GE(packing.density, 0.999 * alone);
  EXPECT_LE(packing.density, (1 + 1e-9) * alone);
  expect_clear(charts, packing, page, 4);
}

TEST(Raster_packer, is_never_below_the_horizon_and_keeps_the_gutter)
{
  for (const Chart_family family : all_chart_families) {
    SCOPED_TRACE(static_cast<int>(family));
    const std::vector<Chart> charts = random_charts(family, 17, 5);
    const Page_options page = page_of(256, 3);
    const Packing packing = Raster_packer().pack(charts, page, Execution(2));
    expect_clear(charts, packing, page, 3);
    EXPECT_GE(packing.density, Horizon_packer().pack(charts, page, Execution(2)).density);
    EXPECT_GE(packing.gutter, 3 - 1e-9);
  }
}

TEST(Raster_packer, is_monotone_in_effort_and_the_same_for_any_number_of_threads)
{
  const std::vector<Chart> charts = random_charts(Chart_family::blobs, 3, 12);
  const Page_options page = page_of(512);
  const Packing fast = Raster_packer(Packing_effort::fast).pack(charts, page, Execution(1));
  const Packing normal = Raster_packer(Packing_effort::normal).pack(charts, page, Execution(1));
  const Packing threads = Raster_packer(Packing_effort::normal).pack(charts, page, Execution(3));
  EXPECT_GE(normal.density, fast.density);
  expect_clear(charts, normal, page, 2);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    EXPECT_EQ(normal.placements[i].a, threads.placements[i].a);
    EXPECT_EQ(normal.placements[i].b, threads.placements[i].b);
    EXPECT_EQ(normal.placements[i].x, threads.placements[i].x);
    EXPECT_EQ(normal.placements[i].y, threads.placements[i].y);
  }
  EXPECT_GT(efficiency(charts, normal, page),
            1.25 * efficiency(charts, Horizon_packer().pack(charts, page, Execution(1)), page));
}

TEST(Raster_packer, keeps_every_chart_and_the_gutter_on_many_sets)
{
  double sum[2] = {};
  for (const Chart_family family : all_chart_families)
    for (unsigned seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE("family " + std::to_string(int(family)) + " seed " + std::to_string(seed));
      const std::vector<Chart> charts = random_charts(family, 100 + seed, 1 + seed % 7);
      const Page_options page{seed % 2 ? 128u : 100u, seed % 3 ? 128u : 60u, 1.0 + seed % 3};
      const Packing less = Short_raster_packer{1}.pack(charts, page, Execution(1)),
                    more = Short_raster_packer{3}.pack(charts, page, Execution(1 + seed % 5));
      ASSERT_EQ(more.placements.size(), charts.size());
      for (const Placement& p : more.placements)
        EXPECT_NEAR(std::hypot(p.a, p.b), more.density, 1e-9 * more.density);
      expect_clear(charts, less, page, page.gutter);
      expect_clear(charts, more, page, page.gutter);
      EXPECT_GE(more.density, less.density);
      EXPECT_GE(less.density, Horizon_packer().pack(charts, page, Execution(1)).density);
      sum[0] += less.density / less.density;
      sum[1] += more.density / less.density;
      if (seed % 5 == 4) {
        const Packing again = Short_raster_packer{3}.pack(charts, page, Execution(2));
        for (std::size_t i = 0; i < charts.size(); ++i)
          EXPECT_TRUE(again.placements[i].a == more.placements[i].a &&
                      again.placements[i].x == more.placements[i].x);
      }
    }
  EXPECT_GT(sum[1], sum[0]); // more work is worth something
}

TEST(Raster_packer, places_a_single_chart_at_the_largest_scale_of_all_turns)
{
  for (const Chart_family family : {Chart_family::blobs, Chart_family::needles, Chart_family::rings,
                                    Chart_family::spirals, Chart_family::one_huge_many_tiny})
    for (unsigned seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE("family " + std::to_string(int(family)) + " seed " + std::to_string(seed));
      const std::vector<Chart> charts = random_charts(family, 40 + seed, 1);
      Page_options page{seed % 2 ? 128u : 100u, seed % 3 ? 128u : 60u, 1.0 + seed % 3};
      page.rotation = Chart_rotation::free;
      const Packing packing = Raster_packer().pack(charts, page, Execution(1));
      expect_clear(charts, packing, page, page.gutter);
      const auto fits = [&](double angle) {
        double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
        for (const Point_2& p : charts[0].uv)
          for (int k : {0, 1}) {
            const double x = std::cos(angle + k * M_PI / 2) * p.x() - std::sin(angle + k * M_PI / 2) * p.y();
            low[k] = std::min(low[k], x);
            high[k] = std::max(high[k], x);
          }
        return std::min((page.width - page.gutter) / (high[0] - low[0]),
                        (page.height - page.gutter) / (high[1] - low[1]));
      };
      double best = 0;
      constexpr int turns = 2000;
      for (int k = 0; k < turns; ++k)
        best = std::max(best, fits(k * 2 * M_PI / turns));
      const Placement& p = packing.placements[0];
      EXPECT_NEAR(fits(std::atan2(p.b, p.a)), packing.density, 1e-5 * best);
      EXPECT_GT(packing.density, (1 - 1e-5) * best);
    }
}

TEST(Raster_packer, puts_small_charts_into_holes)
{
  // A frame and a square that fits its hole: side by side they would need a third more.
  const std::vector<Chart> charts{ring_chart(8, 10, 64), ring_chart(3, 6, 64)};
  const Page_options page = page_of(256);
  const Packing packing = Raster_packer().pack(charts, page, Execution(1));
  EXPECT_GT(packing.density * 20, 250);
  expect_clear(charts, packing, page, 2);
}

TEST(Raster_packer, keeps_folded_charts_apart)
{
  // The third triangle lies over the first two.
  const Chart folded =
      flat_chart({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.9, 0.4}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  const std::vector<Chart> charts(6, folded);
  const Page_options page = page_of(128);
  expect_clear(charts, Raster_packer().pack(charts, page, Execution(1)), page, 2);
}

TEST(Page_options, turns_charts_only_as_allowed)
{
  const std::vector<Chart> charts = random_charts(Chart_family::blobs, 4, 15);
  Page_options page = page_of(256);
  page.rotation = Chart_rotation::none;
  Packing packing = Short_raster_packer{1}.pack(charts, page, Execution(1));
  for (const Placement& p : packing.placements)
    EXPECT_TRUE(p.b == 0 && p.a > 0);
  expect_clear(charts, packing, page, 2);
  page.rotation = Chart_rotation::quarter_turns;
  packing = Short_raster_packer{1}.pack(charts, page, Execution(1));
  for (const Placement& p : packing.placements)
    EXPECT_TRUE(p.a == 0 || p.b == 0);
  expect_clear(charts, packing, page, 2);
}

TEST(Page_options, widens_the_gutter_for_mip_levels_and_blocks)
{
  const std::vector<Chart> charts = random_charts(Chart_family::blobs, 5, 8);
  Page_options page = page_of(256);
  page.mip_levels = 3;
  expect_clear(charts, Short_raster_packer{1}.pack(charts, page, Execution(1)), page, 8);
  page.mip_levels = 0;
  page.block = 4;
  expect_clear(charts, Short_raster_packer{1}.pack(charts, page, Execution(1)), page, 4 * std::sqrt(2));
}

TEST(Page_options, fills_as_many_pages_as_a_density_takes)
{
  const std::vector<Chart> charts = random_charts(Chart_family::blobs, 6, 30);
  Page_options page = page_of(128);
  page.density = 36;
  const Packing packing = Short_raster_packer{1}.pack(charts, page, Execution(1));
  EXPECT_NEAR(packing.density, 36, 1e-9);
  EXPECT_GT(packing.number_of_pages, 2u);
  expect_clear(charts, packing, page, 2);
  std::set<Index> used;
  for (const Placement& p : packing.placements) {
    EXPECT_NEAR(std::hypot(p.a, p.b), 36, 1e-9);
    used.insert(p.page);
  }
  EXPECT_EQ(used.size(), packing.number_of_pages);
  // A chart that is larger than a page lowers the density.
  page.density = 1e4;
  const Packing lowered = Horizon_packer().pack(charts, page, Execution(1));
  EXPECT_LT(lowered.density, 1e4);
  EXPECT_GT(lowered.density, 0);
  expect_clear(charts, lowered, page, 2);
}

TEST(Page_options, spreads_charts_over_several_pages)
{
  const std::vector<Chart> charts = random_charts(Chart_family::blobs, 7, 20);
  Page_options page = page_of(128);
  const Packing one = Short_raster_packer{1}.pack(charts, page, Execution(1));
  page.pages = 4;
  const Packing four = Short_raster_packer{1}.pack(charts, page, Execution(1));
  EXPECT_EQ(four.number_of_pages, 4u);
  EXPECT_GT(four.density, 1.5 * one.density);
  for (const Placement& p : four.placements)
    EXPECT_NEAR(std::hypot(p.a, p.b), four.density, 1e-9 * four.density);
  expect_clear(charts, four, page, 2);
  EXPECT_EQ(udim_tile(0), 1001u);
  EXPECT_EQ(udim_tile(9), 1010u);
  EXPECT_EQ(udim_tile(10), 1011u);
}

TEST(Page_options, weighs_densities)
{
  const std::vector<Chart> charts(4, rectangle_chart(1, 2));
  Page_options page = page_of(128);
  page.weights = {1, 2, 0.5, 1};
  const Packing packing = Short_raster_packer{1}.pack(charts, page, Execution(1));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(std::hypot(packing.placements[i].a, packing.placements[i].b),
                packing.density * page.weights[i], 1e-9 * packing.density);
  expect_clear(charts, packing, page, 2);
}

TEST(Page_options, moves_groups_as_one)
{
  std::vector<Chart> charts = random_charts(Chart_family::blobs, 8, 6);
  for (Point_2& p : charts[1].uv)
    p = Point_2(p.x() + 3, p.y());
  Page_options page = page_of(256);
  page.groups = {7, 7, no_index, no_index, no_index, no_index};
  const Packing packing = Short_raster_packer{1}.pack(charts, page, Execution(1));
  EXPECT_EQ(packing.placements[0].a, packing.placements[1].a);
  EXPECT_EQ(packing.placements[0].x, packing.placements[1].x);
  EXPECT_NE(packing.placements[0].x, packing.placements[2].x);
  expect_clear(charts, packing, page, 2);
}

TEST(Page_options, stacks_copies_on_request)
{
  std::mt19937 random(11);
  const Chart model = blob_chart(random, 1);
  Chart turned = model, mirrored = model;
  for (Point_2& p : turned.uv)
    p = Point_2(5 - p.y(), 2 + p.x());
  for (Point_2& p : mirrored.uv)
    p = Point_2(-p.x(), p.y());
  for (auto& t : mirrored.triangles)
    std::swap(t[1], t[2]);
  const std::vector<Chart> charts{model, turned, mirrored, blob_chart(random, 1)};
  Page_options page = page_of(256);
  const auto same_place = [&](const Packing& packing, std::size_t i) {
    for (std::size_t v = 0; v < model.uv.size(); ++v)
      if (CGAL::squared_distance(packing.placements[0](charts[0].uv[v]),
                                 packing.placements[i](charts[i].uv[v])) > 1e-6)
        return false;
    return true;
  };
  const Packing apart = Raster_packer().pack(charts, page, Execution(1));
  EXPECT_FALSE(same_place(apart, 1));
  page.stacking = Chart_stacking::copies;
  const Packing copies = Raster_packer().pack(charts, page, Execution(1));
  EXPECT_TRUE(same_place(copies, 1));
  EXPECT_FALSE(same_place(copies, 2));
  page.stacking = Chart_stacking::copies_and_mirrored;
  const Packing all = Raster_packer().pack(charts, page, Execution(1));
  EXPECT_TRUE(same_place(all, 1));
  EXPECT_TRUE(same_place(all, 2));
  EXPECT_FALSE(same_place(all, 3));
  EXPECT_GT(all.density, copies.density);
  expect_clear({charts[0], charts[3]}, {{all.placements[0], all.placements[3]}, 1, all.density, 2}, page, 2);
}

TEST(Page_options, packs_around_locked_charts)
{
  std::vector<Chart> charts = random_charts(Chart_family::blobs, 9, 8);
  charts.push_back(rectangle_chart(3, 1));
  charts.push_back(ring_chart(8, 10, 48));
  Page_options page = page_of(256, 3);
  page.locked.resize(charts.size());
  page.locked[8] = Placement{20, 15, 150, 180, 0, true};
  page.locked[9] = Placement{7, 0, 90, 90};
  const auto expect_locked = [&](const Packing& packing, double density) {
    ASSERT_EQ(packing.placements.size(), charts.size());
    expect_clear(charts, packing, page, 3);
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_NEAR(std::hypot(packing.placements[i].a, packing.placements[i].b), density, 1e-9 * density);
    for (const std::size_t i : {8u, 9u}) {
      EXPECT_EQ(packing.placements[i].a, page.locked[i]->a);
      EXPECT_EQ(packing.placements[i].x, page.locked[i]->x);
      EXPECT_EQ(packing.placements[i].y, page.locked[i]->y);
      EXPECT_EQ(packing.placements[i].page, page.locked[i]->page);
    }
  };
  const Packing one = Raster_packer().pack(charts, page, Execution(1));
  EXPECT_EQ(one.number_of_pages, 1u);
  EXPECT_EQ(one.gutter, 3);
  expect_locked(one, one.density);
  // About half of the page is free, the hole of the ring included.
  EXPECT_GT(efficiency({charts.begin(), charts.begin() + 8}, one, page), 0.2);
  const Packing threads = Raster_packer().pack(charts, page, Execution(3));
  for (std::size_t i = 0; i < charts.size(); ++i)
    EXPECT_EQ(one.placements[i].x, threads.placements[i].x);

  page.density = 2 * one.density; // the page with the ring is too small for the largest of these
  const Packing dense = Horizon_packer().pack(charts, page, Execution(1));
  EXPECT_GT(dense.number_of_pages, 1u);
  expect_locked(dense, page.density);

  page.density = 0;
  page.locked[8]->page = 3;
  const Packing far = Horizon_packer().pack(charts, page, Execution(1));
  EXPECT_EQ(far.number_of_pages, 4u);
  expect_locked(far, far.density);

  page.locked.assign(charts.size(), page.locked[9]); // nothing is left to pack
  EXPECT_EQ(Raster_packer().pack(charts, page, Execution(1)).placements[3].x, 90);
}

TEST(Page_options, takes_locked_charts_on_far_pages)
{
  std::vector<Chart> charts = random_charts(Chart_family::blobs, 9, 3);
  Page_options page = page_of(128);
  page.locked.resize(charts.size());
  const Index far = no_index - 1; // a list with an entry per page would not fit into memory
  page.locked[1] = Placement{20, 0, 60, 60, far};
  for (const double density : {0.0, 10.0}) {
    page.density = density;
    const Packing packing = Horizon_packer().pack(charts, page, Execution(1));
    EXPECT_EQ(packing.number_of_pages, no_index);
    EXPECT_EQ(packing.placements[1].page, far);
    EXPECT_EQ(packing.placements[0].page, 0u);
    EXPECT_EQ(packing.placements[2].page, 0u);
    expect_clear(charts, packing, page, 2);
  }
  page.locked[1]->page = no_index;
  EXPECT_ANY_THROW((void)Horizon_packer().pack(charts, page, Execution(1)));
}

/// Locked charts do not take the other pages away.
TEST(Page_options, uses_free_pages_beside_locked_charts)
{
  const std::vector<Chart> charts{rectangle_chart(1, 1), rectangle_chart(1, 1)};
  Page_options page = page_of(64);
  page.pages = 2;
  page.locked = {Placement{62, 0, 1, 1}, std::nullopt}; // the first page is full
  const Packing packing = Horizon_packer().pack(charts, page, Execution(1));
  ASSERT_EQ(packing.number_of_pages, 2u);
  EXPECT_EQ(packing.placements[1].page, 1u);
  EXPECT_GT(packing.density, 40); // diagonals stand upright
}

/// The engine of the horizon that counts what is asked of it.
struct Counting_engine
{
  int* attempts;

  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const
  {
    ++*attempts;
    return Horizon_packer().lay_out(task, execution);
  }
};

TEST(Page_options, fills_many_pages_with_few_attempts)
{
  for (const Index height : {64u, 150u}) {
    const std::vector<Chart> charts = random_charts(Chart_family::blobs, 21, 400);
    Page_options page{64, height, 1};
    page.density = 15;
    int attempts = 0;
    const Packing packing = Page_packer(Counting_engine{&attempts}).pack(charts, page, Execution(1));
    EXPECT_DOUBLE_EQ(packing.density, 15);
    EXPECT_GT(packing.number_of_pages, 15u);
    EXPECT_LT(attempts, 3.5 * packing.number_of_pages);
    expect_clear(charts, packing, page, 1);
    EXPECT_GT(efficiency(charts, packing, page) / packing.number_of_pages, 0.35);
  }
}

TEST(pack_charts, repacks_coordinates_of_corners)
{
  // Six quads that all lie on top of each other, as a careless tool leaves them.
  const Surface surface = surface_of(cube());
  std::vector<Point_2> uv;
  for (int f = 0; f < 6; ++f)
    uv.insert(uv.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  uv[0] = uv[1] = uv[2] = uv[3] = Point_2(std::nan(""), 0);
  const Page_options page = page_of(128);
  const Repacked_charts repacked = pack_charts(surface, uv, page);
  ASSERT_EQ(repacked.charts.size(), 5u);
  EXPECT_TRUE(std::isnan(repacked.uv[0].x()));
  expect_clear(repacked.charts, repacked.packing, page, 2);
  for (std::size_t c = 4; c < 24; c += 4) {
    const double side = std::sqrt(CGAL::squared_distance(repacked.uv[c], repacked.uv[c + 1]));
    EXPECT_NEAR(side * 128, repacked.packing.density, 1e-9 * repacked.packing.density);
    EXPECT_NEAR(CGAL::area(repacked.uv[c], repacked.uv[c + 1], repacked.uv[c + 2]), side * side / 2, 1e-9);
  }
}

} // namespace
} // namespace Atlas
