// SPDX-License-Identifier: MIT
// Everything that runs on several threads, for the thread sanitizer: see README.md.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/bake/bake_ambient_occlusion.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/validation/certify.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv)
{
  using namespace Atlas;
  bool is_valid = argc > 1;
  for (int i = 1; i < argc; ++i) {
    Polygon_soup soup = read_polygon_soup(argv[i]);
    const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
    const Atlas_report report = generate_atlas(
        surface, soup.uv,
        parameters::texture_size(512).number_of_threads(4).progress([](Stage, double) { return true; }));
    const Execution execution(4);
    const Atlas_certificate certificate = certify(surface, soup.uv, report.face_page, {}, execution);
    bake_normals(soup, 64, 0, execution);
    bake_ambient_occlusion(soup, 64, {.samples = 8}, 0, execution);
    is_valid = is_valid && report.is_valid() && certificate.is_valid();
    std::printf("%s: %zu charts\n", argv[i], report.charts.size());
  }
  return is_valid ? 0 : 1;
}
