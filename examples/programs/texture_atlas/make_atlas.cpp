// SPDX-License-Identifier: MIT
// The call of the library.
#include <Atlas/core/build_surface.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/parameterization/Existing_uv_parameterizer.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/validation/Exact_validator.h>

#include "Material_packer.h"
#include "texture_atlas.h"
#include <limits>
#include <map>

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

/// Materials become patches; a face without one is of one more material.
void separate_materials(const Atlas::Polygon_soup& model, Atlas::Surface& surface)
{
  surface.patch.resize(surface.number_of_triangles());
  for (std::size_t t = 0; t < surface.patch.size(); ++t)
    surface.patch[t] = model.face_material.empty() ? 0 : model.face_material[surface.face[t]] + 1;
}

/// Faces of the same weight become patches: no chart has faces of two weights.
void separate_weights(Atlas::Surface& surface)
{
  std::map<double, Atlas::Index> patch_of_weight;
  for (const double weight : surface.density_weight) {
    const auto next = static_cast<Atlas::Index>(patch_of_weight.size());
    surface.patch.push_back(patch_of_weight.try_emplace(weight, next).first->second);
  }
}

} // namespace

Atlas::Atlas_report make_atlas(const Options& options, const Atlas::Polygon_soup& model,
                               Atlas::Surface& surface, std::vector<Atlas::Point_2>& uv,
                               const std::function<bool(Atlas::Stage, double)>& progress)
{
  const Atlas::Atlas_mode mode = mode_of(options.mode);
  Atlas::Merge_options merge = Atlas::merge_options(mode);
  if (options.max_distortion > 0)
    merge.max_distortion = options.max_distortion;
  if (options.max_stretch > 0)
    merge.max_stretch = options.max_stretch;
  if (options.max_stretch_share > 0)
    merge.max_stretch_share = options.max_stretch_share;
  if (!options.measure.empty())
    merge.measure = measure_of(options.measure);
  merge.max_charts = options.max_charts;
  if (options.min_chart_texels > 0)
    merge.min_chart_area = Atlas::area_share_of_texels(options.min_chart_texels, options.page);
  const Atlas::Policies policies = policies_of(options.stages, mode, merge, options.effort);
  const auto common =
      Atlas::parameters::page_options(options.page)
          .packer(Material_packer{surface, model, rules_of(options.materials, model), policies.packer})
          .number_of_threads(options.threads)
          .progress(progress);
  set_weights(options.materials, model, surface);
  if (options.keeps_uv) {
    Atlas::constrain_to_uv(surface, model.uv);
    const Atlas::Exact_validator any_density(std::numeric_limits<double>::infinity(), 0);
    return Atlas::generate_atlas(surface, uv,
                                 common.segmentation(Atlas::Patch_segmentation())
                                     .parameterizer(Atlas::Existing_uv_parameterizer(surface, model.uv))
                                     .validator(any_density));
  }
  if (options.separates_materials)
    separate_materials(model, surface);
  else if (!options.materials.weights.empty())
    separate_weights(surface);
  if (!options.seams.empty())
    constrain_seams(options.seams, model, surface);
  return Atlas::generate_atlas(surface, uv,
                               common.policies(policies)
                                   .mode(mode)
                                   .hard_angle(options.hard_angle)
                                   .straighten(options.is_straightened));
}
