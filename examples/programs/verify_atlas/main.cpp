// SPDX-License-Identifier: MIT
// Proves, or disproves, that the texture coordinates of a mesh file are a valid atlas, whoever made them.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/internal/text_bytes.h>
#include <Atlas/image/pages.h>
#include <Atlas/report/write_report.h>
#include <Atlas/validation/certify.h>

#include "read_page_size.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

enum Exit_code { VALID = 0, NOT_VALID = 1, COULD_NOT_TELL = 2 };

struct Arguments
{
  std::string file, picture, size = std::to_string(Atlas::default_texture_size);
  Atlas::Certificate_options certificate;
  unsigned threads = 0;
  bool is_json = false, has_tiles = false;
};

void print(const Atlas::Atlas_certificate& c)
{
  const auto row = [](const char* name, const auto& value) { std::cout << "  " << name << value << '\n'; };
  std::cout << (c.is_valid() ? "valid" : "NOT VALID: " + Atlas::message(c)) << '\n';
  row("faces                        ", c.faces);
  row("  rejected                   ", c.rejected_faces);
  row("triangles                    ", c.triangles);
  row("  without coordinates        ", c.not_finite);
  row("  flipped                    ", c.flipped);
  row("  flat                       ", c.degenerate);
  row("overlapping pairs in charts  ", c.overlaps_in_charts);
  row("  between charts             ", c.overlaps_between_charts);
  row("corners outside of the page  ", c.corners_outside);
  row("charts                       ", c.charts);
  row("  that are no discs          ", c.non_disc_charts);
  row("  mirrored                   ", c.mirrored_charts);
  row("seam length                  ", c.seam_length);
  row("distance of charts, texels   ", c.chart_distance);
  row("  to the border of the page  ", c.page_border_distance);
  row("texels per unit, smallest    ", c.density_min);
  row("  largest                    ", c.density_max);
}

/// Of all kinds of faults, sorted.
std::vector<Atlas::Index> faces_to_blame(const Atlas::Atlas_certificate& c)
{
  std::vector<Atlas::Index> faces;
  std::set_union(c.culprits.begin(), c.culprits.end(), c.crowded_faces.begin(), c.crowded_faces.end(),
                 std::back_inserter(faces));
  return faces;
}

int run(const Arguments& arguments)
{
  Atlas::Polygon_soup soup = Atlas::read_polygon_soup(arguments.file);
  if (soup.uv.empty())
    throw Atlas::IO_error(arguments.file + ": there are no texture coordinates in this file");
  if (arguments.has_tiles)
    separate_udim(soup);
  const Atlas::Surface surface = Atlas::build_surface(soup.points, soup.first, soup.vertices);
  const Atlas::Atlas_certificate certificate = Atlas::certify(
      surface, soup.uv, soup.face_page, arguments.certificate, Atlas::Execution(arguments.threads));
  if (!arguments.picture.empty()) {
    const Atlas::Image_size page(arguments.certificate.width, arguments.certificate.height);
    Atlas::write_png(arguments.picture,
                     Atlas::draw_atlas(Atlas::sheet_of_pages(soup), certificate.face_chart,
                                       page.with_longer_side(1024), faces_to_blame(certificate)));
  }
  if (arguments.is_json)
    std::cout << Atlas::to_json(certificate).dump(2) << '\n';
  else
    print(certificate);
  if (!std::cout.flush())
    throw Atlas::IO_error("cannot write the certificate: standard output is closed or full");
  return certificate.is_valid() ? VALID : NOT_VALID;
}

} // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  CLI::App app("Verifies the texture coordinates of a mesh file.\n"
               "Exit code: 0 valid, 1 not valid, 2 could not tell (bad file, wrong option).");
  app.add_option("FILE", arguments.file, "OBJ with vt, PLY or glTF")->required();
  app.add_option("--texture-size", arguments.size, "page in texels: N for a square, or WIDTHxHEIGHT")
      ->capture_default_str();
  app.add_option("--gutter", arguments.certificate.gutter,
                 "texels that charts have to keep from each other; half of it from the border of the page")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app.add_option("--precision", arguments.certificate.precision,
                 "how coordinates are stored where they are used: they are rounded first")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Atlas::Uv_precision>{{"single", Atlas::Uv_precision::single_precision},
                                                     {"double", Atlas::Uv_precision::double_precision}}));
  app.add_option("--threads", arguments.threads, "0: all cores")->capture_default_str();
  app.add_option("--picture", arguments.picture,
                 "PNG of the page; faces to blame, also for the gutter, in red");
  app.add_flag("--udim", arguments.has_tiles,
               "coordinates are UDIM tiles: pages beside each other, ten a row");
  app.add_flag("--json", arguments.is_json, "print JSON");
  try {
    app.parse(argc, argv);
    read_page_size(arguments.size, arguments.certificate.width, arguments.certificate.height);
    return run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? VALID : COULD_NOT_TELL;
  } catch (const std::exception& error) {
    std::cerr << "verify_atlas: " << Atlas::internal::printable(error.what()) << '\n';
    return COULD_NOT_TELL;
  }
}
