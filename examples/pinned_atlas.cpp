// SPDX-License-Identifier: MIT
// Pinned vertices: they keep the coordinates that they have, their chart follows, the others go around it.
#include <Atlas/generate_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <cmath>
#include <iostream>
#include <map>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;

int main()
{
  Mesh mesh; // three bent sheets of 11 x 11 vertices
  for (const int z : {0, 5, 10})
    CGAL::make_grid(
        10, 10, mesh, [z](int i, int j) { return Atlas::Point_3(i, j, z + std::sin(.3 * i)); }, true);
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:uv").first;
  auto is_pinned = mesh.add_property_map<Mesh::Vertex_index, bool>("v:pinned", false).first;
  //! [pins]
  const std::map<Mesh::Vertex_index, Atlas::Point_2> places{{Mesh::Vertex_index(0), {.3, .3}},
                                                            {Mesh::Vertex_index(10), {.7, .3}},
                                                            {Mesh::Vertex_index(120), {.7, .6}}};
  for (const auto& [v, place] : places) {
    is_pinned[v] = true;
    for (const auto h : CGAL::halfedges_around_target(v, mesh))
      uv[h] = place;
  }
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, uv, Atlas::parameters::pinned_map(is_pinned));
  for (const Atlas::Moved_pins& moved : report.moved_pins)
    std::cout << "chart " << moved.chart << ": " << message(moved.fault) << '\n';
  //! [pins]
  std::cout << message(report.status) << ", " << report.charts.size() << " charts\n";
  return report.is_valid() && report.moved_pins.empty() ? 0 : 1;
}
