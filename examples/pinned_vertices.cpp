// SPDX-License-Identifier: MIT
// Vertices that have their coordinates given: the least squares conformal map of the rest of a mesh that is a
// disc. No seam splits its vertices, so that a map of vertices holds the coordinates.
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/validation/Exact_validator.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;

int main()
{
  Mesh mesh; // a sheet of 11 x 11 vertices, bent to an arch
  CGAL::make_grid(
      10, 10, mesh, [](int i, int j) { return Atlas::Point_3(i, j, std::sin(.3 * i)); }, true);
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Atlas::Point_2>("v:uv").first;

  Atlas::Chart chart;
  for (const Mesh::Vertex_index v : mesh.vertices())
    chart.points.push_back(mesh.point(v));
  for (const Mesh::Face_index f : mesh.faces()) {
    chart.triangles.emplace_back();
    std::size_t i = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      chart.triangles.back()[i++] = static_cast<Atlas::Index>(v);
  }
  //! [pins]
  Atlas::Interactive_LSCM map(chart); // factorizes once: pins may change, and change again
  const std::vector<Atlas::LSCM_pin> pins = {{0, {0, 0}}, {10, {1, 0}}, {120, {.9, 1.1}}};
  const Atlas::Chart_status status = map.solve(pins);
  for (const Mesh::Vertex_index v : mesh.vertices())
    uv[v] = map.chart().uv[static_cast<Atlas::Index>(v)];
  //! [pins]
  const Atlas::Chart_verdict verdict = Atlas::Exact_validator().validate(map.chart(), Atlas::Execution());
  std::cout << message(status) << ", " << message(verdict.status)
            << "; pinned: " << uv[Mesh::Vertex_index(120)] << '\n';
  return status == Atlas::Chart_status::valid && uv[Mesh::Vertex_index(120)] == Atlas::Point_2(.9, 1.1) ? 0
                                                                                                        : 1;
}
