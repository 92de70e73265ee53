// SPDX-License-Identifier: MIT
// Pinned corners keep their coordinates, through both doors.
#include <Atlas/core/errors.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/verify_atlas.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include "cgal_meshes.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Atlas::test {
namespace {

/// Vertices along a side of a sheet.
constexpr Index side = 9;
constexpr Index vertices_of_sheet = side * side;

/// Bent sheets beside each other: each becomes a chart, as they have no common vertices.
Soup sheets(Index count)
{
  Soup all;
  for (Index i = 0; i < count; ++i) {
    const Soup sheet = grid(side - 1, side - 1, [&](double s, double t) {
      return Point_3(s + 2 * i, t, 0.1 * std::sin(3 * s + i));
    });
    for (const auto& polygon : sheet.polygons) {
      all.polygons.push_back(polygon);
      for (Index& v : all.polygons.back())
        v += i * vertices_of_sheet;
    }
    all.points.insert(all.points.end(), sheet.points.begin(), sheet.points.end());
  }
  return all;
}

/// The number of a vertex of a sheet.
Index vertex(Index sheet, Index column, Index row)
{
  return sheet * vertices_of_sheet + row * side + column;
}

/// The border of the first sheet on that of a rectangle, at places that are no multiples of anything, twice
/// as far from each other along u as along v.
std::map<Index, Point_2> stretched_border()
{
  std::map<Index, Point_2> pins;
  for (Index j = 0; j < side; ++j)
    for (Index i = 0; i < side; ++i)
      if (i == 0 || j == 0 || i == side - 1 || j == side - 1)
        pins[vertex(0, i, j)] = Point_2(0.1 + i / 15. + 1e-10, 0.13 + j / 30.);
  return pins;
}
const std::map<Index, Point_2> stretched = stretched_border();

/// A run through the door of arrays. Coordinates of other corners are none before.
struct Arrays
{
  Surface surface;
  std::vector<Index> vertices; ///< per corner
  std::vector<Point_2> uv;
  std::map<Index, bool> is_pinned; ///< per corner

  Arrays(const Soup& soup, const std::map<Index, Point_2>& pins) : surface(surface_of(soup))
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& polygon : soup.polygons)
      for (const Index v : polygon) {
        const auto pin = pins.find(v);
        is_pinned[static_cast<Index>(vertices.size())] = pin != pins.end();
        vertices.push_back(v);
        uv.push_back(pin == pins.end() ? Point_2(nan, nan) : pin->second);
      }
  }
  auto pins() { return boost::associative_property_map<std::map<Index, bool>>(is_pinned); }
  /// Whether pinned corners of some vertices are where they were told to be, and others are anywhere.
  bool keeps(const std::map<Index, Point_2>& pins) const
  {
    for (std::size_t c = 0; c < uv.size(); ++c)
      if (const auto pin = pins.find(vertices[c]); pin != pins.end() && uv[c] != pin->second)
        return false;
    return std::all_of(uv.begin(), uv.end(), [](const Point_2& p) { return std::isfinite(p.x()); });
  }
};

template <typename Mesh>
class Pins : public testing::Test
{};
using Meshes = testing::Types<Surface_mesh, CGAL::Polyhedron_3<Kernel>>;
TYPED_TEST_SUITE(Pins, Meshes);

TYPED_TEST(Pins, stretch_a_chart_and_have_one_meaning_in_both_doors)
{
  using Mesh = TypeParam;
  using Halfedge = typename boost::graph_traits<Mesh>::halfedge_descriptor;
  using Vertex = typename boost::graph_traits<Mesh>::vertex_descriptor;
  const Mesh mesh = mesh_of<Mesh>(sheets(4));
  std::map<Point_3, Point_2> place; // meshes have their own order
  for (const auto& [v, p] : stretched)
    place[sheets(1).points[v]] = p;
  Soup soup;
  std::map<Index, Point_2> pins;
  std::map<Vertex, Index> number;
  std::map<Halfedge, Point_2> uv;
  std::map<Halfedge, bool> is_corner_pinned;
  std::map<Vertex, bool> is_pinned;
  for (const auto v : vertices(mesh)) {
    number[v] = static_cast<Index>(soup.points.size());
    soup.points.push_back(get(CGAL::vertex_point, mesh, v));
    const auto pin = place.find(soup.points.back());
    is_pinned[v] = pin != place.end();
    if (is_pinned[v])
      pins[number[v]] = pin->second;
  }
  for (const auto f : faces(mesh)) {
    soup.polygons.emplace_back();
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      soup.polygons.back().push_back(number[target(h, mesh)]);
      if (is_pinned[target(h, mesh)])
        uv[h] = pins.at(number[target(h, mesh)]);
    }
  }
  for (const auto h : halfedges(mesh))
    is_corner_pinned[h] = is_pinned[target(h, mesh)];
  const std::map<Halfedge, Point_2> before = uv;
  const boost::associative_property_map<std::map<Halfedge, Point_2>> map(uv);
  const boost::associative_property_map<std::map<Vertex, bool>> of_vertices(is_pinned);
  const boost::associative_property_map<std::map<Halfedge, bool>> of_corners(is_corner_pinned);

  Arrays arrays(soup, pins);
  const Atlas_report expected = generate_atlas(
      arrays.surface, arrays.uv, parameters::texture_size(512).gutter(4).pinned_map(arrays.pins()));
  ASSERT_TRUE(expected.is_valid()) << message(expected.certificate);
  EXPECT_TRUE(arrays.keeps(pins));
  ASSERT_EQ(pins.size(), stretched.size());

  const Atlas_report report =
      generate_atlas(mesh, map, parameters::pinned_map(of_vertices).gutter(4).texture_size(512));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_TRUE(report.moved_pins.empty());
  for (const auto& [h, p] : before)
    EXPECT_EQ(uv.at(h), p);
  std::size_t corner = 0;
  for (const auto f : faces(mesh))
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh))
      EXPECT_EQ(uv.at(h), arrays.uv[corner++]);

  const std::map<Halfedge, Point_2> of_first = std::exchange(uv, before);
  (void)generate_atlas(mesh, map,
                       parameters::number_of_threads(3).texture_size(512).pinned_map(of_corners).gutter(4));
  EXPECT_EQ(uv, of_first);
  // Whoever verifies the whole finds the same.
  const Atlas_certificate whole = verify_atlas(mesh, map, parameters::texture_size(512).gutter(4));
  EXPECT_TRUE(whole.is_valid()) << message(whole);
}

/// The extent of a chart along the axes, in coordinates of the page.
std::pair<double, double> extent(const Arrays& arrays, Index sheet)
{
  double low_u = 1, high_u = 0, low_v = 1, high_v = 0;
  for (std::size_t c = 0; c < arrays.uv.size(); ++c)
    if (arrays.vertices[c] / vertices_of_sheet == sheet) {
      low_u = std::min(low_u, arrays.uv[c].x());
      high_u = std::max(high_u, arrays.uv[c].x());
      low_v = std::min(low_v, arrays.uv[c].y());
      high_v = std::max(high_v, arrays.uv[c].y());
    }
  return {high_u - low_u, high_v - low_v};
}

TEST(Pins_of_arrays, stretch_one_chart_and_leave_others_as_they_are)
{
  Arrays arrays(sheets(4), stretched), without(sheets(4), {});
  const auto np = parameters::texture_size(512).gutter(4);
  const Atlas_report report = generate_atlas(arrays.surface, arrays.uv, np.pinned_map(arrays.pins()));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_GE(report.certificate.chart_distance, 4 - report.certificate.gutter_tolerance);
  EXPECT_EQ(report.certificate.gutter, 4);
  const Atlas_report usual = generate_atlas(without.surface, without.uv, np.pinned_map(without.pins()));
  ASSERT_EQ(report.charts.size(), 4u);
  EXPECT_EQ(report.face_chart, usual.face_chart);
  const auto [w, h] = extent(arrays, 0);
  EXPECT_GT(w / h, 1.5);
  EXPECT_FALSE(report.charts[0].is_within_bound);
  EXPECT_EQ(report.charts[0].reason, Excess_reason::not_asked_for);
  EXPECT_GE(report.charts_beyond_bound, 1u);
  EXPECT_GT(report.charts[0].distortion.symmetric_dirichlet_mean, 1.1);
  for (std::size_t c = 1; c < 4; ++c)
    EXPECT_NEAR(report.charts[c].distortion.symmetric_dirichlet_mean,
                usual.charts[c].distortion.symmetric_dirichlet_mean, 1e-6);
  EXPECT_GT(report.distortion.symmetric_dirichlet_mean, usual.distortion.symmetric_dirichlet_mean);
}

TEST(Pins_of_arrays, lead_a_chart_to_where_least_squares_conformal_maps_fold)
{
  const std::map<Index, Point_2> pins{{vertex(0, 0, 0), {0.3, 0.3}},  {vertex(0, 8, 0), {0.7, 0.3}},
                                      {vertex(0, 8, 8), {0.7, 0.7}},  {vertex(0, 0, 8), {0.3, 0.7}},
                                      {vertex(0, 3, 4), {0.58, 0.5}}, {vertex(0, 5, 4), {0.55, 0.37}}};
  Arrays arrays(sheets(3), pins), conformal(sheets(3), pins);
  const auto np = parameters::texture_size(512).gutter(4);
  const Atlas_report report = generate_atlas(arrays.surface, arrays.uv, np.pinned_map(arrays.pins()));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_TRUE(report.moved_pins.empty());
  EXPECT_TRUE(arrays.keeps(pins));
  // The mode that keeps such maps as they are does not keep the pins.
  const Atlas_report folded = generate_atlas(conformal.surface, conformal.uv,
                                             np.mode(Atlas_mode::conformal).pinned_map(conformal.pins()));
  ASSERT_TRUE(folded.is_valid()) << message(folded.certificate);
  ASSERT_EQ(folded.moved_pins.size(), 1u);
  EXPECT_EQ(folded.moved_pins[0].fault, Pin_fault::not_one_to_one);
}

TEST(Pins_of_arrays, are_places_on_pages_that_are_not_square)
{
  Page_options page;
  page.width = 1024;
  page.height = 512;
  const std::map<Index, Point_2> pins{{vertex(0, 0, 0), {0.125, 0.25}}, {vertex(0, 8, 0), {0.375, 0.25}}};
  Arrays arrays(sheets(3), pins);
  const Atlas_report report = generate_atlas(
      arrays.surface, arrays.uv, parameters::pinned_map(arrays.pins()).page_options(page).gutter(2));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_TRUE(arrays.keeps(pins));
  const auto [w, h] = extent(arrays, 0);
  EXPECT_NEAR(w, 0.25, 0.02);
  EXPECT_NEAR(h, 0.5, 0.04); // as many texels
  EXPECT_LT(report.charts[0].distortion.symmetric_dirichlet_mean, 1.01);
}

TEST(Pins_of_arrays, move_a_chart_with_one_of_them)
{
  const std::map<Index, Point_2> pins{{vertex(1, 4, 4), {0.5 + 1e-10, 0.5}}};
  Arrays arrays(sheets(3), pins);
  const auto np = parameters::texture_size(512).gutter(3);
  const Atlas_report report = generate_atlas(arrays.surface, arrays.uv, np.pinned_map(arrays.pins()));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_TRUE(report.moved_pins.empty());
  EXPECT_TRUE(arrays.keeps(pins));
  // All sheets have about one size in space, and so on the page.
  const auto [w, h] = extent(arrays, 1);
  const auto [other_w, other_h] = extent(arrays, 0);
  EXPECT_NEAR(w * h / (other_w * other_h), 1, 0.1);
  EXPECT_LT(report.charts[1].distortion.symmetric_dirichlet_mean, 1.01);
}

/// What is said of pins that cannot be kept.
void expect_moved(const std::map<Index, Point_2>& pins, const std::map<Index, Point_2>& kept, Index sheet,
                  Pin_fault fault)
{
  SCOPED_TRACE(message(fault));
  Arrays arrays(sheets(3), pins);
  const Atlas_report report = generate_atlas(
      arrays.surface, arrays.uv, parameters::texture_size(256).gutter(2).pinned_map(arrays.pins()));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  ASSERT_EQ(report.moved_pins.size(), 1u);
  const Moved_pins& moved = report.moved_pins.front();
  EXPECT_EQ(moved.chart, sheet);
  EXPECT_EQ(moved.fault, fault);
  ASSERT_FALSE(moved.corners.empty());
  EXPECT_TRUE(std::is_sorted(moved.corners.begin(), moved.corners.end()));
  for (const Index corner : moved.corners) {
    EXPECT_TRUE(arrays.is_pinned.at(corner));
    EXPECT_EQ(arrays.vertices[corner] / vertices_of_sheet, sheet);
  }
  EXPECT_TRUE(arrays.keeps(kept));
}

TEST(Pins_of_arrays, that_cannot_be_kept_are_told)
{
  std::map<Index, Point_2> folding; // the border in a mirror
  for (const auto& [v, p] : stretched)
    folding[v] = Point_2(p.y(), p.x());
  expect_moved(folding, {}, 0, Pin_fault::not_one_to_one);
  const std::map<Index, Point_2> good{{vertex(2, 4, 4), {0.75, 0.75}}};
  folding.insert(good.begin(), good.end());
  expect_moved(folding, good, 0, Pin_fault::not_one_to_one);
  expect_moved({{vertex(0, 0, 0), {0.5, 0.5}}, {vertex(0, 3, 3), {0.5, 0.5}}}, {}, 0,
               Pin_fault::not_one_to_one);
  expect_moved({{vertex(1, 0, 0), {0.5, 0.5}}, {vertex(1, 1, 0), {0.9, 0.5}}}, {}, 1,
               Pin_fault::outside_page);
  std::map<Index, Point_2> both{{vertex(0, 0, 0), {0.1, 0.1}},
                                {vertex(0, 8, 0), {0.4, 0.1}},
                                {vertex(2, 0, 0), {0.2, 0.2}},
                                {vertex(2, 8, 0), {0.5, 0.2}}};
  expect_moved(both, {{vertex(0, 0, 0), {0.1, 0.1}}, {vertex(0, 8, 0), {0.4, 0.1}}}, 2,
               Pin_fault::covers_chart);
}

TEST(Pins_of_arrays, that_move_leave_the_atlas_of_none)
{
  Arrays arrays(sheets(3), {{vertex(1, 0, 0), {0.5, 0.5}}, {vertex(1, 1, 0), {0.9, 0.5}}});
  Arrays without(sheets(3), {});
  const auto np = parameters::texture_size(256).gutter(2);
  EXPECT_EQ(generate_atlas(arrays.surface, arrays.uv, np.pinned_map(arrays.pins())).moved_pins.size(), 1u);
  ASSERT_TRUE(generate_atlas(without.surface, without.uv, np).is_valid());
  EXPECT_EQ(arrays.uv, without.uv);
}

TEST(Pins_of_arrays, of_one_vertex_differ_only_where_there_is_a_seam)
{
  Arrays arrays(sheets(2), {{vertex(0, 4, 4), {0.25, 0.25}}});
  const auto corner = std::find(arrays.vertices.begin(), arrays.vertices.end(), vertex(0, 4, 4));
  arrays.uv[static_cast<std::size_t>(corner - arrays.vertices.begin())] = Point_2(0.75, 0.25);
  const Atlas_report report =
      generate_atlas(arrays.surface, arrays.uv, parameters::gutter(2).pinned_map(arrays.pins()));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  ASSERT_EQ(report.moved_pins.size(), 1u);
  EXPECT_EQ(report.moved_pins[0].fault, Pin_fault::no_seam_between);

  // With a seam through the sheet its halves go to two places.
  Arrays halves(sheets(4), {});
  halves.surface.patch.resize(halves.surface.number_of_triangles());
  std::map<std::size_t, Point_2> places;
  for (Index h = 0; h < halves.surface.corner.size(); ++h) {
    const Index t = h / 3, v = halves.surface.triangles[t][h % 3];
    double x = 0; // of the middle of the triangle, from the left of its sheet
    for (const Index w : halves.surface.triangles[t])
      x += std::fmod(halves.surface.points[w].x(), 2) / 3;
    const bool is_right = x > 0.5;
    halves.surface.patch[t] = is_right;
    if (v == vertex(0, 4, 4)) {
      halves.is_pinned[halves.surface.corner[h]] = true;
      places[halves.surface.corner[h]] = halves.uv[halves.surface.corner[h]] =
          is_right ? Point_2(0.7, 0.5) : Point_2(0.3, 0.5);
    }
  }
  const Atlas_report parted =
      generate_atlas(halves.surface, halves.uv, parameters::gutter(2).pinned_map(halves.pins()));
  ASSERT_TRUE(parted.is_valid()) << message(parted.certificate);
  EXPECT_TRUE(parted.moved_pins.empty()) << message(parted.moved_pins[0].fault);
  EXPECT_EQ(parted.charts.size(), 8u);
  for (const auto& [c, p] : places)
    EXPECT_EQ(halves.uv[c], p);
}

TEST(Pins_of_arrays, may_fill_the_page)
{
  // All that there is goes to the corners of the page.
  const std::map<Index, Point_2> pins{{vertex(0, 0, 0), {0, 0}},
                                      {vertex(0, 8, 0), {1, 0}},
                                      {vertex(0, 8, 8), {1, 1}},
                                      {vertex(0, 0, 8), {0, 1}}};
  std::map<Index, Point_2> border = pins;
  for (Index i = 1; i < 8; ++i) {
    border[vertex(0, i, 0)] = Point_2(i / 8., 0);
    border[vertex(0, i, 8)] = Point_2(i / 8., 1);
    border[vertex(0, 0, i)] = Point_2(0, i / 8.);
    border[vertex(0, 8, i)] = Point_2(1, i / 8.);
  }
  Arrays alone(sheets(1), border);
  const Atlas_report report =
      generate_atlas(alone.surface, alone.uv, parameters::gutter(2).pinned_map(alone.pins()));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_TRUE(alone.keeps(border));
  EXPECT_TRUE(report.moved_pins.empty());
  EXPECT_NEAR(report.packing_efficiency, 1, 1e-6);
  // Where others have no room then, the pins go.
  Arrays crowd(sheets(2), border);
  const Atlas_report crowded =
      generate_atlas(crowd.surface, crowd.uv, parameters::gutter(2).pinned_map(crowd.pins()));
  ASSERT_TRUE(crowded.is_valid()) << message(crowded.certificate);
  ASSERT_EQ(crowded.moved_pins.size(), 1u);
  EXPECT_EQ(crowded.moved_pins[0].fault, Pin_fault::no_room);
}

TEST(Pins_of_arrays, go_with_a_selection)
{
  Arrays arrays(sheets(3), stretched);
  ASSERT_TRUE(generate_atlas(arrays.surface, arrays.uv, parameters::gutter(2)).is_valid());
  std::map<Index, bool> is_selected;
  const std::size_t corners = arrays.uv.size() / 3;
  for (std::size_t c = 0; c < arrays.uv.size(); ++c) {
    arrays.uv[c] = Point_2(0.5 + arrays.uv[c].x() / 2, 0.5 + arrays.uv[c].y() / 2);
    if (const auto pin = stretched.find(arrays.vertices[c]); pin != stretched.end())
      arrays.uv[c] = Point_2(pin->second.x() / 2, pin->second.y());
  }
  for (Index f = 0; f < arrays.surface.number_of_faces; ++f)
    is_selected[f] = f < 2 * arrays.surface.number_of_faces / 3;
  const std::vector<Point_2> before = arrays.uv;
  const boost::associative_property_map<std::map<Index, bool>> selection(is_selected);
  const Atlas_report report =
      generate_atlas(arrays.surface, arrays.uv,
                     parameters::face_selection_map(selection).pinned_map(arrays.pins()).gutter(2));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_TRUE(report.moved_pins.empty());
  for (std::size_t c = 0; c < before.size(); ++c)
    if (arrays.is_pinned[static_cast<Index>(c)] || c >= 2 * corners) {
      EXPECT_EQ(arrays.uv[c], before[c]);
    }
  EXPECT_NE(arrays.uv[corners], before[corners]);
}

/// What an error says of pins with these named parameters; nothing if there is none.
template <typename Parameters>
std::string error_of(Arrays& arrays, const Parameters& np)
{
  try {
    (void)generate_atlas(arrays.surface, arrays.uv, np.pinned_map(arrays.pins()));
  } catch (const Invalid_argument& error) {
    return error.argument();
  }
  return {};
}

TEST(Pins_of_arrays, without_a_meaning_are_refused)
{
  Arrays arrays(sheets(2), {{vertex(0, 0, 0), {0.5, 0.5}}});
  Page_options page;
  page.stacking = Chart_stacking::copies;
  EXPECT_EQ(error_of(arrays, parameters::page_options(page)), "stacking");
  page = {};
  page.has_free_aspect = true;
  EXPECT_EQ(error_of(arrays, parameters::page_options(page)), "has_free_aspect");
  page = {};
  page.weights = {1, 2};
  EXPECT_EQ(error_of(arrays, parameters::page_options(page)), "page_options");
  EXPECT_EQ(error_of(arrays, parameters::min_coverage(0.9)), "min_coverage");
  const std::vector<Point_2> before = arrays.uv;
  for (const double u : {-0.1, 1.5, std::nan("")}) {
    for (std::size_t c = 0; c < before.size(); ++c)
      if (arrays.is_pinned[static_cast<Index>(c)])
        arrays.uv[c] = Point_2(u, 0.5);
    EXPECT_EQ(error_of(arrays, parameters::gutter(2)), "pinned_map");
  }
  arrays.uv.clear();
  EXPECT_EQ(error_of(arrays, parameters::gutter(2)), "pinned_map");
}

} // namespace
} // namespace Atlas::test
