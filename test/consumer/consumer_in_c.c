/* SPDX-License-Identifier: MIT */
/* The C interface: one triangle. */
#include <Atlas/atlas.h>

int main(void)
{
  static const double points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  static const unsigned int indices[3] = {0, 1, 2};
  int status;
  atlas_mesh mesh;
  atlas_scene* scene = atlas_create();
  ATLAS_MESH_INIT(&mesh);
  mesh.positions = points;
  mesh.position_type = ATLAS_DOUBLE;
  mesh.number_of_vertices = 3;
  mesh.indices = indices;
  mesh.number_of_faces = 1;
  atlas_add_mesh(scene, &mesh);
  status = atlas_generate(scene, 0);
  atlas_destroy(scene);
  return status == ATLAS_OK ? 0 : 1;
}
