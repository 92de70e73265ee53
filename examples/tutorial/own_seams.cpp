// SPDX-License-Identifier: MIT
// Seams where you want them: a cube cut along seven edges of your choice. Usage: tutorial_own_seams
#include <Atlas/generate_atlas.h>
#include <Atlas/segmentation/Patch_segmentation.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <iostream>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;

int main()
{
  Mesh cube;
  CGAL::make_hexahedron(Atlas::Point_3(0, 0, 0), Atlas::Point_3(1, 0, 0), Atlas::Point_3(1, 1, 0),
                        Atlas::Point_3(0, 1, 0), Atlas::Point_3(0, 1, 1), Atlas::Point_3(0, 0, 1),
                        Atlas::Point_3(1, 0, 1), Atlas::Point_3(1, 1, 1), cube);
  auto uv = cube.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:uv").first;

  //! [seams]
  // Cut the four edges that stand upright, and three of the four around the lid: the paper cross.
  auto must_cut = cube.add_property_map<Mesh::Edge_index, bool>("e:must_cut", false).first;
  int lid_edges = 0;
  for (const Mesh::Edge_index e : cube.edges()) {
    const Atlas::Point_3 &p = cube.point(cube.vertex(e, 0)), &q = cube.point(cube.vertex(e, 1));
    const bool is_upright = p.z() != q.z(), is_of_lid = p.z() == 1 && q.z() == 1;
    must_cut[e] = is_upright || (is_of_lid && ++lid_edges < 4);
  }
  // Patch_segmentation cuts nowhere else; without it your seams are kept and others may be added.
  const Atlas::Atlas_report report = Atlas::generate_atlas(
      cube, uv,
      Atlas::parameters::segmentation(Atlas::Patch_segmentation()).edge_is_constrained_map(must_cut));
  //! [seams]
  std::cout << report.charts.size() << " chart, seams of length " << report.seam_length << '\n';
  return report.is_valid() && report.charts.size() == 1 ? 0 : 1;
}
