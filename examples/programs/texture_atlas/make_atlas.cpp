// SPDX-License-Identifier: MIT
// The call of the library.
#include <Atlas/soup/internal/atlas_of_soup.h>

#include "texture_atlas.h"

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

} // namespace

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
  return atlas_of_soup(wishes, model, surface, uv, progress);
}
