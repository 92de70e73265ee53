/* SPDX-License-Identifier: MIT */
/* An atlas of a box from C: two meshes share one page, and their coordinates come back per corner and per vertex. */
#include <Atlas/atlas.h>

#include <stdio.h>

static const float points[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}};
static const unsigned int quads[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                         {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
static const unsigned int sizes[6] = {4, 4, 4, 4, 4, 4};

static int tell(void* user, int stage, double fraction)
{
  if (fraction >= 1)
    printf("%s: %s is done\n", (const char*)user, atlas_stage_name(stage));
  return 1; /* go on */
}

int main(void)
{
  int status;
  atlas_mesh box;
  atlas_options options;
  atlas_summary summary;
  atlas_result result;
  atlas_scene* scene = atlas_create();

  ATLAS_MESH_INIT(&box);
  box.positions = points;
  box.number_of_vertices = 8;
  box.indices = quads[0];
  box.face_sizes = sizes;
  box.number_of_faces = 6;
  atlas_add_mesh(scene, &box);
  atlas_add_mesh(scene, &box);

  ATLAS_OPTIONS_INIT(&options);
  options.width = options.height = 512;
  options.gutter = 4;
  options.progress = tell;
  options.user = (void*)"two boxes";
  status = atlas_generate(scene, &options);
  if (status != ATLAS_OK) {
    fprintf(stderr, "%s\n", atlas_error(scene));
    atlas_destroy(scene);
    return 1;
  }
  ATLAS_SUMMARY_INIT(&summary);
  ATLAS_RESULT_INIT(&result);
  atlas_get_summary(scene, &summary);
  atlas_get_result(scene, 1, &result);
  printf("%lu charts on %lu page, %.0f %% of it covered\n", (unsigned long)summary.number_of_charts,
         (unsigned long)summary.number_of_pages, 100 * summary.efficiency);
  printf("the second box has %lu vertices now; its first corner is at (%f, %f)\n",
         (unsigned long)result.number_of_vertices, result.corner_uvs[0], result.corner_uvs[1]);
  atlas_destroy(scene);
  return 0;
}
