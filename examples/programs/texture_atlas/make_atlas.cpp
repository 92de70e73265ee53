// SPDX-License-Identifier: MIT
// The call of the library.
#include <Atlas/core/build_surface.h>
#include <Atlas/soup/internal/atlas_of_soup.h>

#include "texture_atlas.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

namespace {

Atlas::Atlas_mode mode_of(const std::string& name)
{
  using enum Atlas::Atlas_mode;
  return name == "few-seams"   ? few_seams
         : name == "conformal" ? conformal
         : name == "paper"     ? paper
                               : standard;
}

Atlas::Distortion_measure measure_of(const std::string& name)
{
  using enum Atlas::Distortion_measure;
  return name == "l2-stretch"             ? l2_stretch
         : name == "linf-stretch"         ? linf_stretch
         : name == "area-ratio"           ? area_ratio
         : name == "area-ratio-quantiles" ? area_ratio_quantiles
         : name == "quasi-conformal"      ? quasi_conformal
                                          : symmetric_dirichlet;
}

/// A part of a model, and where it is in it.
struct Part
{
  Atlas::Polygon_soup soup;
  std::vector<std::size_t> faces; ///< of the model
};

Part part_of(const Atlas::Polygon_soup& model, const std::vector<bool>& is_wanted)
{
  Part part;
  part.soup.points = model.points;
  for (std::size_t f = 0; f < model.number_of_faces(); ++f)
    if (is_wanted[f]) {
      const auto face = model.face(f);
      part.soup.vertices.insert(part.soup.vertices.end(), face.begin(), face.end());
      part.soup.close_face();
      part.faces.push_back(f);
    }
  return part;
}

/// The model with new coordinates for a part, away from the others, and a material for each of the two.
Atlas::Polygon_soup with_part(const Atlas::Polygon_soup& model, const Part& part,
                              const std::vector<Atlas::Point_2>& uv, const std::vector<Atlas::Index>& page)
{
  Atlas::Polygon_soup result;
  result.points = model.points;
  result.first = model.first;
  result.vertices = model.vertices;
  result.uv = model.uv;
  double right = 0; // of all that is there
  for (const Atlas::Point_2& p : model.uv)
    right = std::isfinite(p.x()) ? std::max(right, std::ceil(p.x())) : right;
  result.material_names = {"rest", "part"};
  result.face_material.assign(model.number_of_faces(), 0);
  for (std::size_t i = 0; i < part.faces.size(); ++i) {
    const std::size_t f = part.faces[i];
    result.face_material[f] = 1;
    for (std::size_t k = 0; k < model.face(f).size(); ++k) {
      const Atlas::Point_2& p = uv[part.soup.first[i] + k];
      result.uv[model.first[f] + k] = Atlas::Point_2(p.x() + right + 1 + 2 * page[i], p.y());
    }
  }
  return result;
}

/// Unwraps some faces, and packs their charts around those of all others, which stay where they are.
Atlas::Atlas_report remake_part(const Atlas::internal::Soup_options& wishes, const Atlas::Polygon_soup& model,
                                const std::vector<bool>& is_wanted, Atlas::Surface& surface,
                                std::vector<Atlas::Point_2>& uv,
                                const std::function<bool(Atlas::Stage, double)>& progress)
{
  const Part part = part_of(model, is_wanted);
  Atlas::Surface surface_of_part =
      Atlas::build_surface(surface.points, part.soup.first, part.soup.vertices); // as they are welded
  std::vector<Atlas::Point_2> uv_of_part;
  Atlas::Atlas_report report = atlas_of_soup(wishes, part.soup, surface_of_part, uv_of_part, progress);
  if (uv_of_part.empty())
    return report;
  Atlas::internal::Soup_options kept = wishes;
  kept.keeps_uv = true;
  kept.seam_exchange_rate = 0;
  kept.rules.resize(2);
  kept.rules[0].is_locked = true;
  const Atlas::Polygon_soup whole = with_part(model, part, uv_of_part, report.face_page);
  return atlas_of_soup(kept, whole, surface, uv, progress);
}

} // namespace

std::vector<bool> faces_to_unwrap(const Options& options, const Atlas::Polygon_soup& model)
{
  std::vector<bool> is_wanted(model.material_names.size()), result;
  for (const std::string& name : options.only) {
    const auto& names = model.material_names;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      throw CLI::ValidationError("--only", "there is no material called '" + name + "' in what was read");
    is_wanted[static_cast<std::size_t>(at - names.begin())] = true;
  }
  for (std::size_t f = 0; f < model.number_of_faces(); ++f) {
    const Atlas::Index material = Atlas::internal::material_of(model, static_cast<Atlas::Index>(f));
    result.push_back(options.only.empty() || (material != Atlas::no_index && is_wanted[material]));
  }
  return result;
}

Atlas::Atlas_report make_atlas(const Options& options, const Atlas::Polygon_soup& model,
                               Atlas::Surface& surface, std::vector<Atlas::Point_2>& uv,
                               const std::function<bool(Atlas::Stage, double)>& progress)
{
  Atlas::internal::Soup_options wishes;
  wishes.mode = mode_of(options.mode);
  if (!options.measure.empty())
    wishes.measure = measure_of(options.measure);
  wishes.page = options.page;
  wishes.max_distortion = options.max_distortion;
  wishes.max_stretch = options.max_stretch;
  wishes.max_stretch_share = options.max_stretch_share;
  wishes.is_straightened = options.is_straightened;
  wishes.max_charts = options.max_charts;
  wishes.min_chart_texels = options.min_chart_texels;
  wishes.symmetry = options.symmetry;
  wishes.hard_angle = options.hard_angle;
  wishes.keeps_uv = options.keeps_uv;
  wishes.merges_uv = options.merges_uv;
  wishes.has_only_given_seams = options.has_only_given_seams;
  wishes.separates_materials = options.separates_materials;
  wishes.policies =
      policies_of(options.stages, wishes.mode, merge_options_of(wishes), wishes.symmetry, options.effort);
  wishes.rules = rules_of(options.materials, model);
  wishes.min_coverage = options.min_coverage;
  wishes.seam_exchange_rate = options.seam_exchange_rate;
  if (!wishes.seam_exchange_rate && !options.stages.segmentation.empty())
    wishes.seam_exchange_rate = 0; // who chooses how charts are made gets them as they are
  wishes.min_texels_per_chart = options.min_texels_per_chart;
  wishes.threads = options.threads;
  if (!options.seams.empty() && !options.keeps_uv)
    constrain_seams(options.seams, model, surface);
  if (!options.hiding.empty())
    hide_seams(options, model, surface);
  if (!options.pinned.empty()) {
    Atlas::Polygon_soup pinned = model;
    wishes.pins = pin_vertices(options.pinned, pinned);
    return atlas_of_soup(wishes, pinned, surface, uv, progress);
  }
  return options.only.empty()
             ? atlas_of_soup(wishes, model, surface, uv, progress)
             : remake_part(wishes, model, faces_to_unwrap(options, model), surface, uv, progress);
}
