// SPDX-License-Identifier: MIT
// Properties that every packing has, on thousands of random sets of charts and pages. ATLAS_PACKING_CASES
// sets their number, ATLAS_PACKING_SEED the first of the seeds; a failure names the seed.
#include <Atlas/core/build_surface.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/pack_charts.h>

#include "packing_checks.h"
#include "short_raster_packer.h"
#include <cstdlib>
#include <functional>
#include <set>

namespace Atlas::test {
namespace {

unsigned from_environment(const char* name, unsigned otherwise)
{
  const char* text = std::getenv(name);
  return text ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : otherwise;
}

/// Runs `faults_of(seed)` for one in `share` of the cases, on all cores; it tells what is wrong, if anything.
void expect_no_faults(unsigned share, const std::function<std::string(unsigned)>& faults_of)
{
  const unsigned first = from_environment("ATLAS_PACKING_SEED", 1);
  std::vector<std::string> faults(std::max(from_environment("ATLAS_PACKING_CASES", 4000) / share, 1u));
  Execution(0).for_each(faults.size(),
                        [&](std::size_t i) { faults[i] = faults_of(first + static_cast<unsigned>(i)); });
  int shown = 0;
  for (std::size_t i = 0; i < faults.size(); ++i)
    if (!faults[i].empty() && ++shown <= 20)
      ADD_FAILURE() << "ATLAS_PACKING_CASES=" << share << " ATLAS_PACKING_SEED=" << first + i << ": "
                    << faults[i];
  EXPECT_EQ(shown, 0) << "of " << faults.size();
}

std::string faults_of(const Packing_case& c, const Packing& packing)
{
  return Packing_checker(c, packing)();
}

/// Packs with one thread, perhaps also with two, and checks.
template <typename Packer>
Packing checked(const char* name, const Packing_case& c, const Packer& packer, std::string& faults,
                bool is_repeated = true)
{
  const Packing packing = packer.pack(c.charts, c.page, Execution(1));
  std::string found = faults_of(c, packing);
  if (is_repeated && !are_equal(packer.pack(c.charts, c.page, Execution(2)), packing))
    found += "two threads make another packing; ";
  if (!found.empty())
    faults += name + (": " + found);
  return packing;
}

/// A packing is no looser than another: the gutter first, then the density.
void expect_not_looser(const char* what, const Packing& tight, const Packing& loose, std::string& faults)
{
  if (tight.gutter < loose.gutter || (tight.gutter == loose.gutter && tight.density < loose.density)) {
    std::ostringstream message;
    message << what << ": density " << tight.density << " below " << loose.density << ", gutter "
            << tight.gutter << " and " << loose.gutter << "; ";
    faults += message.str();
  }
}

TEST(Packing_property, of_rectangles_and_horizon)
{
  expect_no_faults(1, [](unsigned seed) {
    const Packing_case c = random_packing_case(seed);
    std::string faults;
    checked("rectangles", c, Rectangle_packer(), faults);
    checked("horizon", c, Horizon_packer(), faults);
    return faults;
  });
}

TEST(Packing_property, of_short_searches)
{
  expect_no_faults(20, [](unsigned seed) {
    const Packing_case c = random_packing_case(seed);
    std::string faults;
    const Packing horizon = Horizon_packer().pack(c.charts, c.page, Execution(1));
    const Packing less = checked("short", c, Short_raster_packer{1}, faults, seed % 4 == 0);
    expect_not_looser("short and horizon", less, horizon, faults);
    if (seed % 4 != 1)
      return faults;
    const Packing more = checked("longer", c, Short_raster_packer{3}, faults, false);
    expect_not_looser("longer and short", more, less, faults);
    return faults;
  });
}

TEST(Packing_property, of_all_efforts)
{
  expect_no_faults(200, [](unsigned seed) {
    const Packing_case c = random_packing_case(seed);
    std::string faults;
    const Packing fast = checked("fast", c, Raster_packer(Packing_effort::fast), faults);
    expect_not_looser("fast and horizon", fast, Horizon_packer().pack(c.charts, c.page, Execution(1)),
                      faults);
    if (seed % 5 != 0)
      return faults;
    const Packing normal = checked("normal", c, Raster_packer(Packing_effort::normal), faults);
    expect_not_looser("normal and fast", normal, fast, faults);
    if (seed % 20 != 0)
      return faults;
    const Packing best = Raster_packer(Packing_effort::best).pack(c.charts, c.page, Execution(1));
    faults += faults_of(c, best);
    expect_not_looser("best and normal", best, normal, faults);
    return faults;
  });
}

/// A density above and below what fits one page.
TEST(Packing_property, of_densities)
{
  expect_no_faults(10, [](unsigned seed) {
    Packing_case c = random_packing_case(seed);
    std::string faults;
    c.page.pages = 1;
    const double one_page = Horizon_packer().pack(c.charts, c.page, Execution(1)).density;
    if (!(one_page > 0))
      return faults;
    c.page.density = one_page * (0.3 + 0.1 * (seed % 23));
    for (const bool is_raster : {false, true}) {
      if (is_raster && seed % 8 != 0)
        continue;
      const Packing packing = is_raster ? checked("density, short", c, Short_raster_packer{1}, faults)
                                        : checked("density, horizon", c, Horizon_packer(), faults);
      if (!(packing.density <= c.page.density * (1 + 1e-9) &&
            packing.density >= std::min(c.page.density, one_page) * (1 - 2e-3)))
        faults += "the density is not that asked for; ";
      if (packing.number_of_pages > std::max<std::size_t>(1, c.charts.size()) ||
          (c.page.density < one_page && packing.number_of_pages > 1))
        faults += "too many pages; ";
    }
    return faults;
  });
}

/// Some charts stay where a first packing left them, a bit smaller, one of them on another page.
TEST(Packing_property, of_locked_charts)
{
  expect_no_faults(40, [](unsigned seed) {
    Packing_case c = random_packing_case(seed);
    std::string faults;
    c.page.groups.clear();
    c.page.stacking = Chart_stacking::none;
    const Packing first = Horizon_packer().pack(c.charts, c.page, Execution(1));
    c.page.locked.resize(c.charts.size());
    for (std::size_t i = seed % 3; i < c.charts.size(); i += 3) {
      Placement p = first.placements[i];
      p.x +=
          p.a * c.charts[i].uv[0].x() - p.b * c.charts[i].uv[0].y(); // half as large, the first corner stays
      p.y += p.b * c.charts[i].uv[0].x() + p.a * c.charts[i].uv[0].y();
      p.a /= 2;
      p.b /= 2;
      p.x -= p.a * c.charts[i].uv[0].x() - p.b * c.charts[i].uv[0].y();
      p.y -= p.b * c.charts[i].uv[0].x() + p.a * c.charts[i].uv[0].y();
      p.page += seed % 7 == 0 ? 1 : 0;
      c.page.locked[i] = p;
    }
    for (const double density : {0.0, 0.7 * first.density}) {
      c.page.density = density;
      if (checked("locked", c, Short_raster_packer{1}, faults, seed % 4 == 0).number_of_pages == 0 &&
          !c.charts.empty())
        faults += "no room beside charts of half the size; ";
    }
    return faults;
  });
}

/// The blocks of `size` texels squared that a chart meets, their borders included.
std::set<std::array<Index, 3>> blocks_of(const Stored_chart& chart, Index page, Index size)
{
  std::set<std::array<Index, 3>> blocks;
  for (const Stored_triangle& t : chart)
    for (double y = std::floor(t.low[1] / size) * size; y <= t.high[1]; y += size)
      for (double x = std::floor(t.low[0] / size) * size; x <= t.high[0]; x += size) {
        const Point_2 a(x, y), b(x + size, y), c(x + size, y + size), d(x, y + size);
        const Stored_triangle lower{{a, b, c}, {x, y}, {x + size, y + size}},
            upper{{a, c, d}, {x, y}, {x + size, y + size}};
        if (have_common_point(t, lower) || have_common_point(t, upper))
          blocks.insert({page, static_cast<Index>(x), static_cast<Index>(y)});
      }
  return blocks;
}

TEST(Packing_property, of_blocks)
{
  expect_no_faults(40, [](unsigned seed) {
    Packing_case c = random_packing_case(seed);
    c.page.block = 2 + seed % 4;
    c.page.gutter = 0;
    c.page.groups.clear();
    c.page.stacking = Chart_stacking::none;
    const Packing packing = Horizon_packer().pack(c.charts, c.page, Execution(1));
    if (packing.gutter < c.page.block * std::sqrt(2.0) * (1 - 1e-9)) // too small a page for the gutters
      return std::string();
    std::set<std::array<Index, 3>> all;
    std::size_t sum = 0;
    for (std::size_t i = 0; i < c.charts.size(); ++i) {
      const Stored_chart stored = stored_chart(c.charts[i], packing.placements[i], c.page);
      const auto blocks = blocks_of(stored, packing.placements[i].page, c.page.block);
      sum += blocks.size();
      all.insert(blocks.begin(), blocks.end());
    }
    return sum == all.size() ? std::string() : std::string("two charts share a block; ");
  });
}

/// Charts without triangles take no page, and do not disturb the others.
TEST(Packing_property, of_empty_charts)
{
  expect_no_faults(40, [](unsigned seed) {
    Packing_case c = random_packing_case(seed);
    std::string faults;
    c.page.weights.clear();
    c.page.groups.clear();
    c.page.stacking = Chart_stacking::none;
    if (c.charts.empty())
      return faults;
    for (const double density : {0.0, 1.0}) {
      c.page.density = density * Horizon_packer().pack(c.charts, c.page, Execution(1)).density;
      const Packing without = Horizon_packer().pack(c.charts, c.page, Execution(1));
      Packing_case d = c;
      for (Index i = 0; i < 1 + seed % 9; ++i)
        d.charts.insert(d.charts.begin() + static_cast<std::ptrdiff_t>(seed % (d.charts.size() + 1)),
                        Chart());
      const Packing with = checked("empty charts", d, Horizon_packer(), faults);
      if (with.density != without.density || with.number_of_pages != without.number_of_pages)
        faults += "charts without triangles change the packing; ";
    }
    return faults;
  });
}

/// Through the coordinates of corners.
TEST(Packing_property, of_repacked_coordinates)
{
  expect_no_faults(4, [](unsigned seed) {
    Packing_case c = random_packing_case(seed);
    std::vector<Point_3> points;
    std::vector<std::size_t> first{0};
    std::vector<Index> vertices;
    std::vector<Point_2> uv;
    for (const Chart& chart : c.charts) {
      for (const auto& triangle : chart.triangles) {
        for (const Index v : triangle) {
          vertices.push_back(static_cast<Index>(points.size() + v));
          uv.push_back(chart.uv[v]);
        }
        first.push_back(vertices.size());
      }
      for (std::size_t v = 0; v < chart.uv.size(); ++v) { // anywhere, as long as no triangle is flat
        const double k = static_cast<double>(points.size());
        points.emplace_back(k, k * k, k * k * k);
      }
    }
    const Surface surface = build_surface(points, first, vertices);
    const Repacked_charts repacked = pack_charts(surface, uv, c.page, Horizon_packer(), Execution(1));
    std::string faults;
    const std::vector<Chart> charts = std::exchange(c.charts, repacked.charts);
    if (charts.size() != c.charts.size())
      faults += "other charts; ";
    else
      faults += faults_of(c, repacked.packing);
    std::size_t corner = 0;
    for (std::size_t i = 0; i < charts.size() && faults.empty(); ++i)
      for (const auto& triangle : charts[i].triangles)
        for (const Index v : triangle) {
          const Placement& p = repacked.packing.placements[i];
          const Point_2 texel = p(charts[i].uv[v]), &got = repacked.uv[corner];
          if (repacked.page[corner++] != p.page ||
              std::hypot(got.x() * c.page.width - texel.x(), got.y() * c.page.height - texel.y()) > 1e-9)
            faults = "a corner is not where its chart is; ";
        }
    return faults;
  });
}

} // namespace
} // namespace Atlas::test
