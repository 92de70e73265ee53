// SPDX-License-Identifier: MIT
#include <Atlas/core/errors.h>
#include <Atlas/planar/internal/segments.h>
#include <Atlas/validation/Stencil_validator.h>
#include <Atlas/validation/internal/rendering/Stencil_painter.h>

#include "test_meshes.h"
#include <gtest/gtest.h>
#include <random>

namespace Atlas {
namespace {

using Pair = std::pair<Index, Index>;

/// How much a renderer may move a corner, in texels: it has a grid of at least 1/256, and works in 32 bits.
constexpr double slack = 1.0 / 128;

/// How deep a point lies in a triangle; negative: how far it is from it.
double depth(const Triangle_uv& t, const Point_2& p)
{
  const double area = CGAL::area(t[0], t[1], t[2]);
  const auto vector = [](const Point_2& q) { return internal::Vec2{q.x(), q.y()}; };
  double nearest = INFINITY;
  bool is_inside = area != 0;
  for (int i = 0; i < 3; ++i) {
    const Point_2 &a = t[i], &b = t[(i + 1) % 3];
    nearest = std::min(nearest, internal::squared_distance(vector(p), vector(a), vector(b)));
    is_inside = is_inside && CGAL::area(a, b, p) * area > 0;
  }
  return is_inside ? std::sqrt(nearest) : -std::sqrt(nearest);
}

/// The triangles in texels, as the checker places them.
std::vector<Triangle_uv> in_texels(std::vector<Triangle_uv> triangles, double resolution)
{
  internal::Box_2 box;
  for (const Triangle_uv& t : triangles)
    for (const Point_2& p : t)
      box.add(p.x(), p.y());
  const double side = std::max(box.x1 - box.x0, box.y1 - box.y0);
  for (Triangle_uv& t : triangles)
    for (Point_2& p : t)
      p = Point_2((p.x() - box.x0) / side * resolution, (p.y() - box.y0) / side * resolution);
  return triangles;
}

struct Disagreements
{
  std::size_t agreed = 0, sub_texel = 0, by_contact = 0;
};

/// Every pair that the exact search has and the stencil buffer has not must leave all texel centres uncovered
/// or on the rim; every pair the other way round must touch a texel centre in both triangles.
void compare(const std::vector<Triangle_uv>& triangles, Index resolution,
             internal::OSMesa_stencil& stencil_buffer, Disagreements& sum)
{
  const Overlaps exact = find_overlaps(triangles);
  const Stencil_overlaps stencil = internal::Stencil_painter(triangles, resolution, 16, stencil_buffer).run();
  ASSERT_TRUE(stencil.overlaps.is_complete);
  ASSERT_EQ(stencil.overlapped_texels > 0, !stencil.overlaps.pairs.empty());
  const std::vector<Triangle_uv> texels = in_texels(triangles, resolution);
  std::vector<std::vector<double>> depths(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (Index y = 0; y < resolution; ++y)
      for (Index x = 0; x < resolution; ++x)
        depths[t].push_back(depth(texels[t], Point_2(x + 0.5, y + 0.5)));
  const std::set<Pair> proved(exact.pairs.begin(), exact.pairs.end()),
      seen(stencil.overlaps.pairs.begin(), stencil.overlaps.pairs.end());
  for (Index s = 0; s < triangles.size(); ++s)
    for (Index t = s + 1; t < triangles.size(); ++t) {
      double common = -INFINITY; // depth of the texel centre deepest in both
      for (std::size_t i = 0; i < depths[s].size(); ++i)
        common = std::max(common, std::min(depths[s][i], depths[t][i]));
      const bool is_proved = proved.count({s, t}), is_seen = seen.count({s, t});
      if (is_proved && !is_seen) {
        ASSERT_LE(common, slack) << "not seen: " << s << ' ' << t;
        ++sum.sub_texel;
      } else if (is_seen && !is_proved) {
        ASSERT_GE(common, -slack) << "seen, but not there: " << s << ' ' << t;
        ++sum.by_contact;
      } else {
        sum.agreed += is_seen;
      }
    }
}

TEST(StencilValidator, AgreesWithTheExactSearchUpToATexel)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> real(0, 1);
  Disagreements sum;
  internal::OSMesa_stencil stencil_buffer(20);
  for (int layout = 0; layout < 4000; ++layout) {
    std::vector<Triangle_uv> triangles;
    const int count = 2 + layout % 6;
    for (int i = 0; i < count; ++i) {
      const auto somewhere = [&] { return Point_2(real(random), real(random)); };
      const auto on_grid = [&] { return Point_2(double(random() % 5), double(random() % 5)); };
      Triangle_uv t;
      if (layout % 4 == 0) { // anywhere
        t = {somewhere(), somewhere(), somewhere()};
      } else if (layout % 4 == 1) { // much contact, many without area
        t = {on_grid(), on_grid(), on_grid()};
      } else if (layout % 4 == 2) { // needles
        const Point_2 p = somewhere(), q = somewhere();
        t = {p, q, Point_2(q.x() + 0.02 * real(random), q.y() + 0.02 * real(random))};
      } else { // small ones, next to each other
        const Point_2 p = somewhere();
        const auto near = [&] { return Point_2(p.x() + 0.1 * real(random), p.y() + 0.1 * real(random)); };
        t = {p, near(), near()};
      }
      triangles.push_back(t);
    }
    ASSERT_NO_FATAL_FAILURE(compare(triangles, 12 + static_cast<Index>(layout % 9), stencil_buffer, sum))
        << "layout " << layout;
  }
  RecordProperty("agreed", static_cast<int>(sum.agreed));
  RecordProperty("sub_texel", static_cast<int>(sum.sub_texel));
  RecordProperty("by_contact", static_cast<int>(sum.by_contact));
  EXPECT_GT(sum.agreed, 1000u);
  EXPECT_GT(sum.sub_texel, 100u);
  EXPECT_LT(sum.by_contact, sum.agreed / 10);
}

/// A grid that is one-to-one is drawn without overlap, since edges are shared to the last digit.
TEST(StencilValidator, AcceptsWhatIsExactlyOneToOne)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (int trial = 0; trial < 10; ++trial) {
    Chart chart = test::chart_of(test::planar_grid(9, 9));
    for (const Point_3& p : chart.points)
      chart.uv.emplace_back(9 * p.x() + shift(random), 9 * p.y() + shift(random));
    ASSERT_TRUE(Exact_validator(0).validate(chart, Execution()).is_valid());
    EXPECT_TRUE(Stencil_validator(100, 0).validate(chart, Execution()).is_valid());
    EXPECT_EQ(Stencil_validator(100, 1.01).validate(chart, Execution()).status,
              Chart_status::area_ratio_exceeded);
  }
}

/// A ring sector of the given angle.
Chart sector(double angle)
{
  Chart chart = test::chart_of(test::grid(60, 3, [](double x, double y) { return Point_3(x, y, 0); }));
  for (const Point_3& p : chart.points)
    chart.uv.emplace_back((2 - p.y()) * std::sin(angle * p.x()), (2 - p.y()) * -std::cos(angle * p.x()));
  for (Point_2& p : chart.uv)
    p = Point_2(p.x(), p.y());
  return chart;
}

TEST(StencilValidator, OverlappedZoneAndSplit)
{
  for (const double angle : {6.0, 7.0, 9.0, 12.0}) {
    const Chart chart = sector(angle);
    const Chart_verdict stencil = Stencil_validator(512, 0).validate(chart, Execution());
    const Chart_verdict exact = Exact_validator(0).validate(chart, Execution());
    ASSERT_EQ(stencil.status, exact.status) << angle;
    // What the stencil shows is there; what it misses is small.
    EXPECT_TRUE(std::includes(exact.culprits.begin(), exact.culprits.end(), stencil.culprits.begin(),
                              stencil.culprits.end()));
    EXPECT_GE(stencil.culprits.size() + 12, exact.culprits.size());
    const std::vector<Index> parts = Stencil_validator(512, 0).split(chart, stencil);
    EXPECT_EQ(parts.size(), chart.number_of_triangles());
    EXPECT_EQ(*std::max_element(parts.begin(), parts.end()) >= 1, true);
  }
}

TEST(StencilValidator, TilesMakeNoDifference)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> real(0, 1);
  std::vector<Triangle_uv> triangles;
  for (int i = 0; i < 12; ++i)
    triangles.push_back({Point_2(real(random), real(random)), Point_2(real(random), real(random)),
                         Point_2(real(random), real(random))});
  triangles.push_back({Point_2(0, 0), Point_2(1, 0), Point_2(0, 1)});
  const Stencil_overlaps whole = find_stencil_overlaps(triangles, 200);
  EXPECT_GT(whole.overlapped_texels, 1000u);
  for (const Index tile : {64u, 77u, 199u}) {
    const Stencil_overlaps tiled = find_stencil_overlaps(triangles, 200, tile);
    EXPECT_EQ(tiled.overlaps.pairs, whole.overlaps.pairs) << tile;
    EXPECT_NEAR(double(tiled.overlapped_texels), double(whole.overlapped_texels), 5) << tile;
    EXPECT_NEAR(double(tiled.covered_texels), double(whole.covered_texels), 5) << tile;
  }
}

TEST(StencilValidator, CountsTexels)
{
  // Two squares of 8 x 8 units, shifted by 4 in both directions, at a texel a unit.
  const auto square = [](double x) {
    return std::vector<Triangle_uv>{{Point_2(x, x), Point_2(x + 8, x), Point_2(x + 8, x + 8)},
                                    {Point_2(x, x), Point_2(x + 8, x + 8), Point_2(x, x + 8)}};
  };
  std::vector<Triangle_uv> triangles = square(0);
  for (const Triangle_uv& t : square(4))
    triangles.push_back(t);
  const Stencil_overlaps found = find_stencil_overlaps(triangles, 12);
  EXPECT_EQ(found.covered_texels, 112u);
  EXPECT_EQ(found.overlapped_texels, 16u);
  EXPECT_EQ(find_stencil_overlaps({}, 12).covered_texels, 0u);
  // More sheets than are told apart.
  const std::vector<Triangle_uv> stack(300, triangles[0]);
  const Stencil_overlaps many = find_stencil_overlaps(stack, 12);
  EXPECT_FALSE(many.overlaps.is_complete);
  EXPECT_EQ(many.overlapped_texels, many.covered_texels);
}

TEST(StencilValidator, RefusesAPageWithoutTexels)
{
  EXPECT_THROW(Stencil_validator(0), Invalid_argument);
  EXPECT_THROW(find_stencil_overlaps({}, 0), Invalid_argument);
}

TEST(StencilValidator, SaysWhyThereIsNoContext)
{
  try {
    const internal::OSMesa_stencil stencil(1u << 15);
    FAIL() << "a context of 32768 x 32768 texels";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("OSMesa context of 32768 x 32768"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace Atlas
