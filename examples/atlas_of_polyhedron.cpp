// SPDX-License-Identifier: MIT
// A CGAL::Polyhedron_3 without ids, coordinates in a map of its own, and some edges that must be seams.
#include <Atlas/generate_atlas.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <boost/property_map/property_map.hpp>

#include <iostream>
#include <map>

using Mesh = CGAL::Polyhedron_3<Atlas::Kernel>;
using Halfedge = boost::graph_traits<Mesh>::halfedge_descriptor;
using Edge = boost::graph_traits<Mesh>::edge_descriptor;

int main()
{
  using Atlas::Point_3;
  Mesh mesh; // a box of six quads
  CGAL::make_hexahedron(Point_3(0, 0, 0), Point_3(2, 0, 0), Point_3(2, 1, 0), Point_3(0, 1, 0),
                        Point_3(0, 1, 1), Point_3(0, 0, 1), Point_3(2, 0, 1), Point_3(2, 1, 1), mesh);

  std::map<Halfedge, Atlas::Point_2> uv;
  std::map<Edge, bool> is_seam, must_be_seam;
  for (const Edge e : edges(mesh)) // all edges of the floor
    must_be_seam[e] = source(e, mesh)->point().z() == 0 && target(e, mesh)->point().z() == 0;

  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, boost::make_assoc_property_map(uv),
                            Atlas::parameters::edge_seam_map(boost::make_assoc_property_map(is_seam))
                                .edge_is_constrained_map(boost::make_assoc_property_map(must_be_seam)));

  std::size_t seams = 0;
  for (const auto& [edge, value] : is_seam) {
    seams += value;
    if (must_be_seam[edge] && !value)
      return 1;
  }
  std::cout << message(report.status) << ": " << report.charts.size() << " charts, " << seams << " of "
            << is_seam.size() << " edges are seams, stretch " << report.distortion.l2_stretch << '\n';
  return report.is_valid() ? 0 : 1;
}
