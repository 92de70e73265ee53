// SPDX-License-Identifier: MIT
// A segmentation of one's own: charts by the side of a box that a face looks to. Usage: chart_segmentation
// [mesh.off]
#include <Atlas/generate_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <vector>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;

struct Box_segmentation
{
  Atlas::Segmentation segment(const Atlas::Surface& surface, const Atlas::Execution&) const
  {
    std::vector<Atlas::Vector_3> normal(surface.number_of_faces, Atlas::Vector_3(0, 0, 0));
    for (Atlas::Index t = 0; t < surface.number_of_triangles(); ++t)
      normal[surface.face[t]] +=
          CGAL::normal(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2));
    Atlas::Segmentation result;
    for (const Atlas::Index face : surface.face) {
      const Atlas::Vector_3& n = normal[face];
      int axis = 0;
      for (int i = 1; i < 3; ++i)
        if (std::abs(n[i]) > std::abs(n[axis]))
          axis = i;
      result.chart.push_back(2 * axis + (n[axis] < 0 ? 1 : 0));
    }
    result.cut.assign(surface.opposite.size(), 0);
    result.number_of_charts = 6;
    return result;
  }
};
static_assert(Atlas::ChartSegmentation<Box_segmentation>);

int main(int argc, char** argv)
{
  Mesh mesh;
  if (argc > 1)
    std::ifstream(argv[1]) >> mesh;
  else
    CGAL::make_icosahedron<Mesh, Atlas::Point_3>(mesh);
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:uv").first;
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, uv, Atlas::parameters::segmentation(Box_segmentation()));
  std::cout << message(report.status) << ": " << report.charts.size() << " charts\n";
  return report.is_valid() ? 0 : 1;
}
