// SPDX-License-Identifier: MIT
// The default call on a CGAL::Surface_mesh. Usage: atlas_of_surface_mesh [mesh.off]
#include <Atlas/generate_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <fstream>
#include <iostream>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;

int main(int argc, char** argv)
{
  Mesh mesh;
  if (argc > 1) {
    std::ifstream file(argv[1]);
    if (!(file >> mesh)) {
      std::cerr << "cannot read " << argv[1] << '\n';
      return 2;
    }
  } else {
    CGAL::make_icosahedron<Mesh, Atlas::Point_3>(mesh);
  }

  // One point per halfedge: the image of its target in its face. So both sides of a seam have their own.
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:uv").first;
  auto chart = mesh.add_property_map<Mesh::Face_index, int>("f:chart").first;
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, uv, Atlas::parameters::texture_size(512).gutter(2).face_chart_map(chart));

  std::cout << message(report.status) << ": " << mesh.number_of_faces() << " faces in "
            << report.charts.size() << " charts, " << 100 * report.packing_efficiency << " % of the page\n";
  const Mesh::Face_index face = *mesh.faces().begin();
  std::cout << "the first face is in chart " << chart[face] << ", its corners are at";
  for (const auto h : CGAL::halfedges_around_face(mesh.halfedge(face), mesh))
    std::cout << " (" << uv[h] << ")";
  std::cout << '\n';
  return report.is_valid() ? 0 : 1;
}
