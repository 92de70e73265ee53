// SPDX-License-Identifier: MIT
// Packs the texture coordinates of a mesh file anew, whoever made them; the shapes of the charts stay as they
// are.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_obj.h>
#include <Atlas/build_surface.h>
#include <Atlas/packing/pack_charts.h>
#include <Atlas/validation/certify.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <string>

namespace {

enum Exit_code { VALID = 0, NOT_VALID = 1, COULD_NOT_TELL = 2 };

struct Arguments
{
  std::string file, output, texture, size = std::to_string(Atlas::default_texture_size);
  Atlas::Page_options page;
  Atlas::Packing_effort effort = Atlas::Packing_effort::normal;
  unsigned threads = 0;
};

/// "1024" or "1024x512".
void read_size(const std::string& text, Atlas::Page_options& page)
{
  unsigned width = 0, height = 0;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%7ux%7u%c", &width, &height, &rest);
  if ((n != 1 && n != 2) || text != std::to_string(width) + (n == 2 ? "x" + std::to_string(height) : "") ||
      width == 0 || (n == 2 && height == 0))
    throw CLI::ValidationError("--texture-size", "'" + text + "' is neither N nor WxH");
  page.width = width;
  page.height = n == 2 ? height : width;
}

double area_of_charts(const Atlas::Repacked_charts& repacked)
{
  double sum = 0;
  for (const Atlas::Chart& chart : repacked.charts)
    for (const auto& [a, b, c] : chart.triangles)
      sum += std::abs(CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]));
  return sum;
}

/// One line: what came out, and the verdict on it.
void print(const Arguments& arguments, const Atlas::Repacked_charts& repacked,
           const Atlas::Atlas_certificate& certificate)
{
  const Atlas::Packing& packing = repacked.packing;
  const double texels = double(arguments.page.width) * arguments.page.height * packing.number_of_pages;
  const double efficiency =
      texels > 0 ? area_of_charts(repacked) * packing.density * packing.density / texels : 0;
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
  const Atlas::Surface surface = Atlas::build_surface(soup.points, soup.first, soup.vertices);
  const Atlas::Repacked_charts repacked =
      Atlas::pack_charts(surface, soup.uv, arguments.page, Atlas::Raster_packer(arguments.effort), execution);
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
  using Atlas::Chart_rotation, Atlas::Packing_effort;
  Atlas::Page_options& page = arguments.page;
  app.add_option("FILE", arguments.file, "OBJ with vt, PLY or glTF")->required();
  app.add_option("-o,--output", arguments.output, "OBJ file to write")->required();
  app.add_option("--texture-size", arguments.size, "page in texels: N or WxH")->capture_default_str();
  app.add_option("--gutter", page.gutter, "texels between charts; half of it to the border of the page")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app.add_option("--effort", arguments.effort, "fast, normal (default) or best")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Packing_effort>{{"fast", Packing_effort::fast},
                                                                        {"normal", Packing_effort::normal},
                                                                        {"best", Packing_effort::best}}));
  app.add_option("--rotation", page.rotation, "any (default), quarter turns, or none")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Chart_rotation>{{"any", Chart_rotation::any},
                                                {"quarter", Chart_rotation::quarter_turns},
                                                {"none", Chart_rotation::none}}));
  app.add_option("--density", page.density,
                 "texels per unit of the coordinates, on as many pages as that takes")
      ->check(CLI::PositiveNumber);
  app.add_option("--pages", page.pages, "pages to fill; coordinates of page p are in the UDIM tile 1001 + p")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--texture", arguments.texture, "name of a picture for the materials of an MTL file");
  app.add_flag_callback(
      "--stack", [&] { page.stacking = Atlas::Chart_stacking::copies_and_mirrored; },
      "put copies of a chart, mirrored ones too, on top of each other");
  app.add_option("--threads", arguments.threads, "0: all cores")->capture_default_str();
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
    read_size(arguments.size, arguments.page);
    return run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? VALID : COULD_NOT_TELL;
  } catch (const std::exception& error) {
    std::cerr << "repack_atlas: " << error.what() << '\n';
    return COULD_NOT_TELL;
  }
}
