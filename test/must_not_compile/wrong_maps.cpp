// SPDX-License-Identifier: MIT
// Must not compile: a mesh that is none, and a map that cannot take coordinates.
#include <Atlas/generate_atlas.h>

#include <CGAL/Surface_mesh.h>

int main()
{
  CGAL::Surface_mesh<Atlas::Point_3> mesh;
  (void)Atlas::generate_atlas(mesh, 7);
#ifdef NO_MESH
  (void)Atlas::generate_atlas(3.14,
                              mesh.add_property_map<CGAL::SM_Halfedge_index, Atlas::Point_2>("h:uv").first);
#endif
}
