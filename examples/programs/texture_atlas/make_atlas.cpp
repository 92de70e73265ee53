// SPDX-License-Identifier: MIT
// The call of the library.
#include <Atlas/core/errors.h>
#include <Atlas/image/pages.h>
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

/// The model with coordinates and pages of the faces that are to stay as the library wants them: tiles are
/// pages. \throw Atlas::IO_error if one goes beyond its tile
Atlas::Polygon_soup with_kept_places(const Atlas::Polygon_soup& model, const std::vector<bool>& is_unwrapped)
{
  constexpr double slack = 1e-6; // of rounding
  Atlas::Polygon_soup result = model;
  if (result.face_page.empty())
    Atlas::separate_udim(result);
  for (std::size_t f = 0; f < result.number_of_faces(); ++f)
    for (std::size_t c = result.first[f]; c < result.first[f + 1] && !is_unwrapped[f]; ++c) {
      const Atlas::Point_2& p = result.uv[c];
      const Atlas::Point_2 inside(std::clamp(p.x(), 0., 1.), std::clamp(p.y(), 0., 1.));
      if (std::max(std::abs(p.x() - inside.x()), std::abs(p.y() - inside.y())) > slack)
        throw Atlas::IO_error("face " + std::to_string(f + 1) +
                              " is to stay, but lies outside of the tiles 1001 to 9999, or goes beyond its "
                              "tile: unwrap it too, or move it there");
      if (std::isfinite(inside.x() + inside.y()))
        result.uv[c] = inside;
    }
  return result;
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
  if (options.only.empty())
    return atlas_of_soup(wishes, model, surface, uv, progress);
  wishes.selection = faces_to_unwrap(options, model);
  return atlas_of_soup(wishes, with_kept_places(model, *wishes.selection), surface, uv, progress);
}
