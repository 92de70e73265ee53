// SPDX-License-Identifier: MIT
// Parts that are copies of one another get the same charts, which lie on top of each other.
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/pipeline/internal/Repeated_parts.h>

#include "test_meshes.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace Atlas::test {
namespace {

/// A body without any symmetry: a sphere with dents.
Soup dented(Soup soup)
{
  for (Point_3& p : soup.points) {
    const double r = 1 + 0.2 * std::sin(2 * p.x() + 1) + 0.15 * std::sin(3 * p.y() + 1) + 0.1 * p.z() * p.x();
    p = Point_3(r * p.x(), 1.3 * r * p.y(), 0.8 * r * p.z());
  }
  return soup;
}

/// The same body elsewhere: turned, moved, its faces and corners in another order, last digits lost.
Soup elsewhere(const Soup& soup, unsigned seed, bool is_mirrored = false)
{
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() % 100000) / 100000; };
  const double a = 6 * uniform(), b = 6 * uniform();
  const Vector_3 shift(10 * uniform(), 10 * uniform(), 10 * uniform());
  Soup result;
  std::vector<Index> place(soup.points.size());
  std::iota(place.begin(), place.end(), Index(0));
  std::shuffle(place.begin(), place.end(), random);
  result.points.resize(soup.points.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    const Point_3& p = soup.points[i];
    const double x = std::cos(a) * p.x() - std::sin(a) * p.y(), y = std::sin(a) * p.x() + std::cos(a) * p.y();
    const Point_3 turned(std::cos(b) * x - std::sin(b) * p.z(), y, std::sin(b) * x + std::cos(b) * p.z());
    const auto noise = [&] { return 1e-6 * (uniform() - 0.5); };
    result.points[place[i]] =
        Point_3((is_mirrored ? -1 : 1) * (turned.x() + noise()), turned.y() + noise(), turned.z() + noise()) +
        shift;
  }
  for (auto polygon : soup.polygons) {
    for (auto& v : polygon)
      v = place[v];
    std::rotate(polygon.begin(), polygon.begin() + static_cast<long>(random() % polygon.size()),
                polygon.end());
    if (is_mirrored)
      std::reverse(polygon.begin(), polygon.end());
    result.polygons.push_back(polygon);
  }
  std::shuffle(result.polygons.begin(), result.polygons.end(), random);
  return result;
}

Surface joined(const std::vector<Soup>& soups)
{
  std::vector<Surface> parts;
  for (const Soup& soup : soups)
    parts.push_back(surface_of(soup));
  return join_surfaces(parts);
}

std::size_t copies(const std::vector<Soup>& soups, Chart_stacking stacking)
{
  return internal::Repeated_parts(joined(soups), stacking).number_of_copies();
}

TEST(RepeatedParts, AreFoundWhateverTheirPlaceAndOrder)
{
  const Soup quads = grid(
      9, 6, [](double x, double y) { return Point_3(2 * x, y, 0.4 * x * x * y + 0.2 * y); }, false, false,
      true);
  for (const Soup& soup : {sphere(2), dented(sphere(2)), cube(), torus(12, 9), planar_grid(5, 5), quads}) {
    std::vector<Soup> all{soup};
    for (unsigned seed = 1; seed < 6; ++seed)
      all.push_back(elsewhere(soup, seed));
    EXPECT_EQ(copies(all, Chart_stacking::none), 0u);
    EXPECT_EQ(copies(all, Chart_stacking::copies), 5u);
  }
}

TEST(RepeatedParts, OthersAreNot)
{
  const Soup soup = dented(sphere(2));
  Soup larger = soup, moved_vertex = soup;
  for (Point_3& p : larger.points)
    p = Point_3(1.001 * p.x(), 1.001 * p.y(), 1.001 * p.z());
  moved_vertex.points[7] = moved_vertex.points[7] + Vector_3(0.01, 0, 0);
  EXPECT_EQ(copies({soup, larger}, Chart_stacking::copies_and_mirrored), 0u);
  EXPECT_EQ(copies({soup, moved_vertex}, Chart_stacking::copies_and_mirrored), 0u);
  const Soup mirrored = elsewhere(soup, 3, true);
  EXPECT_EQ(copies({soup, mirrored}, Chart_stacking::copies), 0u);
  EXPECT_EQ(copies({soup, mirrored}, Chart_stacking::copies_and_mirrored), 1u);
  // What the caller asks of edges and faces must be the same too.
  Surface surface = joined({soup, elsewhere(soup, 1)});
  surface.density_weight.assign(surface.number_of_triangles(), 1);
  EXPECT_EQ(internal::Repeated_parts(surface, Chart_stacking::copies).number_of_copies(), 1u);
  surface.density_weight.back() = 2;
  EXPECT_EQ(internal::Repeated_parts(surface, Chart_stacking::copies).number_of_copies(), 0u);
}

TEST(RepeatedParts, AreStackedAndTheAtlasIsProvedValid)
{
  const Soup body = dented(sphere(3)), other = torus(14, 9);
  std::vector<Soup> all{body, other};
  for (unsigned seed = 1; seed < 5; ++seed)
    all.push_back(elsewhere(body, seed, seed == 4));
  all.push_back(elsewhere(other, 9));
  const Surface surface = joined(all);
  Page_options page;
  std::vector<Point_2> uv;
  for (const auto stacking : {Chart_stacking::copies, Chart_stacking::copies_and_mirrored}) {
    page.stacking = stacking;
    const Atlas_report report = generate_atlas(surface, uv, parameters::page_options(page));
    ASSERT_TRUE(report.is_valid()) << message(report.certificate);
    EXPECT_EQ(report.certificate.pages, 1u);
    // Charts per part.
    std::vector<std::set<Index>> charts(all.size());
    for (std::size_t part = 0, f = 0; part < all.size(); ++part)
      for (std::size_t k = 0; k < all[part].polygons.size(); ++k, ++f)
        charts[part].insert(report.face_chart[f]);
    const bool is_mirroring = stacking == Chart_stacking::copies_and_mirrored;
    for (const int part : {2, 3, 4})
      EXPECT_EQ(charts[part].size(), charts[0].size());
    EXPECT_EQ(charts[6].size(), charts[1].size());
    const std::size_t least = (is_mirroring ? 4 : 3) * charts[0].size() + charts[1].size();
    EXPECT_GE(report.stacked_charts, least);
  }
}

TEST(RepeatedParts, LeaveOtherSurfacesAsTheyAre)
{
  const Surface surface = joined({dented(sphere(3)), torus(14, 9)});
  Page_options page;
  std::vector<Point_2> uv;
  const auto uncut = parameters::seam_exchange_rate(0); // what is cut for a page depends on the packing
  const Atlas_report plain = generate_atlas(surface, uv, uncut.page_options(page));
  page.stacking = Chart_stacking::copies;
  const Atlas_report stacked = generate_atlas(surface, uv, uncut.page_options(page));
  EXPECT_TRUE(stacked.is_valid());
  EXPECT_EQ(stacked.face_chart, plain.face_chart);
}

} // namespace
} // namespace Atlas::test
