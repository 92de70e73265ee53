// SPDX-License-Identifier: MIT
// Several meshes on one page, at one density. Usage: tutorial_several_meshes mesh mesh ...
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/soup/Joined_soups.h>

#include <exception>
#include <iostream>
#include <string>
#include <vector>

int main(int argc, char** argv)
try {
  if (argc < 2) {
    std::cerr << "usage: tutorial_several_meshes mesh mesh ...\n";
    return 2;
  }
  //! [join]
  std::vector<Atlas::Polygon_soup> meshes;
  for (int i = 1; i < argc; ++i)
    meshes.push_back(Atlas::read_polygon_soup(argv[i]));
  Atlas::Joined_soups scene(std::move(meshes));
  Atlas::Polygon_soup& whole = scene.whole();
  const Atlas::Surface surface = Atlas::build_surface(whole.points, whole.first, whole.vertices);
  const Atlas::Atlas_report report = Atlas::generate_atlas(surface, whole.uv);
  if (!report.is_valid())
    return 1;
  whole.face_page = report.face_page;
  for (std::size_t i = 0; i < scene.number_of_parts(); ++i)
    Atlas::write_obj("part_" + std::to_string(i) + ".obj", scene.part(i), "page.png");
  //! [join]
  std::cout << scene.number_of_parts() << " meshes, " << report.charts.size() << " charts, one page\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
