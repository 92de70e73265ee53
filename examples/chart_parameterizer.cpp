// SPDX-License-Identifier: MIT
// A parameterizer of one's own: orthogonal projection onto the mean plane of the chart. Charts that it turns
// over are split by the library until they are flat enough. Usage: chart_parameterizer [mesh.off]
#include <Atlas/generate_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <cmath>
#include <fstream>
#include <iostream>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;

struct Projection_parameterizer
{
  Atlas::Chart_status parameterize(Atlas::Chart& chart, const Atlas::Execution&) const
  {
    Atlas::Vector_3 normal(0, 0, 0);
    for (const auto& [a, b, c] : chart.triangles)
      normal += CGAL::normal(chart.points[a], chart.points[b], chart.points[c]);
    if (!(normal.squared_length() > 0))
      return Atlas::Chart_status::solver_failed; // there is no mean plane
    normal /= std::sqrt(normal.squared_length());
    const Atlas::Vector_3 other =
        std::abs(normal.x()) < 0.5 ? Atlas::Vector_3(1, 0, 0) : Atlas::Vector_3(0, 1, 0);
    Atlas::Vector_3 right = CGAL::cross_product(other, normal);
    right /= std::sqrt(right.squared_length());
    const Atlas::Vector_3 up = CGAL::cross_product(normal, right);
    chart.uv.clear();
    for (const Atlas::Point_3& p : chart.points)
      chart.uv.emplace_back(right * (p - CGAL::ORIGIN), up * (p - CGAL::ORIGIN));
    return Atlas::Chart_status::valid;
  }
};
static_assert(Atlas::ChartParameterizer<Projection_parameterizer>);

int main(int argc, char** argv)
{
  Mesh mesh;
  if (argc > 1)
    std::ifstream(argv[1]) >> mesh;
  else
    CGAL::make_icosahedron<Mesh, Atlas::Point_3>(mesh);
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:uv").first;
  const Atlas::Atlas_report report =
      Atlas::generate_atlas(mesh, uv, Atlas::parameters::parameterizer(Projection_parameterizer()));
  std::cout << message(report.status) << ": " << report.charts.size() << " charts, " << report.split_charts
            << " splits, mean distortion " << report.distortion.symmetric_dirichlet_mean << '\n';
  return report.is_valid() ? 0 : 1;
}
