// SPDX-License-Identifier: MIT
// What the program says of its result.
#include <Atlas/core/build_surface.h>
#include <Atlas/image/pages.h>
#include <Atlas/soup/internal/weld_points.h>
#include <Atlas/soup/orient_faces.h>

#include "texture_atlas.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

void print_table(const Options& options, const Atlas::Polygon_soup& model, const Atlas::Atlas_report& report)
{
  const Atlas::Distortion& d = report.distortion;
  const Atlas::Atlas_certificate& c = report.certificate;
  std::printf("mesh          %s: %zu vertices, %zu faces\n", options.title().c_str(), model.points.size(),
              report.faces);
  std::printf("charts        %zu on %zu page%s of %u x %u texels", report.charts.size(), report.pages,
              report.pages == 1 ? "" : "s", report.page_width, report.page_height);
  if (report.pieces_cut_for_pages > 0)
    std::printf(", %zu of them as charts were cut for the page", report.pieces_cut_for_pages);
  if (report.stacked_charts > 0)
    std::printf(", %zu of them on copies of theirs", report.stacked_charts);
  std::printf(
      "\ndistortion    stretch L2 %.3f, Linf %.2f; angles %.3f (1 is conformal); areas %.3f (1 is equal)\n",
      d.l2_stretch, d.linf_stretch, d.quasi_conformal_mean, d.area_mean);
  std::printf("packing       %.1f %% of the page covered, %.4g texels per unit",
              100 * report.packing_efficiency, report.density);
  if (report.charts.size() > 1)
    std::printf(", charts %.2f texels apart", c.chart_distance);
  std::printf(
      "\nverdict       %s: %zu flipped, %zu flat, %zu overlapping, %zu of %zu faces without a shape\n",
      report.is_valid() ? "valid" : "NOT VALID", c.flipped, c.degenerate,
      c.overlaps_in_charts + c.overlaps_between_charts, report.rejected.size(), report.faces);
}

void print_times(const Atlas::Atlas_report& report, double reading, double writing)
{
  std::printf("time          reading %.2f s", reading);
  for (const Atlas::Stage stage : Atlas::all_stages)
    std::printf(", %s %.2f s", Atlas::name(stage), report.seconds[static_cast<std::size_t>(stage)]);
  std::printf(", textures and writing %.2f s\n", writing);
}

void print_rejected(const Options& options, const Atlas::Joined_soups& models,
                    const Atlas::Atlas_report& report)
{
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < std::min(report.rejected.size(), shown); ++i) {
    const std::size_t face = report.rejected[i].face;
    std::size_t mesh = models.number_of_parts() - 1;
    while (models.first_face(mesh) > face)
      --mesh;
    std::fprintf(stderr, "texture_atlas: %s%sface %zu (counting from 0) takes no part: %s\n",
                 models.number_of_parts() > 1 ? options.meshes[mesh].c_str() : "",
                 models.number_of_parts() > 1 ? ": " : "", face - models.first_face(mesh),
                 message(report.rejected[i].reason));
  }
  if (report.rejected.size() > shown)
    std::fprintf(stderr, "texture_atlas: and %zu more faces%s\n", report.rejected.size() - shown,
                 report.status == Atlas::Atlas_status::no_surface ? "" : "; the report lists them");
}

namespace {

/// How many faces of locked materials, or of those that are not unwrapped, are not where they were.
std::size_t moved_locked_faces(const Options& options, const Atlas::Polygon_soup& model)
{
  constexpr double tolerance = 1e-5;
  const std::vector<Material_rule> rules = rules_of(options.materials, model);
  const std::vector<bool> is_unwrapped = faces_to_unwrap(options, model);
  const std::vector<Atlas::Point_2> uv = Atlas::udim_uv(model);
  std::size_t count = 0;
  for (std::size_t f = 0; f < model.face_material.size(); ++f) {
    bool is_moved = false;
    for (std::size_t c = model.first[f]; c < model.first[f + 1]; ++c)
      is_moved = is_moved || !(std::abs(uv[c].x() - model.old_uv[c].x()) <= tolerance &&
                               std::abs(uv[c].y() - model.old_uv[c].y()) <= tolerance);
    const Atlas::Index material = model.face_material[f];
    const bool is_locked = !rules.empty() && material != Atlas::no_index && rules[material].is_locked;
    count += is_moved && (options.only.empty() ? is_locked : !is_unwrapped[f]);
  }
  return count;
}

} // namespace

void print_unfulfilled(const Options& options, const Atlas::Polygon_soup& model,
                       const Atlas::Atlas_report& report)
{
  if (!options.materials.locked.empty() || !options.only.empty())
    if (const std::size_t moved = moved_locked_faces(options, model))
      std::fprintf(stderr, "texture_atlas: %zu faces that are to stay have no %s and got another\n", moved,
                   options.only.empty() ? "usable place in the file (no coordinates, face down, or folded)"
                                        : "place in the file");
  tell_lower_density("texture_atlas", options, report.density);
  if (report.added_seams > 0)
    std::fprintf(
        stderr,
        "texture_atlas: %zu edges are seams besides those given: charts would not be discs, or cover "
        "themselves, without\n",
        report.added_seams);
  for (const auto& [chart, fault, corners] : report.moved_pins)
    std::fprintf(stderr, "texture_atlas: %zu pinned corners of chart %u could not stay: %s\n", corners.size(),
                 chart, message(fault));
  if (options.keeps_document() && report.pages > 1)
    std::fprintf(stderr,
                 "texture_atlas: of the glTF document only the triangles of its scene and the names of "
                 "materials are kept, since there are several pages\n");
  if (options.max_charts > 0 && report.charts.size() > options.max_charts)
    std::fprintf(stderr, "texture_atlas: fewer than %zu charts would not be discs without overlap\n",
                 report.charts.size());
}

void print_beyond_bound(const Atlas::Atlas_report& report)
{
  struct Group
  {
    std::size_t charts = 0;
    double area = 0;
  };
  std::map<Atlas::Excess_reason, Group> groups;
  for (const Atlas::Chart_report& chart : report.charts)
    if (!chart.is_within_bound) {
      ++groups[chart.reason].charts;
      groups[chart.reason].area += chart.area;
    }
  for (const auto& [reason, group] : groups)
    std::fprintf(
        stderr, "texture_atlas: %zu of %zu charts (%.2g %% of the area) exceed the bound on distortion: %s\n",
        group.charts, report.charts.size(), 100 * group.area / report.area, message(reason));
}

namespace {

/// Fewer charts need no explanation.
constexpr std::size_t many_charts = 20;

std::ptrdiff_t open_halfedges(const Atlas::Surface& surface)
{
  return std::count(surface.opposite.begin(), surface.opposite.end(), Atlas::no_index);
}

} // namespace

void print_unwelded(const Options& options, const Atlas::Polygon_soup& model, const Atlas::Surface& surface,
                    const Atlas::Atlas_report& report)
{
  constexpr double near = 1e-5;
  if (options.weld > 0 || options.meshes.size() > 1 || report.charts.size() < many_charts)
    return;
  const auto before = open_halfedges(surface);
  std::vector<Atlas::Point_3> points = model.points;
  if (before == 0 || Atlas::internal::weld_points(points, near) == 0)
    return;
  const auto after = open_halfedges(Atlas::build_surface(std::move(points), model.first, model.vertices));
  if (2 * after < before)
    std::fprintf(
        stderr,
        "texture_atlas: %td of %td open edges hardly miss another one, and no chart runs over these; "
        "--weld %g takes vertices so near to each other for one\n",
        before - after, before, near);
}

void print_disagreement(const Options& options, const Atlas::Polygon_soup& model,
                        const Atlas::Atlas_report& report)
{
  if (options.turns_faces || report.charts.size() < many_charts)
    return;
  if (const std::size_t edges = Atlas::disagreeing_edges(model))
    std::fprintf(
        stderr,
        "texture_atlas: at %zu edges two faces disagree which side is outside, and no chart runs over "
        "these; --orient turns faces\n",
        edges);
}
