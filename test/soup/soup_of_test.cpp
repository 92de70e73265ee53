// SPDX-License-Identifier: MIT
#include <Atlas/core/Kernel.h>
#include <Atlas/core/errors.h>
#include <Atlas/soup/Joined_soups.h>

#include <CGAL/IO/Color.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "test_meshes.h"
#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

using namespace Atlas;

namespace {

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

/// A quad and a triangle beside it.
Mesh house()
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for (const auto& [x, y] : {std::array{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}, {.5, 2.}})
    v.push_back(mesh.add_vertex({x, y, x * y}));
  mesh.add_face(v[0], v[1], v[2], v[3]);
  mesh.add_face(v[3], v[2], v[4]);
  return mesh;
}

/// Coordinates that tell face and vertex.
auto numbered_uv(Mesh& mesh)
{
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Point_2>("h:uv", Point_2(-1, -1)).first;
  for (const auto h : mesh.halfedges())
    if (!mesh.is_border(h))
      uv[h] = Point_2(double(mesh.face(h)), double(mesh.target(h)));
  return uv;
}

TEST(Soup_of, a_mesh_has_its_faces_and_coordinates)
{
  Mesh mesh = house();
  const auto uv = numbered_uv(mesh);
  const Polygon_soup soup = soup_of(mesh, uv);
  ASSERT_EQ(soup.number_of_faces(), 2u);
  EXPECT_EQ(soup.face(0).size(), 4u);
  EXPECT_EQ(soup.face(1).size(), 3u);
  ASSERT_EQ(soup.points.size(), 5u);
  EXPECT_EQ(soup.points[4], Point_3(.5, 2, 1));
  ASSERT_EQ(soup.uv.size(), soup.vertices.size());
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c)
      EXPECT_EQ(soup.uv[c], Point_2(double(f), soup.vertices[c]));
  EXPECT_TRUE(soup.normals.empty() && soup.colors.empty() && soup.face_colors.empty() &&
              soup.face_material.empty() && soup.face_page.empty());
}

TEST(Soup_of, a_mesh_has_its_normals_colours_materials_and_pages)
{
  Mesh mesh = house();
  const auto uv = numbered_uv(mesh);
  auto normal =
      mesh.add_property_map<Mesh::Vertex_index, CGAL::Simple_cartesian<double>::Vector_3>("v:n").first;
  auto color = mesh.add_property_map<Mesh::Vertex_index, CGAL::IO::Color>("v:c").first;
  auto face_color = mesh.add_property_map<Mesh::Face_index, std::array<double, 3>>("f:c").first;
  auto material = mesh.add_property_map<Mesh::Face_index, std::string>("f:m").first;
  auto page = mesh.add_property_map<Mesh::Face_index, int>("f:p").first;
  for (const auto v : mesh.vertices()) {
    normal[v] = {double(v), 1, 0};
    color[v] = CGAL::IO::Color(255, 0, static_cast<unsigned char>(51 * v), 102);
  }
  const Mesh::Face_index quad(0), triangle(1);
  face_color[quad] = {1, .5, 0};
  face_color[triangle] = {0, 0, 1};
  material[quad] = "wall";
  material[triangle] = "roof";
  page[triangle] = 3;
  const Polygon_soup soup = soup_of(mesh, uv,
                                    parameters::face_page_map(page)
                                        .vertex_normal_map(normal)
                                        .vertex_color_map(color)
                                        .face_color_map(face_color)
                                        .face_patch_map(material));
  for (std::size_t c = 0; c < soup.vertices.size(); ++c)
    EXPECT_EQ(soup.normals[soup.corner_normal[c]], Vector_3(soup.vertices[c], 1, 0));
  ASSERT_EQ(soup.colors.size(), 5u);
  for (std::size_t v = 0; v < 5; ++v)
    EXPECT_EQ(soup.colors[v], (std::array<float, 4>{1, 0, static_cast<float>(v) * 51 / 255, .4f})) << v;
  EXPECT_EQ(soup.face_colors, (std::vector<std::array<float, 4>>{{1, .5f, 0, 1}, {0, 0, 1, 1}}));
  EXPECT_EQ(soup.material_names, (std::vector<std::string>{"roof", "wall"}));
  EXPECT_EQ(soup.face_material, (std::vector<Index>{1, 0}));
  EXPECT_EQ(soup.face_page, (std::vector<Index>{0, 3}));
}

TEST(Soup_of, coordinates_go_back_into_the_mesh)
{
  Mesh mesh = house();
  const auto uv = numbered_uv(mesh);
  Polygon_soup soup = soup_of(mesh, uv);
  for (Point_2& p : soup.uv)
    p = Point_2(p.y() + 10, p.x());
  put_uv(soup, mesh, uv);
  for (const auto h : mesh.halfedges())
    EXPECT_EQ(uv[h], mesh.is_border(h) ? Point_2(-1, -1)
                                       : Point_2(double(mesh.target(h)) + 10, double(mesh.face(h))));
  soup.uv.pop_back();
  EXPECT_THROW(put_uv(soup, mesh, uv), Invalid_argument);
  soup.uv.resize(soup.uv.size() + 2);
  EXPECT_THROW(put_uv(soup, mesh, uv), Invalid_argument);
}

TEST(Soup_of, a_polyhedron_without_indices)
{
  CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>> mesh;
  mesh.make_tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  using Halfedge = boost::graph_traits<decltype(mesh)>::halfedge_descriptor;
  std::map<Halfedge, Point_2> places;
  for (const auto h : halfedges(mesh))
    places[h] = Point_2(h->vertex()->point().x(), h->vertex()->point().y());
  const Polygon_soup soup = soup_of(mesh, boost::make_assoc_property_map(places));
  ASSERT_EQ(soup.number_of_faces(), 4u);
  ASSERT_EQ(soup.points.size(), 4u);
  for (std::size_t c = 0; c < soup.vertices.size(); ++c) {
    const Point_3& p = soup.points[soup.vertices[c]];
    EXPECT_EQ(soup.uv[c], Point_2(p.x(), p.y()));
  }
}

} // namespace
