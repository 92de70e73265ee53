// SPDX-License-Identifier: MIT
// Few charts out of many, and the texture along with them.
#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/image/internal/text_bytes.h>
#include <Atlas/image/pages.h>
#include <Atlas/soup/internal/atlas_of_soup.h>
#include <Atlas/soup/orient_faces.h>

#include "repack_atlas.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

namespace {

/// Whether a face shows something.
bool is_shown(const Atlas::Source_textures& source)
{
  return std::any_of(source.face_texture.begin(), source.face_texture.end(),
                     [](Atlas::Index texture) { return texture != Atlas::no_index; });
}

/// The side of a square page with at least as many texels as all pictures have, a power of two; 0: there are
/// no pictures.
Atlas::Index side_for(const Atlas::Source_textures& source)
{
  constexpr double largest = 16384;
  double texels = 0;
  for (const Atlas::Source_texture& texture : source.textures)
    texels += static_cast<double>(texture.image.width) * static_cast<double>(texture.image.height);
  const auto side = static_cast<std::uint32_t>(std::ceil(std::min(std::sqrt(texels), largest)));
  return side == 0 ? 0 : std::bit_ceil(side);
}

/// The model with a material library, and a picture for each page.
void write_all(const Arguments& arguments, const Atlas::Polygon_soup& soup,
               const Atlas::Source_textures& source, const Atlas::Execution& execution)
{
  const std::filesystem::path output = arguments.output;
  const std::string stem = output.stem().string(), picture = stem + "_texture.png";
  const Atlas::Image_size size(arguments.page.width, arguments.page.height);
  const Atlas::Index pages = soup.number_of_pages();
  Atlas::internal::Output_files files;
  bool has_alpha = false;
  for (Atlas::Index page = 0; page < pages; ++page) {
    const Atlas::Image image = Atlas::transfer_texture(soup, size, source, page, execution);
    has_alpha = has_alpha || !image.alpha.empty();
    files.add(output.parent_path() / Atlas::page_file_name(picture, page, pages), Atlas::png_bytes(image));
  }
  files.add(output, Atlas::obj_text(soup, stem + ".mtl"));
  files.add(output.parent_path() / (stem + ".mtl"),
            Atlas::mtl_text(soup, picture, Atlas::Page_style::udim, has_alpha));
  files.commit();
}

/// One line, as for charts that keep their shapes.
void print(const Atlas::Atlas_report& report, Atlas::Index before)
{
  std::printf(
      "charts=%zu before=%u pages=%zu efficiency=%.3f gutter=%.2f texels_per_unit=%.6g stacked=%zu %s\n",
      report.charts.size(), before, report.pages, report.packing_efficiency, report.gutter, report.density,
      report.stacked_charts,
      report.is_valid() ? "valid" : ("NOT VALID: " + message(report.certificate)).c_str());
}

} // namespace

Exit_code defragment(const Arguments& given, Atlas::Polygon_soup soup, Atlas::Surface& surface,
                     const Atlas::Execution& execution)
{
  Arguments arguments = given;
  const Atlas::Source_textures source = Atlas::read_textures(arguments.file, soup);
  for (const std::string& warning : source.warnings)
    std::fprintf(stderr, "repack_atlas: %s: %s\n", arguments.file.c_str(),
                 Atlas::internal::printable(warning).c_str());
  if (const Atlas::Index side = side_for(source); side > 0 && !arguments.has_size)
    arguments.page.width = arguments.page.height = side;

  Atlas::internal::Soup_options wishes;
  wishes.merges_uv = true;
  wishes.page = arguments.page;
  wishes.effort = arguments.effort;
  wishes.max_distortion = arguments.max_distortion;
  wishes.max_stretch = arguments.max_stretch;
  wishes.rules = rules_of(arguments.materials, soup);
  wishes.threads = arguments.threads;
  const Atlas::Index before = Atlas::charts_of_uv(surface, soup.uv).number_of_charts;
  std::vector<Atlas::Point_2> uv;
  const Atlas::Atlas_report report = atlas_of_soup(wishes, soup, surface, uv, {});
  if (uv.empty())
    throw Atlas::IO_error(arguments.file + ": " + message(report.status));
  soup.old_uv = std::exchange(soup.uv, std::move(uv));
  soup.face_page = report.face_page;
  start_polygons_at_fans(surface, soup);
  if (is_shown(source))
    write_all(arguments, soup, source, execution);
  else
    Atlas::write_obj(arguments.output, soup);
  print(report, before);
  tell_lower_density("repack_atlas", arguments, report.density);
  return report.is_valid() ? VALID : NOT_VALID;
}
