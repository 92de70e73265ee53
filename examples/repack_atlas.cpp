// SPDX-License-Identifier: MIT
// Packs the texture coordinates of a mesh file anew, whoever made them; the shapes of the charts stay as they
// are.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_obj.h>
#include <Atlas/build_surface.h>
#include <Atlas/packing/pack_charts.h>
#include <Atlas/validation/certify.h>

#include "read_page_size.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace {

enum Exit_code { VALID = 0, NOT_VALID = 1, COULD_NOT_TELL = 2 };

struct Arguments
{
  std::string file, output, texture, size = std::to_string(Atlas::default_texture_size);
  std::vector<std::string> weights, locked, grouped; ///< materials; "NAME=FACTOR" in the first
  Atlas::Page_options page;
  Atlas::Packing_effort effort = Atlas::Packing_effort::normal;
  unsigned threads = 0;
};

/// Leaves charts alone: for what is known of them before they are packed.
struct Unpacked
{
  Atlas::Packing pack(std::span<const Atlas::Chart> charts, const Atlas::Page_options&,
                      const Atlas::Execution&) const
  {
    return {std::vector<Atlas::Placement>(charts.size()), 0, 0, 0};
  }
};

Atlas::Index material_of_name(const Atlas::Polygon_soup& soup, const std::string& name, const char* option)
{
  const auto at = std::find(soup.material_names.begin(), soup.material_names.end(), name);
  if (at == soup.material_names.end())
    throw CLI::ValidationError(option, "there is no material called '" + name + "' in this file");
  return static_cast<Atlas::Index>(at - soup.material_names.begin());
}

/// "NAME=FACTOR"; names may have an equals sign in them.
std::pair<std::string, double> read_weight(const std::string& text)
{
  const std::size_t equals = text.rfind('=');
  double factor = 0;
  if (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), factor) ||
      !(factor > 0 && std::isfinite(factor)))
    throw CLI::ValidationError("--weight", "'" + text + "' is not NAME=FACTOR with a positive factor");
  return {text.substr(0, equals), factor};
}

/// Where a chart lies, as a placement: in the tile that the middle of its box is in.
Atlas::Placement place_of_chart(const Atlas::Chart& chart, const Atlas::Page_options& page)
{
  CGAL::Bbox_2 box;
  for (const Atlas::Point_2& p : chart.uv)
    box += p.bbox();
  const double u = std::floor((box.xmin() + box.xmax()) / 2), v = std::floor((box.ymin() + box.ymax()) / 2);
  if (!(u >= 0 && u < 10 && v >= 0 && v < 900))
    throw Atlas::IO_error("a locked chart lies outside of the tiles 1001 to 9999: u = " + std::to_string(u) +
                          ", v = " + std::to_string(v));
  const double side = page.width;
  return {side, 0, -side * u, -side * v, static_cast<Atlas::Index>(u + 10 * v)};
}

/// Turns the options for materials into those for charts; a chart has the material of its first face.
void apply_materials(const Arguments& arguments, const Atlas::Polygon_soup& soup,
                     const Atlas::Surface& surface, Atlas::Page_options& page)
{
  if (arguments.weights.empty() && arguments.locked.empty() && arguments.grouped.empty())
    return;
  if (!arguments.locked.empty() && page.width != page.height)
    throw CLI::ValidationError("--lock", "charts stay where they are on square pages only");
  const std::vector<Atlas::Chart> charts = Atlas::pack_charts(surface, soup.uv, page, Unpacked()).charts;
  std::vector<Atlas::Index> material;
  for (const Atlas::Chart& chart : charts) {
    const Atlas::Index face = surface.face[chart.source.front()];
    material.push_back(soup.face_material.empty() ? Atlas::no_index : soup.face_material[face]);
  }
  page.weights.assign(charts.size(), 1);
  page.locked.resize(charts.size());
  page.groups.assign(charts.size(), Atlas::no_index);
  const auto for_charts_of = [&](const std::string& name, const char* option, auto apply) {
    const Atlas::Index wanted = material_of_name(soup, name, option);
    for (std::size_t c = 0; c < charts.size(); ++c)
      if (material[c] == wanted)
        apply(c);
  };
  for (const std::string& text : arguments.weights) {
    const auto [name, factor] = read_weight(text);
    for_charts_of(name, "--weight", [&, f = factor](std::size_t c) { page.weights[c] = f; });
  }
  for (const std::string& name : arguments.grouped)
    for_charts_of(name, "--group", [&](std::size_t c) { page.groups[c] = material[c]; });
  for (const std::string& name : arguments.locked)
    for_charts_of(name, "--lock", [&](std::size_t c) { page.locked[c] = place_of_chart(charts[c], page); });
}

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
  const Atlas::Surface surface = Atlas::build_surface(soup.points, soup.first, soup.vertices);
  Atlas::Page_options page = arguments.page;
  apply_materials(arguments, soup, surface, page);
  const Atlas::Repacked_charts repacked =
      Atlas::pack_charts(surface, soup.uv, page, Atlas::Raster_packer(arguments.effort), execution);
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
  app.add_option("--texture-size", arguments.size, "page in texels: N for a square, or WIDTHxHEIGHT")
      ->capture_default_str();
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
  app.add_option("--mip-levels", page.mip_levels,
                 "keep charts apart down to this level of a mip-map: by 2^n texels")
      ->check(CLI::Range(0, 14))
      ->capture_default_str();
  app.add_option("--block", page.block,
                 "no two charts share a block of so many texels squared: 4 for most texture compression")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option(
      "--weight", arguments.weights,
      "MATERIAL=FACTOR: the charts of a material get so many times the density; several may be given");
  app.add_option("--lock", arguments.locked,
                 "MATERIAL: its charts stay where they are, and the others are packed around them");
  app.add_option("--group", arguments.grouped,
                 "MATERIAL: its charts keep their places beside each other and move as one");
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
    read_page_size(arguments.size, arguments.page.width, arguments.page.height);
    return run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? VALID : COULD_NOT_TELL;
  } catch (const std::exception& error) {
    std::cerr << "repack_atlas: " << error.what() << '\n';
    return COULD_NOT_TELL;
  }
}
