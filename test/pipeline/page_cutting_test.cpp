// SPDX-License-Identifier: MIT
// Charts that are cut or enlarged for their pages.
#include <Atlas/generate_atlas.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/segmentation/Patch_segmentation.h>

#include "segmentation_shapes.h"
#include "test_meshes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <utility>
#include <vector>

namespace Atlas::test {
namespace {

/// A flat surface of unit squares, those of a grid that are in.
template <typename IsIn>
Soup squares(int columns, int rows, IsIn is_in)
{
  Soup soup;
  std::map<std::pair<int, int>, Index> number;
  const auto at = [&](int x, int y) {
    const auto [it, is_new] = number.try_emplace({x, y}, static_cast<Index>(soup.points.size()));
    if (is_new)
      soup.points.emplace_back(x, y, 0);
    return it->second;
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      if (is_in(x, y)) {
        const Index a = at(x, y), b = at(x + 1, y), c = at(x + 1, y + 1), d = at(x, y + 1);
        soup.polygons.insert(soup.polygons.end(), {{a, b, c}, {a, c, d}});
      }
  return soup;
}

Soup frame()
{
  return squares(10, 10, [](int x, int y) { return x < 2 || y < 2 || x > 7; });
}

struct Result
{
  Atlas_report report;
  std::vector<Point_2> uv;
};

template <typename Parameters>
Result atlas_of(const Surface& surface, const Parameters& np)
{
  Result r;
  r.report = generate_atlas(surface, r.uv, np.packer(Horizon_packer()));
  return r;
}

TEST(MinCoverage, ChartsAreCutUntilThePageIsThatFull)
{
  const Surface surface = surface_of(frame());
  const auto plain = parameters::texture_size(256).seam_exchange_rate(0);
  const Result before = atlas_of(surface, plain);
  ASSERT_TRUE(before.report.is_valid());
  EXPECT_LT(before.report.packing_efficiency, 0.6);
  EXPECT_EQ(before.report.coverage_outcome, Coverage_outcome::not_asked_for);
  const Result after = atlas_of(surface, plain.min_coverage(0.7));
  ASSERT_TRUE(after.report.is_valid());
  EXPECT_EQ(after.report.coverage_outcome, Coverage_outcome::kept);
  EXPECT_GE(after.report.packing_efficiency, 0.7);
  EXPECT_EQ(after.report.pieces_cut_for_pages, after.report.charts.size() - before.report.charts.size());
  EXPECT_GT(after.report.pieces_cut_for_pages, 0u);
  // Pieces are as flat as the whole.
  EXPECT_LT(after.report.distortion.symmetric_dirichlet_mean,
            before.report.distortion.symmetric_dirichlet_mean + 1e-6);
  // Two cuts across the sides of the frame would do: nobody needs ten.
  EXPECT_LE(after.report.seam_length, before.report.seam_length + 10);
}

TEST(MinCoverage, DoesNotDependOnTheNumberOfThreads)
{
  const Surface surface = surface_of(frame());
  const auto np = parameters::texture_size(256).min_coverage(0.7);
  EXPECT_EQ(atlas_of(surface, np.number_of_threads(1)).uv, atlas_of(surface, np.number_of_threads(3)).uv);
}

TEST(MinCoverage, WhereNothingMayBeCutTheReportSaysSo)
{
  Surface surface = surface_of(frame());
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::no_seam);
  const Result r = atlas_of(surface, parameters::texture_size(256).min_coverage(0.7));
  ASSERT_TRUE(r.report.is_valid());
  EXPECT_EQ(r.report.coverage_outcome, Coverage_outcome::no_cut_helps);
  EXPECT_EQ(r.report.pieces_cut_for_pages, 0u);
  EXPECT_LT(r.report.packing_efficiency, 0.7);
}

TEST(MinCoverage, FacesStayWhole)
{
  Soup soup = frame();
  for (std::size_t i = 0; i + 1 < soup.polygons.size(); ++i) { // quadrilaterals: a b c, a c d
    soup.polygons[i].push_back(soup.polygons[i + 1][2]);
    soup.polygons.erase(soup.polygons.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  const Surface surface = surface_of(soup);
  const Result r = atlas_of(surface, parameters::texture_size(256).min_coverage(0.7));
  ASSERT_TRUE(r.report.is_valid());
  EXPECT_GT(r.report.charts.size(), 1u);
  for (std::size_t t = 1; t < surface.face.size(); ++t)
    if (surface.face[t] == surface.face[t - 1]) {
      EXPECT_EQ(r.report.segmentation.chart[t], r.report.segmentation.chart[t - 1]);
    }
}

// A face whose corners repeat has flat triangles that hang together with nothing once their chart stands
// alone.
TEST(SeamExchangeRate, FacesWithRepeatedVerticesStayWhole)
{
  Soup soup;
  soup.points = {{0, 0, 0}, {3, 2, 0}, {3, 3, 0}, {2, 1, 0}, {1, 2, 0}, {0, 3, 0}};
  soup.polygons = {{0, 1, 2, 3, 4, 5}, {3, 2, 1, 3, 3, 0}, {4, 2, 3}};
  const Result r = atlas_of(surface_of(soup), parameters::texture_size(32).gutter(1));
  EXPECT_TRUE(r.report.is_valid());
  EXPECT_LE(r.report.charts.size(), soup.polygons.size());
}

TEST(SeamExchangeRate, AStripThatSetsTheDensityIsCut)
{
  const Surface strip = surface_of(squares(60, 1, [](int, int) { return true; }));
  const auto np = parameters::texture_size(512);
  const Result never = atlas_of(strip, np.seam_exchange_rate(0)), usual = atlas_of(strip, np);
  ASSERT_TRUE(never.report.is_valid() && usual.report.is_valid());
  EXPECT_EQ(never.report.charts.size(), 1u);
  EXPECT_GT(usual.report.pieces_cut_for_pages, 3u);
  EXPECT_GT(usual.report.density, 3 * never.report.density);
  EXPECT_EQ(atlas_of(strip, np.seam_exchange_rate(1e6)).report.charts.size(), 1u);
}

/// Frames of two widths fill five sixths and three fifths of their squares.
TEST(SeamExchangeRate, FramesStayWholeButForARateOfOnesOwn)
{
  const auto report_of = [](int width, const auto& wish) {
    const auto is_in = [width](int x, int y) { return std::min({x, y, 15 - x, 15 - y}) < width; };
    std::vector<Point_2> uv;
    return generate_atlas(surface_of(squares(16, 16, is_in)), uv, wish);
  };
  const auto np = parameters::texture_size(256);
  const Atlas_report full = report_of(5, np), usual = report_of(3, np);
  ASSERT_TRUE(full.is_valid() && usual.is_valid());
  EXPECT_GT(full.packing_efficiency, default_full_coverage);
  EXPECT_LT(usual.packing_efficiency, default_full_coverage);
  EXPECT_EQ(full.pieces_cut_for_pages, 0u);
  EXPECT_EQ(usual.pieces_cut_for_pages, 0u);
  EXPECT_GT(report_of(3, np.seam_exchange_rate(0.1)).pieces_cut_for_pages, 3u);
}

/// The sides of these cylinders are strips of two to three squares, which leave half of a page empty.
TEST(SeamExchangeRate, RatherEmptyPagesAreFilledIfThatPays)
{
  for (const double height : {2.25, 2.5}) {
    const Surface cylinder = surface_of(lathe({{0, 0}, {1, 0}, {1, height}, {0, height}}, 32, 4));
    const auto report_of = [&](const auto& wish) {
      std::vector<Point_2> uv;
      return generate_atlas(cylinder, uv, wish);
    };
    const auto np = parameters::texture_size(256);
    const Atlas_report never = report_of(np.seam_exchange_rate(0)), usual = report_of(np);
    ASSERT_TRUE(never.is_valid() && usual.is_valid());
    EXPECT_LT(never.packing_efficiency, default_empty_coverage);
    EXPECT_GE(usual.packing_efficiency, default_empty_coverage - 1e-3) << "but for rounding";
    EXPECT_GT(usual.seam_length, never.seam_length);
    EXPECT_LE(usual.seam_length, (1 + default_added_seam_of_empty_pages) * never.seam_length);
    const double added = usual.seam_length / never.seam_length - 1;
    EXPECT_GE(usual.density, (1 + seam_exchange_rate(Atlas_mode::standard) * added) * never.density);
    EXPECT_EQ(usual.coverage_outcome, Coverage_outcome::not_asked_for);
  }
}

/// A rectangle has no seam within: any cut would be more than the share of it that an empty page is worth.
TEST(SeamExchangeRate, WhatHasNoSeamsStaysWholeOnAnEmptyPage)
{
  const Surface surface = surface_of(squares(20, 10, [](int, int) { return true; }));
  const Result usual = atlas_of(surface, parameters::texture_size(256));
  ASSERT_TRUE(usual.report.is_valid());
  EXPECT_LT(usual.report.packing_efficiency, default_empty_coverage);
  EXPECT_EQ(usual.report.charts.size(), 1u);
}

TEST(Density, ChartsLargerThanThePageAreCut)
{
  const Surface strip = surface_of(squares(60, 1, [](int, int) { return true; }));
  Page_options page;
  page.width = page.height = 256;
  page.density = 20;
  const auto np = parameters::page_options(page);
  const Result never = atlas_of(strip, np.seam_exchange_rate(0)), usual = atlas_of(strip, np);
  ASSERT_TRUE(never.report.is_valid() && usual.report.is_valid());
  EXPECT_LT(never.report.density, 19);
  EXPECT_NEAR(usual.report.density, 20, 1e-6);
  EXPECT_GE(usual.report.pieces_cut_for_pages, 3u);
  EXPECT_LE(usual.report.pieces_cut_for_pages, 8u);
}

TEST(SeamExchangeRate, WhoSaysWhichChartsThereAreGetsThem)
{
  const Surface strip = surface_of(squares(60, 1, [](int, int) { return true; }));
  const auto np = parameters::texture_size(512);
  const auto pieces = [&](const auto& wish) { return atlas_of(strip, wish).report.pieces_cut_for_pages; };
  EXPECT_EQ(pieces(np.mode(Atlas_mode::few_seams)), 0u);
  EXPECT_EQ(pieces(np.max_charts(1)), 0u);
  EXPECT_EQ(pieces(np.segmentation(Patch_segmentation())), 0u);
  EXPECT_GT(pieces(np.segmentation(Patch_segmentation()).seam_exchange_rate(1)), 3u);
}

/// A surface with much less seam than it has room: cuts that pay stop where they no longer do.
TEST(SeamExchangeRate, WhatIsAddedStaysSmall)
{
  const Surface surface = surface_of(squares(24, 24, [](int x, int y) { return x % 8 < 3 || y > 20; }));
  const auto np = parameters::texture_size(256);
  const Result never = atlas_of(surface, np.seam_exchange_rate(0)), usual = atlas_of(surface, np);
  ASSERT_TRUE(never.report.is_valid() && usual.report.is_valid());
  double border = 0; // of the surface: what seams there are before the cuts
  for (Index h = 0; h < surface.opposite.size(); ++h)
    border += surface.opposite[h] == no_index ? 1 : 0; // its edges are of length 1
  const double added = usual.report.seam_length - never.report.seam_length;
  EXPECT_LE(added, 0.12 * border / 2);
  if (usual.report.pieces_cut_for_pages > 0) {
    EXPECT_GT(usual.report.density, (1 + 0.5 * added / (border / 2)) * never.report.density);
  }
}

TEST(MinTexelsPerChart, SmallChartsAreEnlarged)
{
  Soup soup = squares(10, 10, [](int, int) { return true; });
  for (int i = 0; i < 5; ++i) {
    const auto first = static_cast<Index>(soup.points.size());
    const double x = 20 + i;
    soup.points.insert(soup.points.end(), {{x, 0, 0}, {x + 0.05, 0, 0}, {x + 0.05, 0.05, 0}, {x, 0.05, 0}});
    soup.polygons.push_back({first, first + 1, first + 2, first + 3});
  }
  const Surface surface = surface_of(soup);
  const auto np = parameters::texture_size(128);
  const auto least = [](const Result& r) {
    double texels = 1e9;
    for (const Chart_report& chart : r.report.charts)
      texels = std::min(texels, chart.distortion.area_uv);
    return texels;
  };
  const Result plain = atlas_of(surface, np), enlarged = atlas_of(surface, np.min_texels_per_chart(12));
  ASSERT_TRUE(plain.report.is_valid() && enlarged.report.is_valid());
  EXPECT_LT(least(plain), 3);
  EXPECT_EQ(plain.report.enlarged_charts, 0u);
  EXPECT_GE(least(enlarged), 12);
  EXPECT_EQ(enlarged.report.enlarged_charts, 5u);
}

} // namespace
} // namespace Atlas::test
