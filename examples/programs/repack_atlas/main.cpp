// SPDX-License-Identifier: MIT
// Packs the texture coordinates of a mesh file anew, whoever made them; the shapes of the charts stay as they
// are, unless charts are to merge.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/image/internal/text_bytes.h>
#include <Atlas/soup/internal/atlas_of_soup.h>
#include <Atlas/validation/certify.h>

#include "repack_atlas.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

/// Per face its page, where each layer of charts that are copies of those below is a page of its own: these
/// lie on each other as they should.
std::vector<Atlas::Index> pages_of_layers(const Atlas::Repacked_charts& repacked,
                                          const Atlas::Surface& surface, std::vector<Atlas::Index> pages)
{
  const Atlas::Packing& packing = repacked.packing;
  for (std::size_t i = 0; i < packing.layers.size(); ++i)
    for (const Atlas::Index t : repacked.charts[i].source)
      pages[surface.face[t]] = packing.placements[i].page + packing.layers[i] * packing.number_of_pages;
  return pages;
}

/// One line: what came out, and the verdict on it. A density that was not kept is told besides.
void print(const Arguments& arguments, const Atlas::Repacked_charts& repacked,
           const Atlas::Atlas_certificate& certificate)
{
  const Atlas::Packing& packing = repacked.packing;
  const double efficiency = Atlas::internal::packing_efficiency(repacked, arguments.page);
  const auto stacked = std::count_if(packing.layers.begin(), packing.layers.end(),
                                     [](Atlas::Index layer) { return layer > 0; });
  std::printf("charts=%zu pages=%u efficiency=%.3f gutter=%.2f texels_per_unit=%.6g stacked=%td %s\n",
              repacked.charts.size(), packing.number_of_pages, efficiency, packing.gutter, packing.density,
              stacked,
              certificate.is_valid() ? "valid" : ("NOT VALID: " + Atlas::message(certificate)).c_str());
  tell_lower_density("repack_atlas", arguments, packing.density);
}

/// What is wrong with the name of the file to write; empty: nothing.
std::string fault_of_output(const std::string& name)
{
  const std::string_view ending = ".obj";
  const bool is_obj = name.size() > ending.size() && name.ends_with(ending);
  return is_obj ? std::string() : "repack_atlas writes OBJ files: the name must end in .obj";
}

int repack(const Arguments& arguments, Atlas::Polygon_soup soup, Atlas::Surface& surface,
           const Atlas::Execution& execution)
{
  Atlas::internal::Soup_options wishes;
  wishes.page = arguments.page;
  wishes.effort = arguments.effort;
  wishes.rules = rules_of(arguments.materials, soup);
  const Atlas::Repacked_charts repacked = repack_soup(wishes, soup, surface, execution);
  if (!repacked.charts.empty() && repacked.packing.number_of_pages == 0)
    throw Atlas::IO_error(arguments.file + ": the page has no room for so many charts");
  soup.uv = repacked.uv;
  soup.face_page = Atlas::internal::pages_of_faces(repacked, surface);

  Atlas::Certificate_options options;
  options.width = arguments.page.width;
  options.height = arguments.page.height;
  options.gutter = repacked.packing.gutter;
  options.precision = Atlas::Uv_precision::single_precision;
  const Atlas::Atlas_certificate certificate = Atlas::certify(
      surface, soup.uv, pages_of_layers(repacked, surface, soup.face_page), options, execution);
  if (arguments.texture.empty())
    Atlas::write_obj(arguments.output, soup);
  else
    Atlas::write_obj(arguments.output, soup, arguments.texture);
  print(arguments, repacked, certificate);
  return certificate.is_valid() ? VALID : NOT_VALID;
}

int run(const Arguments& arguments)
{
  Atlas::internal::check_can_write(arguments.output);
  const Atlas::Execution execution(arguments.threads);
  Atlas::Polygon_soup soup = Atlas::read_polygon_soup(arguments.file);
  if (soup.uv.empty())
    throw Atlas::IO_error(arguments.file + ": there are no texture coordinates in this file");
  Atlas::Surface surface = Atlas::build_surface(soup.points, soup.first, soup.vertices);
  const int code = arguments.merges ? defragment(arguments, std::move(soup), surface, execution)
                                    : repack(arguments, std::move(soup), surface, execution);
  if (std::fflush(stdout) != 0)
    throw Atlas::IO_error("cannot write the report: standard output is closed or full");
  return code;
}

void add_options(CLI::App& app, Arguments& arguments)
{
  app.add_option("FILE", arguments.file, "OBJ with vt, PLY or glTF")->required();
  app.add_option("-o,--output", arguments.output,
                 "OBJ file to write; coordinates of several pages are UDIM tiles, 1001 the first")
      ->required()
      ->check(fault_of_output);
  arguments.effort = Atlas::Packing_effort::normal;
  add_packing_options(app, arguments);
  CLI::Option* texture =
      app.add_option("--texture", arguments.texture, "Name of a picture for the materials of an MTL file");
  CLI::Option* merge =
      app.add_flag("--defragment", arguments.merges,
                   "Merge charts where the union can be flattened within the bounds below; all others keep "
                   "their shapes. The texture moves along, to OUT_texture.png and OUT.mtl. Without "
                   "--texture-size the page has as many texels as the pictures have, or more")
          ->excludes(texture);
  app.add_option(
         "--max-distortion", arguments.max_distortion,
         "Charts merge while their mean symmetric Dirichlet energy (1 is isometric) stays below this. "
         "Default: 1.035")
      ->check(CLI::Range(1.0, 1e6))
      ->needs(merge);
  app.add_option("--max-stretch", arguments.max_stretch,
                 "Besides, no length on 99 % of such a chart is stretched or shrunk by more than this "
                 "factor. Default: 1.5")
      ->check(CLI::Range(1.0, 1e6))
      ->needs(merge);
  app.add_option("--threads", arguments.threads, "Number of threads; 0 takes all cores")
      ->capture_default_str();
}

} // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  CLI::App app("Packs the texture coordinates of a mesh file anew; the shapes of charts stay as they are, or "
               "charts merge.\n"
               "Exit code: 0 valid, 1 not valid (folded charts, charts on top of each other), 2 no result.");
  add_options(app, arguments);
  try {
    app.parse(argc, argv);
    complete(arguments);
    arguments.has_size = app.count("--texture-size") > 0;
    return run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? VALID : COULD_NOT_TELL;
  } catch (const std::exception& error) {
    std::cerr << "repack_atlas: " << Atlas::internal::printable(error.what()) << '\n';
    return COULD_NOT_TELL;
  }
}
