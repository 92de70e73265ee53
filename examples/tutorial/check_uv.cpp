// SPDX-License-Identifier: MIT
// Checks texture coordinates that came from elsewhere. Usage: tutorial_check_uv
#include <Atlas/verify_atlas.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>

#include <iostream>

using Mesh = CGAL::Surface_mesh<Atlas::Point_3>;

int main()
{
  // Coordinates that many programs make: looked at from above, so that the two sides of a ball overlap.
  Mesh mesh;
  CGAL::make_icosahedron<Mesh, Atlas::Point_3>(mesh);
  auto uv = mesh.add_property_map<Mesh::Halfedge_index, Atlas::Point_2>("h:uv").first;
  for (const Mesh::Halfedge_index h : mesh.halfedges()) {
    const Atlas::Point_3& p = mesh.point(mesh.target(h));
    uv[h] = Atlas::Point_2(0.5 + p.x() / 4, 0.5 + p.y() / 4);
  }

  //! [verify]
  const Atlas::Atlas_certificate certificate =
      Atlas::verify_atlas(mesh, uv, Atlas::parameters::texture_size(1024).gutter(2));
  std::cout << message(certificate) << '\n';
  std::cout << "flipped: " << certificate.flipped
            << ", overlapping pairs: " << certificate.overlaps_in_charts + certificate.overlaps_between_charts
            << '\n';
  for (const Atlas::Index face : certificate.culprits)
    std::cout << "look at face " << face << '\n';
  //! [verify]
  return certificate.is_valid() ? 1 : 0; // they are bad, and must be found so
}
