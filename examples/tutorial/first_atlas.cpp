// SPDX-License-Identifier: MIT
// Reads a mesh file, makes its atlas, writes a textured model. Usage: tutorial_first_atlas mesh out.obj
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/image/Image.h>

#include <exception>
#include <filesystem>
#include <iostream>

int main(int argc, char** argv)
try {
  if (argc != 3) {
    std::cerr << "usage: tutorial_first_atlas mesh out.obj\n";
    return 2;
  }
  //! [call]
  Atlas::Polygon_soup soup = Atlas::read_polygon_soup(argv[1]);
  const Atlas::Surface surface = Atlas::build_surface(soup.points, soup.first, soup.vertices);
  const Atlas::Atlas_report report = Atlas::generate_atlas(surface, soup.uv);
  if (!report.is_valid()) {
    std::cerr << message(report.status) << '\n';
    return 1;
  }
  soup.face_page = report.face_page;
  //! [call]

  //! [write]
  const std::filesystem::path out = argv[2];
  const std::filesystem::path picture = std::filesystem::path(out).replace_extension(".png");
  Atlas::write_png(picture, Atlas::checkerboard(1024));
  Atlas::write_obj(out, soup, picture.filename().string());
  //! [write]

  //! [report]
  std::cout << report.charts.size() << " charts\n"
            << "seams: " << report.seam_length << " units of the model\n"
            << "page:  " << 100 * report.packing_efficiency << " % full, " << report.density
            << " texels per unit\n"
            << "bound: " << report.charts_beyond_bound << " charts are beyond it\n"
            << "proof: " << message(report.certificate) << '\n';
  for (const Atlas::Surface::Rejected_face& face : report.rejected)
    std::cout << "face " << face.face << " has no coordinates: " << message(face.reason) << '\n';
  //! [report]
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
