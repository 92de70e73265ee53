// SPDX-License-Identifier: MIT
// A part of a mesh unwrapped anew, and seams that are the user's alone, through both doors.
#include <Atlas/core/errors.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/pack_charts.h>
#include <Atlas/verify_atlas.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <Eigen/Core>

#include "cgal_meshes.h"
#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace Atlas::test {
namespace {

template <typename Mesh>
using Halfedge = typename boost::graph_traits<Mesh>::halfedge_descriptor;
template <typename Mesh>
using Face = typename boost::graph_traits<Mesh>::face_descriptor;

/// Coordinates, and a selection of the faces whose first corner is at x > -0.3.
template <typename Mesh>
struct Part
{
  std::map<Halfedge<Mesh>, Point_2> uv;
  std::map<Face<Mesh>, bool> is_selected;

  explicit Part(const Mesh& mesh)
  {
    for (const auto f : faces(mesh))
      is_selected[f] = get(CGAL::vertex_point, mesh, target(halfedge(f, mesh), mesh)).x() > -0.3;
  }
  auto uv_map() { return boost::associative_property_map<std::map<Halfedge<Mesh>, Point_2>>(uv); }
  auto selection() { return boost::associative_property_map<std::map<Face<Mesh>, bool>>(is_selected); }
};

template <typename Mesh>
class FaceSelection : public testing::Test
{};
using Meshes = testing::Types<Surface_mesh, CGAL::Polyhedron_3<Kernel>>;
TYPED_TEST_SUITE(FaceSelection, Meshes);

TYPED_TEST(FaceSelection, new_charts_go_around_faces_that_stay_to_the_bit)
{
  const TypeParam mesh = mesh_of<TypeParam>(sphere(3));
  Part<TypeParam> part(mesh);
  // The half that stays, seen from its pole, on a disc in a corner of the page.
  for (const auto f : faces(mesh))
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      const Point_3& p = get(CGAL::vertex_point, mesh, target(h, mesh));
      part.uv[h] = Point_2(0.2 - p.y() / 7, 0.2 + p.z() / 7);
    }
  const auto before = part.uv;
  const Atlas_report report = generate_atlas(
      mesh, part.uv_map(), parameters::texture_size(512).gutter(4).face_selection_map(part.selection()));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_EQ(report.faces, num_faces(mesh));
  EXPECT_EQ(report.pages, 1u);
  std::size_t moved = 0;
  for (const auto& [h, p] : before) {
    if (part.is_selected.at(face(h, mesh))) {
      moved += part.uv.at(h) != p;
    } else {
      EXPECT_EQ(part.uv.at(h), p);
    }
  }
  EXPECT_GT(moved, before.size() / 3);
  // Whoever verifies the whole finds the same.
  const Atlas_certificate whole = verify_atlas(mesh, part.uv_map(), parameters::texture_size(512).gutter(4));
  EXPECT_TRUE(whole.is_valid()) << message(whole);
  EXPECT_EQ(whole.charts, report.charts.size());
  EXPECT_NEAR(whole.seam_length, report.seam_length, 1e-9 * whole.seam_length);
  EXPECT_NEAR(report.area, 4 * 3.14159, 0.5);
}

TYPED_TEST(FaceSelection, faces_stay_on_their_pages)
{
  const TypeParam mesh = mesh_of<TypeParam>(cube());
  Part<TypeParam> part(mesh);
  std::map<Face<TypeParam>, int> page;
  int number = 0;
  for (const auto f : faces(mesh)) {
    part.is_selected[f] = number == 0;
    page[f] = number++; // five whole pages, at the same place
    int i = 0;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      part.uv[h] = Point_2(i == 1 || i == 2, i >= 2);
      ++i;
    }
  }
  const auto before = part.uv;
  const auto pages_before = page;
  const auto common = parameters::texture_size(64).gutter(0);
  const boost::associative_property_map<std::map<Face<TypeParam>, int>> page_map(page);
  const Atlas_report report = generate_atlas(
      mesh, part.uv_map(), common.face_selection_map(part.selection()).face_page_map(page_map));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_EQ(page, pages_before);
  for (const auto& [h, p] : before)
    EXPECT_EQ(part.uv.at(h) == p, !part.is_selected.at(face(h, mesh)));
  EXPECT_TRUE(verify_atlas(mesh, part.uv_map(), common.face_page_map(page_map)).is_valid());
  // Without the pages all of them would lie on the first.
  part.uv = before;
  EXPECT_FALSE(generate_atlas(mesh, part.uv_map(), common.face_selection_map(part.selection())).is_valid());
  page[*++faces(mesh).begin()] = -1;
  EXPECT_THROW((void)generate_atlas(mesh, part.uv_map(),
                                    common.face_selection_map(part.selection()).face_page_map(page_map)),
               Invalid_argument);
}

TYPED_TEST(FaceSelection, faces_without_coordinates_are_selected_too)
{
  const TypeParam mesh = mesh_of<TypeParam>(cube());
  Part<TypeParam> part(mesh);
  for (const auto f : faces(mesh)) {
    part.is_selected[f] = false;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh))
      part.uv[h] = Point_2(NAN, NAN);
  }
  const Atlas_report report =
      generate_atlas(mesh, part.uv_map(), parameters::face_selection_map(part.selection()));
  EXPECT_TRUE(report.is_valid()) << message(report.certificate);
}

TYPED_TEST(FaceSelection, no_room_is_told_and_nothing_changes)
{
  const TypeParam mesh = mesh_of<TypeParam>(cube());
  Part<TypeParam> part(mesh);
  const auto last = *--faces(mesh).end();
  for (const auto f : faces(mesh)) {
    part.is_selected[f] = f != last;
    int i = 0;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      part.uv[h] = Point_2(i == 1 || i == 2, i >= 2); // the whole page
      ++i;
    }
  }
  const auto before = part.uv;
  const Atlas_report report =
      generate_atlas(mesh, part.uv_map(), parameters::face_selection_map(part.selection()));
  EXPECT_EQ(report.status, Atlas_status::no_room);
  EXPECT_EQ(part.uv, before);
}

TYPED_TEST(FaceSelection, what_cannot_be_is_refused)
{
  const TypeParam mesh = mesh_of<TypeParam>(cube());
  Part<TypeParam> part(mesh);
  for (const auto f : faces(mesh)) {
    part.is_selected[f] = false;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh))
      part.uv[h] = Point_2(2, 0.5);
  }
  EXPECT_THROW((void)generate_atlas(mesh, part.uv_map(), parameters::face_selection_map(part.selection())),
               Invalid_argument);
  for (auto& entry : part.uv)
    entry.second = Point_2(0.5, 0.5);
  Page_options page;
  page.stacking = Chart_stacking::copies;
  EXPECT_THROW((void)generate_atlas(mesh, part.uv_map(),
                                    parameters::page_options(page).face_selection_map(part.selection())),
               Invalid_argument);
}

TEST(Face_selection, arrays_have_the_same_meaning)
{
  const Surface_mesh mesh = mesh_of<Surface_mesh>(torus(16, 8));
  Part<Surface_mesh> part(mesh);
  Soup soup;
  std::vector<Halfedge<Surface_mesh>> corners;
  std::map<Index, bool> is_selected;
  for (const auto v : mesh.vertices())
    soup.points.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) {
    is_selected[static_cast<Index>(soup.polygons.size())] = part.is_selected[f];
    soup.polygons.emplace_back();
    for (const auto h : CGAL::halfedges_around_face(mesh.halfedge(f), mesh)) {
      corners.push_back(h);
      soup.polygons.back().push_back(static_cast<Index>(mesh.target(h)));
    }
  }
  const Surface surface = surface_of(soup);
  const auto common = parameters::texture_size(256).gutter(1);
  std::vector<Point_2> uv;
  ASSERT_TRUE(generate_atlas(surface, uv, common).is_valid());
  for (Point_2& p : uv) // leaves a part of the page free
    p = Point_2(p.x() / 3, p.y() / 3);
  const std::vector<Point_2> before = uv;
  for (std::size_t c = 0; c < corners.size(); ++c)
    part.uv[corners[c]] = before[c];
  const boost::associative_property_map<std::map<Index, bool>> selection(is_selected);
  const Atlas_report of_arrays = generate_atlas(surface, uv, common.face_selection_map(selection));
  const Atlas_report of_mesh =
      generate_atlas(mesh, part.uv_map(), common.face_selection_map(part.selection()));
  EXPECT_EQ(of_arrays.face_chart, of_mesh.face_chart);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    EXPECT_EQ(uv[c], part.uv[corners[c]]);
    if (!is_selected[static_cast<Index>(c / 3)]) {
      EXPECT_EQ(uv[c], before[c]);
    }
  }
  std::vector<Point_2> again = before;
  (void)generate_atlas(surface, again, common.face_selection_map(selection).number_of_threads(3));
  EXPECT_EQ(again, uv);
}

/// Which pairs of faces of the cube stay together in a net: the bottom with its sides, one of these with the
/// top.
bool is_fold(std::size_t f, std::size_t g)
{
  static const std::set<std::pair<std::size_t, std::size_t>> folds{{0, 2}, {0, 3}, {0, 4}, {0, 5}, {1, 3}};
  return folds.count(std::minmax(f, g)) > 0;
}

TEST(Only_given_seams, a_net_is_what_the_user_draws)
{
  Surface_mesh mesh = mesh_of<Surface_mesh>(cube());
  auto uv = mesh.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:uv").first;
  auto wanted = mesh.add_property_map<Surface_mesh::Edge_index, bool>("e:wanted", false).first;
  auto seams = mesh.add_property_map<Surface_mesh::Edge_index, bool>("e:seam", false).first;
  for (const auto e : mesh.edges())
    wanted[e] = !is_fold(mesh.face(mesh.halfedge(e, 0)), mesh.face(mesh.halfedge(e, 1)));
  const Atlas_report report = generate_atlas(
      mesh, uv,
      parameters::edge_is_constrained_map(wanted).only_given_seams(true).edge_seam_map(seams).gutter(3));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_EQ(report.charts.size(), 1u);
  EXPECT_EQ(report.added_seams, 0u);
  for (const auto e : mesh.edges())
    EXPECT_EQ(seams[e], wanted[e]);
}

TEST(Only_given_seams, a_sphere_without_a_cap_stays_whole_beyond_any_bound)
{
  const Surface_mesh mesh = mesh_of<Surface_mesh>(sphere(3));
  const auto is_in_cap = [&](const auto f) {
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      if (mesh.point(v) == Point_3(0, 0, 1))
        return true;
    return false;
  };
  std::map<Halfedge<Surface_mesh>, Point_2> uv;
  std::map<Surface_mesh::Edge_index, bool> is_wanted;
  for (const auto e : mesh.edges())
    is_wanted[e] = is_in_cap(mesh.face(mesh.halfedge(e, 0))) != is_in_cap(mesh.face(mesh.halfedge(e, 1)));
  const boost::associative_property_map<std::map<Halfedge<Surface_mesh>, Point_2>> map(uv);
  const boost::associative_property_map<std::map<Surface_mesh::Edge_index, bool>> constraint(is_wanted);
  const Atlas_report report =
      generate_atlas(mesh, map, parameters::only_given_seams(true).edge_is_constrained_map(constraint));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_EQ(report.charts.size(), 2u);
  EXPECT_EQ(report.added_seams, 0u);
  EXPECT_GT(report.distortion.symmetric_dirichlet_mean, 1.1);
}

TEST(Only_given_seams, what_topology_adds_is_told)
{
  const Surface_mesh mesh = mesh_of<Surface_mesh>(torus(16, 8));
  std::map<Halfedge<Surface_mesh>, Point_2> uv;
  const boost::associative_property_map<std::map<Halfedge<Surface_mesh>, Point_2>> map(uv);
  const Atlas_report report = generate_atlas(mesh, map, parameters::only_given_seams(true));
  ASSERT_TRUE(report.is_valid()) << message(report.certificate);
  EXPECT_GE(report.added_seams, 8u + 16u - 1);
  EXPECT_THROW((void)generate_atlas(mesh, map, parameters::only_given_seams(true).max_charts(3)),
               Invalid_argument);
}

/// Whether coordinates of a type are written and read.
template <typename UV>
bool is_round_trip_valid()
{
  const Surface_mesh mesh = mesh_of<Surface_mesh>(cube());
  std::map<Halfedge<Surface_mesh>, UV> uv;
  const boost::associative_property_map<std::map<Halfedge<Surface_mesh>, UV>> map(uv);
  const auto np = parameters::texture_size(128).gutter(3);
  return generate_atlas(mesh, map, np).is_valid() && verify_atlas(mesh, map, np).is_valid() &&
         pack_charts(mesh, map, np).number_of_pages == 1 && verify_atlas(mesh, map, np).is_valid();
}

TEST(Maps_of_coordinates, have_points_vectors_or_arrays)
{
  EXPECT_TRUE((is_round_trip_valid<std::array<double, 2>>()));
  EXPECT_TRUE((is_round_trip_valid<std::array<float, 2>>()));
  EXPECT_TRUE(is_round_trip_valid<Eigen::Vector2d>());
  EXPECT_TRUE(is_round_trip_valid<Eigen::Vector2f>());
  EXPECT_TRUE(is_round_trip_valid<CGAL::Simple_cartesian<float>::Point_2>());
}

TEST(Maps_of_coordinates, may_be_of_vertices_where_they_are_read)
{
  Surface_mesh mesh = mesh_of<Surface_mesh>(planar_grid(3, 2));
  auto uv = mesh.add_property_map<Surface_mesh::Vertex_index, std::array<float, 2>>("v:uv").first;
  for (const auto v : mesh.vertices())
    uv[v] = {float(mesh.point(v).x()), float(mesh.point(v).y())};
  const Atlas_certificate certificate = verify_atlas(mesh, uv);
  EXPECT_TRUE(certificate.is_valid()) << message(certificate);
  EXPECT_EQ(certificate.charts, 1u);
  uv[Surface_mesh::Vertex_index(0)] = {1, 1}; // the last vertex is there
  EXPECT_FALSE(verify_atlas(mesh, uv).is_valid());
}

TEST(Maps_of_coordinates, may_be_of_vertices_that_no_seam_splits)
{
  Surface_mesh mesh = mesh_of<Surface_mesh>(planar_grid(3, 2));
  auto uv = mesh.add_property_map<Surface_mesh::Vertex_index, std::array<float, 2>>("v:uv").first;
  EXPECT_TRUE(generate_atlas(mesh, uv).is_valid());
  EXPECT_TRUE(verify_atlas(mesh, uv).is_valid());
  auto shared = mesh.add_property_map<Surface_mesh::Vertex_index, bool>("v:pinned", false).first;
  shared[Surface_mesh::Vertex_index(0)] = true;
  const std::array<float, 2> place = uv[Surface_mesh::Vertex_index(0)];
  EXPECT_TRUE(generate_atlas(mesh, uv, parameters::gutter(8).pinned_map(shared)).is_valid());
  EXPECT_EQ(uv[Surface_mesh::Vertex_index(0)], place);

  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  const auto closed = mesh_of<Polyhedron>(cube());
  std::map<boost::graph_traits<Polyhedron>::vertex_descriptor, Point_2> of_vertex;
  const Atlas_report report = generate_atlas(closed, boost::make_assoc_property_map(of_vertex));
  EXPECT_EQ(report.status, Atlas_status::vertices_split);
  EXPECT_TRUE(of_vertex.empty());
}

TEST(Named_parameters, have_any_order)
{
  Surface_mesh mesh = mesh_of<Surface_mesh>(torus(12, 6));
  auto larger = mesh.add_property_map<Surface_mesh::Vertex_index, Point_3>("v:larger").first;
  for (const auto v : mesh.vertices())
    larger[v] = Point_3(2 * mesh.point(v).x(), 3 * mesh.point(v).y(), mesh.point(v).z());
  auto patch = mesh.add_property_map<Surface_mesh::Face_index, int>("f:patch", 0).first;
  for (const auto f : mesh.faces())
    patch[f] = f % 2 != 0;
  auto a = mesh.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:a").first;
  auto b = mesh.add_property_map<Surface_mesh::Halfedge_index, Point_2>("h:b").first;
  const Atlas_report first = generate_atlas(
      mesh, a, parameters::texture_size(256).gutter(1).vertex_point_map(larger).face_patch_map(patch));
  const Atlas_report second = generate_atlas(
      mesh, b, parameters::face_patch_map(patch).texture_size(256).vertex_point_map(larger).gutter(1));
  EXPECT_EQ(first.charts.size(), second.charts.size());
  EXPECT_EQ(first.page_width, 256u);
  EXPECT_EQ(second.page_width, 256u);
  for (const auto h : mesh.halfedges())
    EXPECT_EQ(a[h], b[h]);
}

} // namespace
} // namespace Atlas::test
