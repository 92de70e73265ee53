// SPDX-License-Identifier: MIT
// A mesh of CGAL goes to a file with its coordinates, and back. Usage: tutorial_mesh_files mesh.off out.obj
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/soup/Joined_soups.h>
#include <Atlas/verify_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <exception>
#include <iostream>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;

int main(int argc, char** argv)
try {
  Mesh mesh;
  if (argc != 3 || !CGAL::IO::read_OFF(argv[1], mesh)) {
    std::cerr << "usage: tutorial_mesh_files mesh.off out.obj\n";
    return 2;
  }
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:uv").first;
  const Atlas::Atlas_report report = Atlas::generate_atlas(mesh, uv);
  if (!report.is_valid())
    return 1;

  //! [write]
  const Atlas::Polygon_soup soup = Atlas::soup_of(mesh, uv);
  Atlas::write_obj(argv[2], soup); // or write_glb(), write_ply()
  //! [write]

  //! [read]
  auto read = mesh.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:read").first;
  Atlas::put_uv(Atlas::read_polygon_soup(argv[2]), mesh, read);
  //! [read]
  for (const Mesh::Halfedge_index h : mesh.halfedges())
    if (!mesh.is_border(h) && read[h] != uv[h])
      return 1;
  return Atlas::verify_atlas(mesh, read).is_valid() ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
