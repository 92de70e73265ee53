// SPDX-License-Identifier: MIT
// The files that the program leaves.
#include <Atlas/IO/write_model.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/image/pages.h>
#include <Atlas/image/render_model.h>
#include <Atlas/report/write_report.h>
#include <Atlas/soup/internal/face_distortion.h>

#include "bakes.h"
#include "texture_atlas.h"
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <utility>

namespace {

namespace fs = std::filesystem;

/// The name of a file beside the model.
fs::path beside(const fs::path& output, const std::string& suffix)
{
  return output.parent_path() / (output.stem().string() + suffix);
}

Atlas::Image side_by_side(const Atlas::Image& left, const Atlas::Image& right)
{
  Atlas::Image image(left.width + right.width, std::max(left.height, right.height));
  paste(left, image, 0, 0);
  paste(right, image, left.width, 0);
  return image;
}

/// Files that appear together, and their names.
class Outputs
{
public:
  void add(const fs::path& path, const std::string& bytes)
  {
    files_.add(path, bytes);
    names_.push_back(path.string());
  }

  const std::vector<std::string>& names() const { return names_; }

  /// Gives the files their names.
  void commit() { files_.commit(); }

private:
  Atlas::internal::Output_files files_;
  std::vector<std::string> names_;
};

/// What the model shows: its baked colours or texture, or a checkerboard on every page.
Textures texture_of_model(const Options& options, const Atlas::Polygon_soup& model, const Baker& bake,
                          const Atlas::Execution& execution)
{
  for (const Bake what : {Bake::texture, Bake::colors})
    if (options.has(what))
      return bake(what, execution);
  const Atlas::Image_size page(options.page.width, options.page.height);
  const std::size_t side = std::min<std::size_t>(page.longer_side(), 4096);
  const Atlas::Image board =
      Atlas::checkerboard(page.with_longer_side(side), std::max<std::size_t>(side / 16, 2));
  return {std::vector<Atlas::Image>(model.number_of_pages(), board), "_checkerboard.png", {}};
}

/// The pictures of several pages have the number of their tile in their name.
void add_textures(Outputs& outputs, const fs::path& output, const std::vector<std::string>& pngs,
                  const std::string& suffix)
{
  const auto pages = static_cast<Atlas::Index>(pngs.size());
  for (Atlas::Index page = 0; page < pages; ++page) {
    const std::string name = beside(output, suffix).filename().string();
    outputs.add(output.parent_path() / Atlas::page_file_name(name, page, pages), pngs[page]);
  }
}

/// Pages that look like the one before them, as all of a checkerboard do, are not compressed again.
std::vector<std::string> pngs_of(const Textures& textures)
{
  std::vector<std::string> pngs;
  for (std::size_t page = 0; page < textures.pages.size(); ++page) {
    const bool is_repeated = page > 0 && textures.pages[page].pixels == textures.pages[page - 1].pixels &&
                             textures.pages[page].alpha == textures.pages[page - 1].alpha;
    pngs.push_back(is_repeated ? pngs.back() : Atlas::png_bytes(textures.pages[page]));
  }
  return pngs;
}

bool has_alpha(const Textures& textures)
{
  return std::any_of(textures.pages.begin(), textures.pages.end(),
                     [](const Atlas::Image& page) { return !page.alpha.empty(); });
}

/// Takes colours out of the model that are in its texture now, or would be multiplied by it, as in glTF.
void clear_baked_colors(const Options& options, Input& input)
{
  const auto& textures = input.source.textures;
  const bool are_in_texture =
      std::any_of(textures.begin(), textures.end(), [](const auto& t) { return t.multiplies_colors; });
  const bool is_gltf = fs::path(options.output).extension() == ".glb";
  if (!options.has(Bake::colors) && !(options.has(Bake::texture) && (are_in_texture || is_gltf)))
    return;
  input.models.whole().colors.clear();
  input.models.whole().face_colors.clear();
}

/// The materials of an MTL file with the map of normals beside each picture (`norm`, as the extension of the
/// format for physically based materials has it).
std::string with_normal_maps(const std::string& library, const std::string& suffix)
{
  const std::string stem = suffix.substr(0, suffix.rfind('.'));
  std::istringstream lines(library);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    result += line + '\n';
    const std::size_t at = line.rfind(stem);
    if (line.rfind("map_Kd ", 0) == 0 && at != std::string::npos)
      result += "norm " + line.substr(7, at - 7) + "_tangent_normal" + line.substr(at + stem.size()) + '\n';
  }
  return result;
}

/// The models in the format that the extension of the output names, with the texture of all. It is inside of
/// a glTF file only if there is but one model.
void add_models(Outputs& outputs, const Options& options, const Atlas::Joined_soups& models,
                const Textures& textures)
{
  const fs::path output = options.output;
  const std::vector<std::string> pngs = pngs_of(textures);
  if (options.keeps_document() && pngs.size() == 1) {
    Atlas::Gltf_changes changes;
    changes.uv_set = options.uv_set;
    changes.has_base_factors = options.has(Bake::texture);
    if (options.has(Bake::texture) || options.has(Bake::colors))
      changes.base_color_png = pngs[0];
    outputs.add(output, Atlas::glb_bytes(options.meshes.front(), models.whole(), changes));
    return;
  }
  if (output.extension() == ".glb" && models.number_of_parts() == 1) {
    outputs.add(output, Atlas::glb_bytes(models.whole(), pngs));
    return;
  }
  const std::string picture = beside(output, textures.suffix).filename().string();
  const auto pages = static_cast<Atlas::Index>(pngs.size());
  const fs::path library = beside(output, ".mtl");
  const auto bytes_of = [&](const Atlas::Polygon_soup& model) {
    if (output.extension() == ".ply")
      return Atlas::ply_bytes(model, picture, Atlas::Ply_texcoord_style::wedge, pages);
    if (output.extension() == ".obj")
      return Atlas::obj_text(model, library.filename().string());
    std::vector<std::string> names;
    for (Atlas::Index page = 0; page < pages; ++page)
      names.push_back(Atlas::page_file_name(picture, page, pages));
    return Atlas::glb_bytes(model, names, Atlas::Gltf_textures::files);
  };
  const std::vector<std::string> files = options.models();
  for (std::size_t i = 0; i < files.size(); ++i)
    outputs.add(files[i], files.size() == 1 ? bytes_of(models.whole()) : bytes_of(models.part(i)));
  if (output.extension() == ".obj") {
    const std::string materials =
        Atlas::mtl_text(models.whole(), picture, Atlas::Page_style::udim, has_alpha(textures));
    outputs.add(library, options.has(Bake::tangent_normals) ? with_normal_maps(materials, textures.suffix)
                                                            : materials);
  }
  add_textures(outputs, output, pngs, textures.suffix);
}

/// Adds what is to be said of the seams of a texture, if they have been closed.
void tell_seams(const std::string& suffix, const std::optional<Atlas::internal::Seams_closed>& seams,
                Atlas::Json& json, std::vector<std::string>& lines)
{
  if (!seams)
    return;
  const auto& before = seams->before.largest;
  const auto& after = seams->after.largest;
  json.push_back({{"texture", suffix},
                  {"edges", seams->after.seams},
                  {"largest_difference_before", before},
                  {"largest_difference", after}});
  char line[200];
  std::snprintf(
      line, sizeof line,
      "%s: sides differ by at most %.2f, %.2f, %.2f of 255 at mip levels 0, 1, 2; were %.0f, %.0f, %.0f",
      suffix.c_str(), after[0], after[1], after[2], before[0], before[1], before[2]);
  lines.emplace_back(line);
}

/// Adds the pages of heights. Returns the largest.
double add_heights(Outputs& outputs, const fs::path& output, const Baker& bake, Atlas::Json& seams,
                   std::vector<std::string>& lines, const Atlas::Execution& execution)
{
  std::optional<Atlas::internal::Seams_closed> closed;
  const Atlas::internal::Height_maps heights = bake.heights(closed, execution);
  std::vector<std::string> pngs;
  for (std::size_t page = 0; page < heights.pages.size(); ++page)
    pngs.push_back(png_of_heights(heights, page, bake.size()));
  add_textures(outputs, output, pngs, suffix_of(Bake::displacement));
  tell_seams(suffix_of(Bake::displacement), closed, seams, lines);
  return heights.largest;
}

/// Which models there are, and where each starts in the lists of the report.
Atlas::Json description(const Options& options, const Atlas::Joined_soups& models)
{
  if (options.meshes.size() == 1)
    return {{"mesh", options.meshes.front()}, {"vertices", models.whole().points.size()}};
  Atlas::Json list = Atlas::Json::array();
  const std::vector<std::string> files = options.models();
  for (std::size_t i = 0; i < files.size(); ++i)
    list.push_back({{"mesh", options.meshes[i]},
                    {"model", files[i]},
                    {"first_vertex", models.first_vertex(i)},
                    {"first_face", models.first_face(i)}});
  return {{"meshes", list}, {"vertices", models.whole().points.size()}};
}

/// Those that have been asked for. Several pages are shown side by side.
void add_pictures(Outputs& outputs, const Options& options, const Atlas::Polygon_soup& model,
                  const Textures& textures, const Atlas::Atlas_report& report)
{
  if (!options.has_pictures && options.picture.empty())
    return;
  const fs::path output = options.output;
  const Atlas::Polygon_soup sheet = Atlas::sheet_of_pages(model);
  const std::vector<Atlas::Index>& culprits = report.certificate.culprits;
  Atlas::Report_pictures pictures;
  const Atlas::Image_size shape(options.page.width, options.page.height);
  pictures.view = Atlas::render_model(sheet, Atlas::sheet_of_images(textures.pages));
  if (options.has_pictures) {
    const std::vector<double> stretch =
        Atlas::face_stretch(Atlas::measure_distortion(model), model.number_of_faces());
    pictures.page = Atlas::draw_atlas(sheet, report.face_chart, shape.with_longer_side(1024), culprits);
    pictures.stretch = Atlas::draw_stretch(sheet, stretch, shape.with_longer_side(1024));
    outputs.add(beside(output, "_page.png"), Atlas::png_bytes(pictures.page));
    outputs.add(beside(output, "_stretch.png"),
                Atlas::png_bytes(Atlas::with_stretch_scale(pictures.stretch)));
    outputs.add(beside(output, "_view.png"), Atlas::png_bytes(pictures.view));
    outputs.add(beside(output, ".html"), Atlas::html_report(sheet, report, pictures, options.title()));
  }
  if (!options.picture.empty()) {
    const Atlas::Image page =
        Atlas::draw_atlas(sheet, report.face_chart, shape.with_longer_side(pictures.view.height), culprits);
    outputs.add(options.picture, Atlas::png_bytes(side_by_side(page, pictures.view)));
  }
}

} // namespace

bool is_stacked_wrongly(const Options& options, const Input& input, const Atlas::Atlas_report& report)
{
  if (report.stacked_charts == 0)
    return false;
  constexpr double tolerance = 0.02; // borders of charts that are equal need not be, texel by texel
  const Atlas::Polygon_soup& model = input.models.whole();
  const Atlas::Image_size size(report.page_width, report.page_height);
  const Baker baker(options, input, size);
  const auto differs = [&](const Atlas::Bake_shader& shader) {
    for (Atlas::Index page = 0; page < model.number_of_pages(); ++page)
      if (Atlas::differing_share(model, size, shader, page) > tolerance)
        return true;
    return false;
  };
  return (options.has(Bake::colors) && differs(baker.shader(Bake::colors))) ||
         (options.has(Bake::texture) && (differs(baker.shader(Bake::texture)) || differs(baker.opacity())));
}

void check_outputs(const Options& options)
{
  for (const std::string& model : options.models())
    Atlas::internal::check_can_write(model);
  for (const std::string& file : {options.report, options.picture})
    if (!file.empty())
      Atlas::internal::check_can_write(file);
}

Written write_outputs(const Options& options, Input& input, const Atlas::Atlas_report& report,
                      const Atlas::Execution& execution)
{
  Written written;
  Atlas::Json seams = Atlas::Json::array(), displacement;
  Outputs outputs;
  Atlas::Polygon_soup& model = input.models.whole();
  const fs::path output = options.output;
  const bool is_device = fs::exists(output) && !fs::is_regular_file(output); // then nothing lies beside it
  if (is_device) {
    outputs.add(output, Atlas::obj_text(model, ""));
  } else {
    if (options.has(Bake::tangent_normals)) // whoever shows them has to have the same normals
      Atlas::add_normals(model);
    const Baker bake(options, input, Atlas::Image_size(options.page.width, options.page.height));
    const Textures textures = texture_of_model(options, model, bake, execution);
    tell_seams(textures.suffix, textures.seams, seams, written.seams);
    clear_baked_colors(options, input);
    add_models(outputs, options, input.models, textures);
    for (const Bake what : {Bake::normals, Bake::tangent_normals, Bake::occlusion})
      if (options.has(what)) {
        const Textures further = bake(what, execution);
        add_textures(outputs, output, pngs_of(further), further.suffix);
        tell_seams(further.suffix, further.seams, seams, written.seams);
      }
    if (options.has(Bake::displacement))
      displacement = add_heights(outputs, output, bake, seams, written.seams, execution);
    add_pictures(outputs, options, model, textures, report);
  }
  Atlas::Json json = description(options, input.models);
  json.update(to_json(report));
  if (!seams.empty())
    json["seams_of_textures"] = seams;
  if (!displacement.is_null())
    json["largest_displacement"] = displacement;
  if (!options.tells_times)
    json.erase("seconds");
  if (!is_device || !options.report.empty())
    outputs.add(options.report.empty() ? beside(output, ".json") : fs::path(options.report),
                Atlas::json_text(json));
  if (!execution.proceed(1))
    return {};
  if (options.before_writing)
    options.before_writing(outputs.names());
  outputs.commit();
  written.names = outputs.names();
  return written;
}
