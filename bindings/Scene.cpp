// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/soup/internal/split_vertices.h>
#include <Atlas/soup/internal/weld_points.h>
#include <Atlas/soup/orient_faces.h>
#include <Atlas/validation/certify.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace Atlas::bindings {

namespace {

void require_size(std::size_t size, std::size_t expected, const char* argument, const char* unit)
{
  if (size != 0 && size != expected)
    throw Invalid_argument(argument, "must have an entry for each of the " + std::to_string(expected) + ' ' +
                                         unit + ", but have " + std::to_string(size));
}

void require_vertices(const Polygon_soup& soup, std::span<const Index> vertices, const char* argument)
{
  for (const Index v : vertices)
    if (v >= soup.points.size())
      throw Invalid_argument(argument, "name vertex " + std::to_string(v) +
                                           ", which is out of range: there are " +
                                           std::to_string(soup.points.size()) + " vertices");
}

void check(const Scene_mesh& mesh)
{
  const Polygon_soup& soup = mesh.soup;
  require_vertices(soup, soup.vertices, "indices");
  for (const auto& edge : mesh.seams)
    require_vertices(soup, edge, "seams");
  for (const auto& edge : mesh.forbidden_seams)
    require_vertices(soup, edge, "forbidden_seams");
  require_size(soup.uv.size(), soup.number_of_corners(), "uvs", "corners");
  require_size(soup.colors.size(), soup.points.size(), "colors", "vertices");
  require_size(soup.face_material.size(), soup.number_of_faces(), "materials", "faces");
  require_size(soup.face_page.size(), soup.number_of_faces(), "pages", "faces");
  require_size(mesh.selected.size(), soup.number_of_faces(), "selected", "faces");
  require_size(mesh.pinned.size(), soup.number_of_corners(), "pinned", "corners");
  require_size(mesh.visibility.size(), soup.points.size(), "visibility", "vertices");
  internal::require(std::all_of(mesh.visibility.begin(), mesh.visibility.end(),
                                [](double seen) { return seen >= 0 && seen <= 1; }),
                    "visibility", "must be in [0, 1] everywhere");
}

/// Gives edges, named by their vertices, a constraint.
void constrain(Surface& surface, std::vector<std::array<Index, 2>> edges, Edge_constraint constraint)
{
  if (edges.empty())
    return;
  for (auto& [a, b] : edges)
    if (a > b)
      std::swap(a, b);
  std::sort(edges.begin(), edges.end());
  surface.constraint.resize(surface.opposite.size(), Edge_constraint::none);
  const auto vertex = [&](Index h) { return surface.triangles[h / 3][h % 3]; };
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index a = vertex(h), b = vertex(next_halfedge(h)), o = surface.opposite[h];
    if (o != no_index && !surface.is_diagonal(h) &&
        std::binary_search(edges.begin(), edges.end(), std::array{std::min(a, b), std::max(a, b)}))
      surface.constraint[h] = surface.constraint[o] = constraint;
  }
}

/// The vertices of a mesh, near ones at one place.
std::vector<Point_3> welded(std::vector<Point_3> points, double tolerance)
{
  if (tolerance > 0)
    internal::weld_points(points, tolerance);
  return points;
}

Surface surface_of(const Scene_mesh& mesh, std::vector<Point_3> points)
{
  Surface surface = build_surface(std::move(points), mesh.soup.first, mesh.soup.vertices);
  constrain(surface, mesh.forbidden_seams, Edge_constraint::no_seam);
  constrain(surface, mesh.seams, Edge_constraint::seam);
  return surface;
}

std::vector<float> floats(const std::vector<Point_2>& points)
{
  std::vector<float> result;
  result.reserve(2 * points.size());
  for (const Point_2& p : points) {
    result.push_back(static_cast<float>(p.x()));
    result.push_back(static_cast<float>(p.y()));
  }
  return result;
}

/// What the certificate of a scene is asked for.
Certificate_options certificate_options(const Page_options& page, double gutter, Uv_precision precision)
{
  Certificate_options options;
  options.width = page.width;
  options.height = page.height;
  options.gutter = gutter;
  options.precision = precision;
  return options;
}

Json to_json(const Repacked_charts& repacked, const Scene_summary& summary)
{
  return {{"is_valid", summary.status == Atlas_status::valid},
          {"message", message(summary.status)},
          {"pages", summary.pages},
          {"page_width", summary.width},
          {"page_height", summary.height},
          {"gutter_texels", repacked.packing.gutter},
          {"number_of_charts", summary.charts},
          {"packing_efficiency", summary.efficiency},
          {"texels_per_unit", summary.density}};
}

} // namespace

void Scene::add(Scene_mesh mesh)
{
  check(mesh);
  for (Index& m : mesh.soup.face_material)
    if (m != no_index)
      m = material_.try_emplace(m, static_cast<Index>(material_.size())).first->second;
  meshes_.push_back(std::move(mesh));
  turned_faces_.emplace_back();
}

Atlas_status Scene::generate(const Scene_options& options, const Progress& progress)
{
  Input input;
  start(options, input);
  internal::Soup_options wishes = by_our_numbers(options);
  wishes.selection = joined(&Scene_mesh::selected, &Polygon_soup::number_of_faces, true);
  wishes.pins = joined(&Scene_mesh::pinned, &Polygon_soup::number_of_corners, false);
  if (options.keeps_uv || options.merges_uv || wishes.selection || wishes.pins)
    require_uv();
  hide_seams_of(input.surface, options);
  std::vector<Point_2> uv;
  const Atlas_report report =
      atlas_of_soup(wishes, *input.soup, input.surface, uv, within_time(options, progress));
  report_ = Atlas::to_json(report);
  summary_ = {report.status,  report.charts.size(),     report.pages, report.page_width, report.page_height,
              report.density, report.packing_efficiency};
  if (!uv.empty() && (report.status == Atlas_status::valid || report.status == Atlas_status::not_valid))
    keep(input, uv, report.face_chart, report.face_page);
  return report.status;
}

Atlas_status Scene::pack(const Scene_options& options, const Progress& progress)
{
  Input input;
  require_uv();
  start(options, input);
  const Progress in_time = within_time(options, progress);
  const Execution execution(options.threads,
                            [&](double fraction) { return in_time(Stage::packing, fraction); });
  const Repacked_charts repacked =
      repack_soup(by_our_numbers(options), *input.soup, input.surface, execution);
  summary_.charts = repacked.charts.size();
  summary_.pages = repacked.packing.number_of_pages;
  summary_.width = options.page.width;
  summary_.height = options.page.height;
  summary_.density = repacked.packing.density;
  const bool has_room = repacked.packing.number_of_pages > 0;
  if (execution.is_cancelled())
    summary_.status = Atlas_status::cancelled;
  else if (!has_room)
    summary_.status = repacked.charts.empty() ? Atlas_status::no_surface : Atlas_status::no_room;
  if (execution.is_cancelled() || !has_room) {
    report_ = to_json(repacked, summary_);
    return summary_.status;
  }
  const std::vector<Index> pages = internal::pages_of_faces(repacked, input.surface);
  const Atlas_certificate certificate = certify(
      input.surface, repacked.uv, pages,
      certificate_options(options.page, repacked.packing.gutter, Uv_precision::single_precision), execution);
  summary_.status = certificate.is_valid() ? Atlas_status::valid : Atlas_status::not_valid;
  summary_.efficiency = internal::packing_efficiency(repacked, options.page);
  report_ = to_json(repacked, summary_);
  report_["certificate"] = Atlas::to_json(certificate);
  std::vector<Index> face_chart(input.surface.number_of_faces, no_index);
  for (std::size_t t = 0; t < input.surface.number_of_triangles(); ++t)
    face_chart[input.surface.face[t]] = repacked.segmentation.chart[t];
  keep(input, repacked.uv, face_chart, pages);
  return summary_.status;
}

Atlas_status Scene::verify(const Scene_options& options, Uv_precision precision)
{
  Input input;
  require_uv();
  start(options, input);
  std::vector<Index> pages;
  for (const Scene_mesh& mesh : meshes_)
    for (std::size_t f = 0; f < mesh.soup.number_of_faces(); ++f)
      pages.push_back(mesh.soup.page(f));
  const Atlas_certificate certificate =
      certify(input.surface, input.soup->uv, pages,
              certificate_options(options.page, options.page.gutter, precision), Execution(options.threads));
  report_ = Atlas::to_json(certificate);
  summary_ = {certificate.is_valid() ? Atlas_status::valid : Atlas_status::not_valid,
              certificate.charts,
              certificate.pages,
              certificate.width,
              certificate.height,
              0,
              0};
  return summary_.status;
}

Polygon_soup Scene::textured() const
{
  std::vector<Polygon_soup> soups;
  for (const Scene_mesh& mesh : meshes_) {
    soups.push_back(mesh.soup);
    soups.back().face_material.clear();
  }
  Joined_soups joined(std::move(soups));
  Polygon_soup whole = std::move(joined.whole());
  whole.old_uv = std::exchange(whole.uv, {});
  whole.face_page.clear();
  for (const Mesh_result& result : *results_) {
    for (std::size_t i = 0; i < result.corner_uvs.size(); i += 2)
      whole.uv.emplace_back(result.corner_uvs[i], result.corner_uvs[i + 1]);
    whole.face_page.insert(whole.face_page.end(), result.face_pages.begin(), result.face_pages.end());
  }
  return whole;
}

std::vector<Point_3> Scene::welded_points() const
{
  std::vector<Point_3> points;
  for (const Scene_mesh& mesh : meshes_) {
    const std::vector<Point_3> own = welded(mesh.soup.points, weld_);
    points.insert(points.end(), own.begin(), own.end());
  }
  return points;
}

/// Forgets the last call, and makes one surface of all meshes.
void Scene::start(const Scene_options& options, Input& input)
{
  internal::require(!meshes_.empty(), "the scene", "has no meshes yet");
  internal::require(std::isfinite(options.time_limit) && options.time_limit >= 0, "time_limit",
                    "must be finite and not negative");
  internal::require(options.weld >= 0 && options.weld <= 0.1, "weld", "must be in [0, 0.1]");
  results_ = std::make_shared<std::vector<Mesh_result>>();
  summary_ = {};
  report_ = Json();
  weld_ = options.weld;
  is_out_of_time_ = false;
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < size(); ++i) {
    std::vector<Point_3> points = welded(meshes_[i].soup.points, options.weld);
    if (options.turns_faces)
      turn_faces(i, points);
    surfaces.push_back(surface_of(meshes_[i], std::move(points)));
    input.first_triangle.push_back(input.first_triangle.back() + surfaces.back().number_of_triangles());
  }
  input.surface = size() == 1 ? std::move(surfaces.front()) : join_surfaces(surfaces);
  input.soup = &meshes_.front().soup;
  if (size() > 1)
    join_attributes(input);
}

/// Turns faces of a mesh around, so that neighbours agree. Neighbours are those that have been welded.
void Scene::turn_faces(std::size_t mesh, std::vector<Point_3>& welded_points)
{
  Polygon_soup& soup = meshes_[mesh].soup;
  std::vector<Index>& all = turned_faces_[mesh];
  std::swap(soup.points, welded_points);
  const std::vector<Index> now = orient_faces(soup);
  std::swap(soup.points, welded_points);
  std::vector<Index> turned;
  std::set_symmetric_difference(all.begin(), all.end(), now.begin(), now.end(), std::back_inserter(turned));
  all = std::move(turned);
}

/// Makes seams cheap where they are hardly seen. Meshes that do not say how they are seen are seen
/// everywhere.
void Scene::hide_seams_of(Surface& surface, const Scene_options& options) const
{
  const auto has_map = [](const Scene_mesh& mesh) { return !mesh.visibility.empty(); };
  if (std::any_of(meshes_.begin(), meshes_.end(), has_map)) {
    std::vector<double> visibility;
    for (const Scene_mesh& mesh : meshes_) {
      visibility.insert(visibility.end(), mesh.visibility.begin(), mesh.visibility.end());
      visibility.resize(visibility.size() + (has_map(mesh) ? 0 : mesh.soup.points.size()), 1);
    }
    hide_seams(surface, visibility);
  }
  if (options.hiding)
    hide_seams(surface, *options.hiding, Execution(options.threads));
}

/// A list of all meshes, one after the other, if any mesh has it.
/// \param count  of entries of a mesh that has none, which gets `missing` everywhere
std::optional<std::vector<bool>> Scene::joined(std::vector<bool> Scene_mesh::*list,
                                               std::size_t (Polygon_soup::*count)() const, bool missing) const
{
  if (std::all_of(meshes_.begin(), meshes_.end(), [&](const auto& mesh) { return (mesh.*list).empty(); }))
    return std::nullopt;
  std::vector<bool> result;
  for (const Scene_mesh& mesh : meshes_) {
    const std::vector<bool>& own = mesh.*list;
    result.insert(result.end(), own.begin(), own.end());
    result.resize(result.size() + (own.empty() ? (mesh.soup.*count)() : 0), missing);
  }
  return result;
}

/// Coordinates, materials and pages of all meshes, where any has them.
void Scene::join_attributes(Input& input) const
{
  const auto has = [&](auto list) {
    return std::any_of(meshes_.begin(), meshes_.end(),
                       [&](const auto& mesh) { return !(mesh.soup.*list).empty(); });
  };
  const bool has_uv = has(&Polygon_soup::uv), has_materials = has(&Polygon_soup::face_material),
             has_pages = has(&Polygon_soup::face_page);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::size_t corners = 0, faces = 0;
  for (const Scene_mesh& mesh : meshes_) {
    const Polygon_soup& soup = mesh.soup;
    input.joined.uv.insert(input.joined.uv.end(), soup.uv.begin(), soup.uv.end());
    input.joined.face_material.insert(input.joined.face_material.end(), soup.face_material.begin(),
                                      soup.face_material.end());
    input.joined.face_page.insert(input.joined.face_page.end(), soup.face_page.begin(), soup.face_page.end());
    corners += soup.number_of_corners();
    faces += soup.number_of_faces();
    if (has_uv)
      input.joined.uv.resize(corners, Point_2(nan, nan));
    if (has_materials)
      input.joined.face_material.resize(faces, no_index);
    if (has_pages)
      input.joined.face_page.resize(faces, 0);
  }
  input.soup = &input.joined;
}

internal::Soup_options Scene::by_our_numbers(const Scene_options& options) const
{
  internal::Soup_options result = options;
  if (options.rules_of_materials.empty())
    return result;
  result.rules.resize(material_.size());
  for (const auto& [material, rule] : options.rules_of_materials) {
    const auto at = material_.find(material);
    if (at == material_.end())
      throw Invalid_argument("material", std::to_string(material) + " has a rule, but no face is of it");
    if (!(rule.weight > 0 && std::isfinite(rule.weight)))
      throw Invalid_argument("weight",
                             "of material " + std::to_string(material) + " must be positive and finite");
    internal::require(!rule.is_locked || options.page.width == options.page.height, "lock",
                      "needs square pages");
    result.rules[at->second] = rule;
  }
  return result;
}

/// The listener, who is patient for a while.
Progress Scene::within_time(const Scene_options& options, const Progress& progress)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  return [this, begin, limit = options.time_limit, progress](Stage stage, double fraction) {
    if (limit > 0 && std::chrono::duration<double>(Clock::now() - begin).count() > limit)
      is_out_of_time_ = true;
    return !is_out_of_time_ && (!progress || progress(stage, fraction));
  };
}

void Scene::require_uv() const
{
  const bool has_uv =
      std::any_of(meshes_.begin(), meshes_.end(), [](const auto& mesh) { return !mesh.soup.uv.empty(); });
  internal::require(has_uv, "uvs", "are needed: no mesh of the scene has any");
}

/// Makes the results of all meshes.
void Scene::keep(const Input& input, const std::vector<Point_2>& uv, const std::vector<Index>& face_chart,
                 const std::vector<Index>& face_page)
{
  const auto part = [](const auto& list, std::size_t begin, std::size_t n) {
    const auto at = list.begin() + static_cast<std::ptrdiff_t>(begin);
    return std::remove_cvref_t<decltype(list)>(at, at + static_cast<std::ptrdiff_t>(n));
  };
  std::size_t corner = 0, face = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    Polygon_soup& soup = meshes_[i].soup;
    Mesh_result& result = results_->emplace_back();
    std::vector<Point_2> own_uv = part(uv, corner, soup.number_of_corners());
    result.corner_uvs = floats(own_uv);
    result.face_charts = part(face_chart, face, soup.number_of_faces());
    result.face_pages = part(face_page, face, soup.number_of_faces());
    // Normals are given per vertex and split nothing.
    std::vector<Index> normals = std::exchange(soup.corner_normal, {});
    own_uv.swap(soup.uv);
    internal::Split_vertices split = internal::split_vertices(soup);
    own_uv.swap(soup.uv);
    soup.corner_normal = std::move(normals);
    result.uvs = floats(split.uv);
    result.vmapping = std::move(split.original);
    result.indices = std::move(split.corner);
    for (std::size_t t = input.first_triangle[i]; t < input.first_triangle[i + 1]; ++t) {
      result.face_of_triangle.push_back(static_cast<Index>(input.surface.face[t] - face));
      for (std::size_t k = 0; k < 3; ++k)
        result.triangles.push_back(result.indices[input.surface.corner[3 * t + k] - corner]);
    }
    result.turned_faces = turned_faces_[i];
    corner += soup.number_of_corners();
    face += soup.number_of_faces();
  }
}

} // namespace Atlas::bindings
