// SPDX-License-Identifier: MIT
// Atlases of other tools whose charts merge.
#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/image/Image.h>
#include <Atlas/soup/internal/atlas_of_soup.h>

#include "baked_soups.h"
#include "test_meshes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

using namespace Atlas;
using namespace Atlas::test;

namespace {

struct Merged
{
  Polygon_soup soup; ///< with both coordinates
  Atlas_report report;
  Index before; ///< charts of the old coordinates
};

Merged merged(Polygon_soup soup, internal::Soup_options options = {})
{
  options.merges_uv = true;
  options.page.width = options.page.height = 256;
  Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  const Index before = charts_of_uv(surface, soup.uv).number_of_charts;
  std::vector<Point_2> uv;
  Atlas_report report = atlas_of_soup(options, soup, surface, uv, {});
  EXPECT_TRUE(report.is_valid()) << message(report.certificate);
  soup.old_uv = std::exchange(soup.uv, uv);
  soup.face_page = report.face_page;
  return {std::move(soup), std::move(report), before};
}

/// A colour that changes slowly from place to place.
Color color_at(const Point_3& p)
{
  const auto component = [](double x) { return static_cast<std::uint8_t>(std::lround(127.5 + 100 * x)); };
  return {component(std::sin(p.x())), component(std::sin(p.y() + 1)), component(std::cos(p.z()))};
}

int difference(const Color& a, const Color& b)
{
  int most = 0;
  for (std::size_t k = 0; k < 3; ++k)
    most = std::max(most, std::abs(int(a[k]) - int(b[k])));
  return most;
}

Point_3 centre(const Polygon_soup& soup, std::size_t f)
{
  Vector_3 sum(0, 0, 0);
  for (const Index v : soup.face(f))
    sum = sum + (soup.points[v] - CGAL::ORIGIN);
  return CGAL::ORIGIN + sum / double(soup.face(f).size());
}

/// What the middle of a face shows.
Color color_of_face(const Image& image, const Polygon_soup& soup, std::size_t f)
{
  double u = 0, v = 0;
  for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c) {
    u += soup.uv[c].x() / double(soup.face(f).size());
    v += soup.uv[c].y() / double(soup.face(f).size());
  }
  return image.at(static_cast<std::size_t>(u * double(image.width)),
                  static_cast<std::size_t>((1 - v) * double(image.height)));
}

/// Largest difference of what faces show of their old texture from what they should.
int error_of_moved_texture(Merged m)
{
  Polygon_soup old = m.soup;
  old.uv = m.soup.old_uv;
  old.face_page.clear();
  Source_textures source;
  source.textures.emplace_back();
  source.textures[0].image = bake_procedural(old, 512, color_at);
  source.face_texture.assign(old.number_of_faces(), 0);
  const Image moved = transfer_texture(m.soup, 256, source);
  int most = 0;
  for (std::size_t f = 0; f < old.number_of_faces(); ++f)
    most = std::max(most, difference(color_of_face(moved, m.soup, f), color_at(centre(m.soup, f))));
  return most;
}

/// A quarter of a tube, of quads.
Soup gutter_pipe(Index n)
{
  return grid(
      n, n, [](double s, double t) { return Point_3(std::cos(1.5 * s), std::sin(1.5 * s), 2 * t); }, false,
      false, true);
}

Soup flat_quads(Index n)
{
  return grid(
      n, n, [](double x, double y) { return Point_3(x, y, 0); }, false, false, true);
}

Soup ring_of_quads(Index m, Index n)
{
  Soup soup = torus(m, n);
  std::vector<std::vector<Index>> quads;
  for (std::size_t i = 0; i < soup.polygons.size(); i += 2) { // two triangles {a, b, c}, {a, c, d} each
    quads.push_back(soup.polygons[i]);
    quads.back().push_back(soup.polygons[i + 1][2]);
  }
  soup.polygons = quads;
  return soup;
}

TEST(File_charts, single_faces_of_an_unrollable_sheet_become_one_chart_and_take_their_texture_along)
{
  const Merged m = merged(faces_side_by_side(gutter_pipe(8)));
  EXPECT_EQ(m.before, 64u);
  EXPECT_EQ(m.report.charts.size(), 1u);
  EXPECT_LT(m.report.distortion.l2_stretch, 1.001);
  EXPECT_LE(error_of_moved_texture(m), 6);
}

TEST(File_charts, single_faces_of_a_curved_surface_become_few_charts_within_the_bound)
{
  const Merged m = merged(faces_side_by_side(ring_of_quads(24, 12)));
  EXPECT_EQ(m.before, 288u);
  EXPECT_LE(m.report.charts.size(), 30u);
  EXPECT_EQ(m.report.charts_beyond_bound, 0u);
  for (const Chart_report& chart : m.report.charts)
    EXPECT_LE(chart.distortion.symmetric_dirichlet_mean, 1.0351);
  EXPECT_LE(error_of_moved_texture(m), 8);
}

TEST(File_charts, a_tighter_bound_gives_more_charts)
{
  internal::Soup_options tight;
  tight.max_distortion = 1.005;
  const Polygon_soup soup = faces_side_by_side(ring_of_quads(24, 12));
  EXPECT_GT(merged(soup, tight).report.charts.size(), merged(soup).report.charts.size());
}

/// Two sheets apart from each other, each one chart, sheared and stretched in the plane.
Polygon_soup askew_sheets()
{
  Polygon_soup soup = polygon_soup_of(planar_grid(3, 3));
  const Polygon_soup second = soup;
  for (const Point_3& p : second.points)
    soup.points.emplace_back(p.x(), p.y(), p.z() + 9);
  for (std::size_t f = 0; f < second.number_of_faces(); ++f) {
    for (const Index v : second.face(f))
      soup.vertices.push_back(v + static_cast<Index>(second.points.size()));
    soup.close_face();
  }
  for (const Index v : soup.vertices) {
    const Point_3& p = soup.points[v];
    soup.uv.emplace_back(0.1 * p.x() + 0.05 * p.y() + (p.z() > 5 ? 0.5 : 0), 0.03 * p.y());
  }
  return soup;
}

/// The largest over the smallest factor between new and old lengths.
double change_of_shape(const Polygon_soup& soup)
{
  double least = 1e300, most = 0;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c)
      for (std::size_t d = soup.first[f]; d < c; ++d) {
        const double factor = std::sqrt(CGAL::squared_distance(soup.uv[c], soup.uv[d]) /
                                        CGAL::squared_distance(soup.old_uv[c], soup.old_uv[d]));
        least = std::min(least, factor);
        most = std::max(most, factor);
      }
  return most / least;
}

TEST(File_charts, a_chart_without_neighbours_keeps_its_shape_whatever_the_bound)
{
  const Merged m = merged(askew_sheets());
  EXPECT_EQ(m.before, 2u);
  EXPECT_EQ(m.report.charts.size(), 2u);
  EXPECT_LT(change_of_shape(m.soup), 1.0001);
  EXPECT_GT(m.report.distortion.l2_stretch, 1.2); // as it was
}

TEST(File_charts, a_tube_that_is_slit_open_stays_as_it_is)
{
  Polygon_soup soup = polygon_soup_of(grid(
      12, 4,
      [](double s, double t) { return Point_3(std::cos(2 * CGAL_PI * s), std::sin(2 * CGAL_PI * s), t); },
      true, false, true));
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    double most = 0; // of the angles in turns, which start where the tube is cut
    std::array<double, 4> angle{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Point_3& p = soup.points[soup.face(f)[i]];
      angle[i] = std::fmod(std::atan2(p.y(), p.x()) / (2 * CGAL_PI) + 1.5, 1);
      most = std::max(most, angle[i]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const bool is_behind = most - angle[i] > 0.5;
      soup.uv.emplace_back((angle[i] + is_behind) / 2, soup.points[soup.face(f)[i]].z() / 9);
    }
  }
  const Merged m = merged(soup);
  EXPECT_EQ(m.before, 1u);
  EXPECT_EQ(m.report.charts.size(), 1u);
  EXPECT_LT(change_of_shape(m.soup), 1.0001);
}

TEST(File_charts, charts_of_different_materials_stay_apart_on_request)
{
  Polygon_soup soup = faces_side_by_side(flat_quads(4));
  soup.material_names = {"a", "b"};
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    soup.face_material.push_back(centre(soup, f).x() > centre(soup, 0).x() ? 1 : 0);
  EXPECT_EQ(merged(soup).report.charts.size(), 1u);
  internal::Soup_options options;
  options.separates_materials = true;
  EXPECT_EQ(merged(soup, options).report.charts.size(), 2u);
}

TEST(File_charts, the_result_does_not_depend_on_threads)
{
  internal::Soup_options one, three;
  one.threads = 1;
  three.threads = 3;
  const Polygon_soup soup = faces_side_by_side(ring_of_quads(16, 8));
  EXPECT_EQ(merged(soup, one).soup.uv, merged(soup, three).soup.uv);
}

} // namespace
