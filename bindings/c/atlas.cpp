// SPDX-License-Identifier: MIT
// The C interface: structs of C to those of the library and back, exceptions to numbers and sentences.
#include <Atlas/atlas.h>
#include <Atlas/core/errors.h>
#include <Atlas/version.h>

#include "../Scene.h"
#include <algorithm>
#include <cstring>
#include <exception>
#include <iterator>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

using namespace Atlas;

static_assert(std::is_same_v<unsigned int, Index> && no_index == ATLAS_NONE);
static_assert(int(Atlas_mode::paper) == ATLAS_MODE_PAPER &&
              int(Chart_rotation::none) == ATLAS_ROTATION_NONE &&
              int(Chart_rotation::aligned) == ATLAS_ROTATION_ALIGNED &&
              int(Chart_stacking::copies_and_mirrored) == ATLAS_STACK_MIRRORED &&
              int(Packing_effort::best) == ATLAS_EFFORT_BEST &&
              int(Stage::verification) == ATLAS_STAGE_VERIFICATION &&
              int(Distortion_measure::quasi_conformal) + 1 == ATLAS_MEASURE_QUASI_CONFORMAL);

struct atlas_scene
{
  bindings::Scene scene;
  std::string error, report = "null";
};

namespace {

/// Why a call fails. An error that is no exception of the library has no words of its own.
int status_of_exception(std::string& error) noexcept
{
  try {
    try {
      throw;
    } catch (const Invalid_argument& e) {
      error = e.what();
      return ATLAS_INVALID_ARGUMENT;
    } catch (const std::bad_alloc&) {
      error.clear(); // needs no memory
      return ATLAS_OUT_OF_MEMORY;
    } catch (const std::exception& e) {
      error = e.what();
    } catch (...) {
      error = atlas_message(ATLAS_FAILED);
    }
  } catch (...) {
    return ATLAS_OUT_OF_MEMORY;
  }
  return ATLAS_FAILED;
}

/// Calls `body`, which gives a status, for a scene that is there. No exception leaves.
template <typename Body>
int guarded(atlas_scene* scene, Body body) noexcept
{
  if (!scene)
    return ATLAS_INVALID_ARGUMENT;
  scene->error.clear();
  try {
    const int status = body();
    if (status != ATLAS_OK && scene->error.empty())
      scene->error = atlas_message(status);
    return status;
  } catch (...) {
    return status_of_exception(scene->error);
  }
}

/// A struct as this library knows it, of one that may be older: what that lacks is as in `defaults`.
template <typename Struct>
Struct as_known(const Struct* given, const Struct& defaults, const char* argument)
{
  internal::require(given != nullptr, argument, "is a null pointer");
  internal::require(given->size >= sizeof(std::size_t) && given->size <= sizeof(Struct), argument,
                    "has a size that this library does not know: it has not been initialised, or is newer");
  Struct result = defaults;
  std::memcpy(&result, given, given->size);
  return result;
}

/// Hands a struct to a caller who may know less of it.
template <typename Struct>
void give(Struct known, Struct* wanted)
{
  internal::require(wanted != nullptr, "the struct", "is a null pointer");
  internal::require(wanted->size >= sizeof(std::size_t) && wanted->size <= sizeof(Struct), "the struct",
                    "has a size that this library does not know: it has not been initialised, or is newer");
  known.size = wanted->size;
  std::memcpy(wanted, &known, wanted->size);
}

/// The value of an enumeration, whose values in C and C++ are the same.
template <typename Enumeration>
Enumeration value_of(int value, int last, const char* argument)
{
  if (value < 0 || value > last)
    throw Invalid_argument(argument,
                           "must be in 0 to " + std::to_string(last) + ", but is " + std::to_string(value));
  return static_cast<Enumeration>(value);
}

atlas_options default_options()
{
  const Page_options page;
  atlas_options options{};
  options.size = sizeof options;
  options.width = page.width;
  options.height = page.height;
  options.gutter = page.gutter;
  options.block = page.block;
  options.pages = page.pages;
  options.seam_exchange_rate = -1;
  return options;
}

Page_options page_of(const atlas_options& options)
{
  Page_options page;
  page.width = options.width;
  page.height = options.height;
  page.gutter = options.gutter;
  page.mip_levels = options.mip_levels;
  page.block = options.block;
  page.pages = options.pages;
  page.density = options.density;
  page.rotation = value_of<Chart_rotation>(options.rotation, ATLAS_ROTATION_NONE, "rotation");
  page.stacking = value_of<Chart_stacking>(options.stack, ATLAS_STACK_MIRRORED, "stack");
  std::copy(std::begin(options.up), std::end(options.up), page.up.begin());
  page.snaps = options.snap != 0;
  page.has_free_aspect = options.free_aspect != 0;
  return page;
}

std::optional<Seam_hiding> hiding_of(const atlas_options& options)
{
  const Vector_3 axis(options.hide_axis[0], options.hide_axis[1], options.hide_axis[2]);
  switch (value_of<int>(options.hide_seams, ATLAS_HIDE_VIEW, "hide_seams")) {
  case ATLAS_HIDE_OPENNESS:
    return Seam_hiding::openness();
  case ATLAS_HIDE_DOME:
    return Seam_hiding::dome(axis);
  case ATLAS_HIDE_VIEW:
    return Seam_hiding::view(axis);
  default:
    return std::nullopt;
  }
}

internal::Stage_names stages_of(const atlas_options& options)
{
  const auto name = [](const char* text) { return std::string(text ? text : ""); };
  return {name(options.segmentation), name(options.parameterizer), name(options.solver),
          name(options.pins),         name(options.optimizer),     name(options.packer)};
}

bindings::Scene_options scene_options(const atlas_options& options)
{
  bindings::Scene_options result;
  result.page = page_of(options);
  result.mode = value_of<Atlas_mode>(options.mode, ATLAS_MODE_PAPER, "mode");
  const int measure = value_of<int>(options.measure, ATLAS_MEASURE_QUASI_CONFORMAL, "measure");
  if (measure != ATLAS_MEASURE_OF_MODE)
    result.measure = static_cast<Distortion_measure>(measure - 1);
  result.max_distortion = options.max_distortion;
  result.max_stretch = options.max_stretch;
  result.max_stretch_share = options.max_stretch_share;
  result.is_straightened = options.straighten != 0;
  result.max_charts = options.max_charts;
  result.min_chart_texels = options.min_chart_texels;
  result.min_coverage = options.min_coverage;
  if (options.seam_exchange_rate >= 0)
    result.seam_exchange_rate = options.seam_exchange_rate;
  result.min_texels_per_chart = options.min_texels_per_chart;
  result.symmetry = value_of<Symmetry>(options.symmetry, ATLAS_SYMMETRY_Z, "symmetry");
  result.hiding = hiding_of(options);
  result.stages = stages_of(options);
  result.has_only_given_seams = options.only_given_seams != 0;
  result.weld = options.weld;
  result.hard_angle = options.hard_angle;
  result.separates_materials = options.separate_materials != 0;
  result.keeps_uv = options.keep_uvs != 0;
  result.merges_uv = options.defragment != 0;
  result.turns_faces = options.orient != 0;
  result.effort = value_of<Packing_effort>(options.effort, ATLAS_EFFORT_BEST, "effort");
  result.threads = options.threads;
  result.time_limit = options.time_limit;
  internal::require(options.rules || options.number_of_rules == 0, "rules", "is a null pointer");
  for (const atlas_material_rule& rule : std::span(options.rules, options.number_of_rules))
    result.rules_of_materials[rule.material] = {rule.weight, rule.is_grouped != 0, rule.is_locked != 0};
  return result;
}

bindings::Progress progress_of(const atlas_options& options)
{
  if (!options.progress)
    return {};
  return [call = options.progress, user = options.user](Stage stage, double fraction) {
    return call(user, static_cast<int>(stage), fraction) != 0;
  };
}

template <typename Number>
void read_points(const atlas_mesh& mesh, std::vector<Point_3>& points)
{
  const std::size_t stride = mesh.position_stride > 0 ? mesh.position_stride : 3 * sizeof(Number);
  points.reserve(mesh.number_of_vertices);
  for (std::size_t v = 0; v < mesh.number_of_vertices; ++v) {
    Number p[3];
    std::memcpy(p, static_cast<const char*>(mesh.positions) + v * stride, sizeof p);
    points.emplace_back(p[0], p[1], p[2]);
  }
}

std::vector<std::array<Index, 2>> read_edges(const unsigned int* vertices, std::size_t n,
                                             const char* argument)
{
  internal::require(vertices || n == 0, argument, "is a null pointer");
  std::vector<std::array<Index, 2>> edges;
  for (std::size_t i = 0; i < n; ++i)
    edges.push_back({vertices[2 * i], vertices[2 * i + 1]});
  return edges;
}

std::vector<bool> read_flags(const unsigned char* flags, std::size_t n)
{
  std::vector<bool> result;
  for (std::size_t i = 0; i < n; ++i)
    result.push_back(flags[i] != 0);
  return result;
}

/// Coordinates at the corners, of those at corners or at vertices that exist.
void read_uv(const atlas_mesh& mesh, Polygon_soup& soup)
{
  internal::require(!mesh.corner_uvs || !mesh.vertex_uvs, "corner_uvs",
                    "and vertex_uvs cannot both be given");
  if (!mesh.corner_uvs && !mesh.vertex_uvs)
    return;
  for (std::size_t c = 0; c < soup.number_of_corners(); ++c) {
    const std::size_t i =
        mesh.corner_uvs ? c : std::min<std::size_t>(soup.vertices[c], mesh.number_of_vertices);
    const float* uv = mesh.corner_uvs ? mesh.corner_uvs : mesh.vertex_uvs;
    if (mesh.vertex_uvs && i == mesh.number_of_vertices)
      return; // refused as an index
    soup.uv.emplace_back(uv[2 * i], uv[2 * i + 1]);
  }
}

bindings::Scene_mesh scene_mesh(const atlas_mesh& mesh)
{
  bindings::Scene_mesh result;
  Polygon_soup& soup = result.soup;
  internal::require(mesh.positions || mesh.number_of_vertices == 0, "positions", "is a null pointer");
  internal::require(mesh.indices || mesh.number_of_faces == 0, "indices", "is a null pointer");
  if (value_of<int>(mesh.position_type, ATLAS_DOUBLE, "position_type") == ATLAS_FLOAT)
    read_points<float>(mesh, soup.points);
  else
    read_points<double>(mesh, soup.points);
  for (std::size_t f = 0; f < mesh.number_of_faces; ++f)
    soup.first.push_back(soup.first.back() + (mesh.face_sizes ? mesh.face_sizes[f] : 3));
  internal::require(soup.first.back() < no_index, "face_sizes",
                    "add up to more corners than 32 bits can count");
  soup.vertices.assign(mesh.indices, mesh.indices + soup.first.back());
  read_uv(mesh, soup);
  if (mesh.face_pages)
    soup.face_page.assign(mesh.face_pages, mesh.face_pages + mesh.number_of_faces);
  if (mesh.face_materials)
    soup.face_material.assign(mesh.face_materials, mesh.face_materials + mesh.number_of_faces);
  if (mesh.selected)
    result.selected = read_flags(mesh.selected, mesh.number_of_faces);
  if (mesh.pinned)
    result.pinned = read_flags(mesh.pinned, soup.number_of_corners());
  if (mesh.visibility)
    result.visibility.assign(mesh.visibility, mesh.visibility + mesh.number_of_vertices);
  result.seams = read_edges(mesh.seams, mesh.number_of_seams, "seams");
  result.forbidden_seams =
      read_edges(mesh.forbidden_seams, mesh.number_of_forbidden_seams, "forbidden_seams");
  return result;
}

int status_of(const bindings::Scene& scene, Atlas_status status)
{
  switch (status) {
  case Atlas_status::valid:
    return ATLAS_OK;
  case Atlas_status::not_valid:
    return ATLAS_NOT_VALID;
  case Atlas_status::no_surface:
    return ATLAS_NO_SURFACE;
  case Atlas_status::no_room:
    return ATLAS_NO_ROOM;
  case Atlas_status::cancelled:
    return scene.is_out_of_time() ? ATLAS_OUT_OF_TIME : ATLAS_CANCELLED;
  case Atlas_status::vertices_split: // soups have coordinates of corners
    break;
  }
  return ATLAS_FAILED;
}

/// Calls `work` with options as the library has them, and keeps the report.
template <typename Work>
int run(atlas_scene* scene, const atlas_options* options, Work work) noexcept
{
  return guarded(scene, [&] {
    scene->report = "null";
    const atlas_options known = options ? as_known(options, default_options(), "options") : default_options();
    const int status = status_of(scene->scene, work(scene_options(known), progress_of(known)));
    const Json& report = scene->scene.report();
    scene->report = json_text(report);
    if (status == ATLAS_NOT_VALID)
      scene->error = (report.contains("certificate") ? report["certificate"] : report)["message"];
    return status;
  });
}

} // namespace

const char* atlas_version(void)
{
  return ATLAS_VERSION;
}

const char* atlas_message(int status)
{
  switch (status) {
  case ATLAS_OK:
    return message(Atlas_status::valid);
  case ATLAS_NOT_VALID:
    return message(Atlas_status::not_valid);
  case ATLAS_NO_SURFACE:
    return message(Atlas_status::no_surface);
  case ATLAS_NO_ROOM:
    return message(Atlas_status::no_room);
  case ATLAS_CANCELLED:
    return message(Atlas_status::cancelled);
  case ATLAS_OUT_OF_TIME:
    return "not finished within the time limit";
  case ATLAS_INVALID_ARGUMENT:
    return "an argument cannot be";
  case ATLAS_OUT_OF_MEMORY:
    return "not enough memory";
  case ATLAS_FAILED:
    return "internal error";
  default:
    return "unknown status";
  }
}

const char* atlas_stage_name(int stage)
{
  return name(static_cast<Stage>(stage));
}

atlas_scene* atlas_create(void)
{
  try {
    return new atlas_scene;
  } catch (...) {
    return nullptr;
  }
}

void atlas_destroy(atlas_scene* scene)
{
  delete scene;
}

const char* atlas_error(const atlas_scene* scene)
{
  return scene ? scene->error.c_str() : "the scene is a null pointer";
}

int atlas_init_options(atlas_options* options, size_t size)
{
  if (!options || size < sizeof(std::size_t) || size > sizeof(atlas_options))
    return ATLAS_INVALID_ARGUMENT;
  atlas_options known = default_options();
  known.size = size;
  std::memcpy(options, &known, size);
  return ATLAS_OK;
}

int atlas_init(void* object, size_t size)
{
  if (!object || size < sizeof size)
    return ATLAS_INVALID_ARGUMENT;
  std::memset(object, 0, size);
  std::memcpy(object, &size, sizeof size);
  return ATLAS_OK;
}

int atlas_add_mesh(atlas_scene* scene, const atlas_mesh* mesh)
{
  return guarded(scene, [&] {
    scene->scene.add(scene_mesh(as_known(mesh, atlas_mesh{}, "mesh")));
    return ATLAS_OK;
  });
}

size_t atlas_number_of_meshes(const atlas_scene* scene)
{
  return scene ? scene->scene.size() : 0;
}

int atlas_generate(atlas_scene* scene, const atlas_options* options)
{
  return run(scene, options, [&](const auto& wishes, const auto& progress) {
    return scene->scene.generate(wishes, progress);
  });
}

int atlas_pack(atlas_scene* scene, const atlas_options* options)
{
  return run(scene, options,
             [&](const auto& wishes, const auto& progress) { return scene->scene.pack(wishes, progress); });
}

int atlas_verify(atlas_scene* scene, const atlas_options* options)
{
  atlas_options any_distance = default_options();
  any_distance.gutter = 0;
  return run(scene, options ? options : &any_distance, [&](const auto& wishes, const auto&) {
    return scene->scene.verify(wishes, Uv_precision::single_precision);
  });
}

const char* atlas_report(const atlas_scene* scene)
{
  return scene ? scene->report.c_str() : "null";
}

int atlas_get_summary(atlas_scene* scene, atlas_summary* summary)
{
  return guarded(scene, [&] {
    const bindings::Scene_summary& s = scene->scene.summary();
    give(atlas_summary{0, s.charts, s.pages, s.width, s.height, s.density, s.efficiency}, summary);
    return ATLAS_OK;
  });
}

int atlas_get_result(atlas_scene* scene, size_t mesh, atlas_result* result)
{
  return guarded(scene, [&] {
    const std::vector<bindings::Mesh_result>& results = *scene->scene.results();
    if (mesh >= scene->scene.size())
      throw Invalid_argument("mesh", std::to_string(mesh) + " is out of range: there are " +
                                         std::to_string(scene->scene.size()) + " meshes");
    internal::require(mesh < results.size(), "the scene", "has no coordinates yet");
    const bindings::Mesh_result& r = results[mesh];
    give(atlas_result{0, r.face_charts.size(), r.indices.size(), r.corner_uvs.data(), r.face_charts.data(),
                      r.face_pages.data(), r.vmapping.size(), r.vmapping.data(), r.uvs.data(),
                      r.indices.data(), r.face_of_triangle.size(), r.triangles.data(),
                      r.face_of_triangle.data()},
         result);
    return ATLAS_OK;
  });
}
