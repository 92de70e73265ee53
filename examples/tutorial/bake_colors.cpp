// SPDX-License-Identifier: MIT
// Turns the colours of a scan's vertices into a texture. Usage: tutorial_bake_colors scan.ply out.glb
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>

#include <exception>
#include <iostream>

int main(int argc, char** argv)
try {
  if (argc != 3) {
    std::cerr << "usage: tutorial_bake_colors scan.ply out.glb\n";
    return 2;
  }
  Atlas::Polygon_soup scan = Atlas::read_polygon_soup(argv[1]);
  if (scan.colors.empty()) {
    std::cerr << argv[1] << " has no colours at its vertices\n";
    return 2;
  }
  const Atlas::Surface surface = Atlas::build_surface(scan.points, scan.first, scan.vertices);
  const auto options = Atlas::parameters::texture_size(2048).gutter(4);
  const Atlas::Atlas_report report = Atlas::generate_atlas(surface, scan.uv, options);
  if (!report.is_valid())
    return 1;

  //! [bake]
  const Atlas::Image texture = Atlas::bake_vertex_colors(scan, 2048);
  scan.colors.clear(); // they are in the texture now, and would be multiplied with it
  Atlas::write_glb(argv[2], scan, Atlas::png_bytes(texture));
  //! [bake]
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
