// SPDX-License-Identifier: MIT
// The library alone.
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/version.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <iostream>
#include <string>
#include <vector>

int main()
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

  Mesh mesh;
  CGAL::make_tetrahedron(Kernel::Point_3(0, 0, 0), Kernel::Point_3(1, 0, 0), Kernel::Point_3(0, 1, 0),
                         Kernel::Point_3(0, 0, 1), mesh);
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  const auto report = Atlas::generate_atlas(mesh, uv, Atlas::parameters::texture_size(1024).gutter(2));
  std::cout << report.charts.size() << " charts; " << Atlas::message(report.status) << '\n';

  // The same of a soup.
  std::vector<Atlas::Point_2> corner_uv;
  const Atlas::Surface surface = Atlas::build_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const auto report_of_soup = Atlas::generate_atlas(surface, corner_uv);

  const std::string version = std::to_string(ATLAS_VERSION_MAJOR) + '.' +
                              std::to_string(ATLAS_VERSION_MINOR) + '.' + std::to_string(ATLAS_VERSION_PATCH);
  if (version != ATLAS_VERSION || version != EXPECTED_VERSION) {
    std::cout << "version " << version << " is not " EXPECTED_VERSION "\n";
    return 1;
  }
  return report.is_valid() && report_of_soup.is_valid() && corner_uv.size() == 12 ? 0 : 1;
}
