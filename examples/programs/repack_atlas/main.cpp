// SPDX-License-Identifier: MIT
// Packs the texture coordinates of a mesh file anew, whoever made them; the shapes of the charts stay as they
// are.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/packing/pack_charts.h>
#include <Atlas/validation/certify.h>

#include "Material_packer.h"
#include "packing_options.h"
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

namespace {

enum Exit_code { VALID = 0, NOT_VALID = 1, COULD_NOT_TELL = 2 };

struct Arguments : Packing_options
{
  std::string file, output, texture;
  unsigned threads = 0;
};

/// The area of all charts on their pages, in texels.
double covered_area(const Atlas::Repacked_charts& repacked)
{
  double sum = 0;
  for (std::size_t i = 0; i < repacked.charts.size(); ++i) {
    const Atlas::Chart& chart = repacked.charts[i];
    const Atlas::Placement& placement = repacked.packing.placements[i];
    double area = 0;
    for (const auto& [a, b, c] : chart.triangles)
      area += std::abs(CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]));
    sum += area * (placement.a * placement.a + placement.b * placement.b);
  }
  return sum;
}

/// One line: what came out, and the verdict on it.
void print(const Arguments& arguments, const Atlas::Repacked_charts& repacked,
           const Atlas::Atlas_certificate& certificate)
{
  const Atlas::Packing& packing = repacked.packing;
  const double texels = double(arguments.page.width) * arguments.page.height * packing.number_of_pages;
  const double efficiency = texels > 0 ? covered_area(repacked) / texels : 0;
  std::printf("charts=%zu pages=%u efficiency=%.3f gutter=%.2f texels_per_unit=%.6g %s\n",
              repacked.charts.size(), packing.number_of_pages, efficiency, packing.gutter, packing.density,
              certificate.is_valid() ? "valid" : ("NOT VALID: " + Atlas::message(certificate)).c_str());
}

int run(const Arguments& arguments)
{
  const Atlas::Execution execution(arguments.threads);
  Atlas::Polygon_soup soup = Atlas::read_polygon_soup(arguments.file);
  if (soup.uv.empty())
    throw Atlas::IO_error(arguments.file + ": there are no texture coordinates in this file");
  Atlas::Surface surface = Atlas::build_surface(soup.points, soup.first, soup.vertices);
  set_weights(arguments.materials, soup, surface);
  const Material_packer packer{surface, soup, rules_of(arguments.materials, soup),
                               Atlas::Raster_packer(arguments.effort)};
  const Atlas::Repacked_charts repacked =
      Atlas::pack_charts(surface, soup.uv, arguments.page, packer, execution);
  if (!repacked.charts.empty() && repacked.packing.number_of_pages == 0)
    throw Atlas::IO_error(arguments.file + ": the page has no room for so many charts");
  soup.uv = repacked.uv;
  soup.face_page.assign(soup.number_of_faces(), 0);
  for (std::size_t t = 0; t < surface.number_of_triangles(); ++t)
    soup.face_page[surface.face[t]] = repacked.page[surface.corner[3 * t]];

  Atlas::Certificate_options options;
  options.width = arguments.page.width;
  options.height = arguments.page.height;
  options.gutter = repacked.packing.gutter;
  options.precision = Atlas::Uv_precision::single_precision;
  const Atlas::Atlas_certificate certificate =
      Atlas::certify(surface, soup.uv, soup.face_page, options, execution);
  if (arguments.texture.empty())
    Atlas::write_obj(arguments.output, soup);
  else
    Atlas::write_obj(arguments.output, soup, arguments.texture);
  print(arguments, repacked, certificate);
  if (std::fflush(stdout) != 0)
    throw Atlas::IO_error("cannot write the report: standard output is closed or full");
  return certificate.is_valid() ? VALID : NOT_VALID;
}

void add_options(CLI::App& app, Arguments& arguments)
{
  app.add_option("FILE", arguments.file, "OBJ with vt, PLY or glTF")->required();
  app.add_option("-o,--output", arguments.output,
                 "OBJ file to write; coordinates of several pages are UDIM tiles, 1001 the first")
      ->required();
  arguments.effort = Atlas::Packing_effort::normal;
  add_packing_options(app, arguments);
  app.add_option("--texture", arguments.texture, "Name of a picture for the materials of an MTL file");
  app.add_option("--threads", arguments.threads, "Number of threads; 0 takes all cores")
      ->capture_default_str();
}

} // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  CLI::App app("Packs the texture coordinates of a mesh file anew; the shapes of charts stay as they are.\n"
               "Exit code: 0 valid, 1 not valid (folded charts, charts on top of each other), 2 no result.");
  add_options(app, arguments);
  try {
    app.parse(argc, argv);
    complete(arguments);
    return run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? VALID : COULD_NOT_TELL;
  } catch (const std::exception& error) {
    std::cerr << "repack_atlas: " << error.what() << '\n';
    return COULD_NOT_TELL;
  }
}
