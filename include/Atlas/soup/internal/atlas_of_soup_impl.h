// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_ATLAS_OF_SOUP_IMPL_H
#define ATLAS_SOUP_INTERNAL_ATLAS_OF_SOUP_IMPL_H

#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/generate_atlas.h>
#include <Atlas/parameterization/Existing_uv_parameterizer.h>
#include <Atlas/pipeline/internal/trial_parameterizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Patch_segmentation.h>
#include <Atlas/soup/internal/atlas_of_soup.h>
#include <Atlas/soup/internal/file_charts.h>
#include <Atlas/validation/Exact_validator.h>

#include <boost/property_map/property_map.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace Atlas::internal {

/// Materials become patches; a face without one is of one more material.
inline void separate_materials(const Polygon_soup& model, Surface& surface)
{
  surface.patch.resize(surface.number_of_triangles());
  for (std::size_t t = 0; t < surface.patch.size(); ++t)
    surface.patch[t] = material_of(model, surface.face[t]) + 1;
}

/// Faces of the same weight become patches: no chart has faces of two weights.
inline void separate_weights(Surface& surface)
{
  std::map<double, Index> patch_of_weight;
  for (const double weight : surface.density_weight) {
    const auto next = static_cast<Index>(patch_of_weight.size());
    surface.patch.push_back(patch_of_weight.try_emplace(weight, next).first->second);
  }
}

ATLAS_INLINE Merge_options merge_options_of(const Soup_options& options)
{
  require(std::isfinite(options.min_chart_texels) && options.min_chart_texels >= 0, "min_chart_texels",
          "must be finite and not negative");
  Merge_options merge = merge_options(options.mode);
  if (options.max_distortion != 0)
    merge.max_distortion = options.max_distortion;
  if (options.max_stretch != 0)
    merge.max_stretch = options.max_stretch;
  if (options.max_stretch_share != 0)
    merge.max_stretch_share = options.max_stretch_share;
  merge.measure = options.measure.value_or(merge.measure);
  merge.max_charts = options.max_charts;
  if (options.min_chart_texels > 0)
    merge.min_chart_area = area_share_of_texels(options.min_chart_texels, options.page);
  return merge;
}

/// Refuses wishes for merging where charts are not merged. \param value  of the argument, and a space
inline void require_nothing_to_merge(const Soup_options& options, const char* argument,
                                     const std::string& value)
{
  const bool has_wish = options.measure || options.max_distortion != 0 || options.max_stretch != 0 ||
                        options.max_charts != 0 || options.min_chart_texels != 0 ||
                        options.symmetry != Symmetry::off;
  if (has_wish)
    throw Invalid_argument(argument,
                           value + "merges no charts: measure, max_distortion, max_stretch, max_charts, "
                                   "min_chart_texels and symmetry have no meaning");
}

/// Refuses what has no say where charts are those of the soup's coordinates, merged.
inline void check_merging(const Soup_options& options)
{
  if (!options.merges_uv)
    return;
  require(!options.keeps_uv, "defragment",
          "does not go with keep_uv: charts either merge or keep their shapes");
  require(options.mode != Atlas_mode::paper, "defragment",
          "does not go with the mode paper, which merges no charts");
  require(!options.is_straightened && options.symmetry == Symmetry::off, "defragment",
          "makes charts of those that there are: straighten and symmetry have no meaning");
  const Stage_names& stages = options.stages;
  require(stages.segmentation.empty() && stages.parameterizer.empty() && stages.solver.empty() &&
              stages.pins.empty() && stages.optimizer.empty(),
          "defragment", "makes charts of those that there are: of the stages only the packer has a meaning");
}

/// Refuses stages that cannot be, or that are not asked where charts keep their shapes.
inline void check_stages(const Soup_options& options)
{
  check(options.stages);
  check_merging(options);
  if (!options.stages.segmentation.empty())
    require_nothing_to_merge(options, "segmentation", '\'' + options.stages.segmentation + "' ");
  if (options.has_only_given_seams) {
    require_nothing_to_merge(options, "only_given_seams", "");
    require(options.stages.segmentation.empty() && !options.keeps_uv && !options.merges_uv,
            "only_given_seams", "goes neither with a segmentation nor with charts that there are");
  }
  Stage_names but_packer = options.stages;
  but_packer.packer.clear();
  require(!options.selection || (!options.keeps_uv && !options.merges_uv), "selected",
          "does not go with charts that keep their shapes");
  require(!options.pins || (!options.keeps_uv && !options.merges_uv), "pinned",
          "does not go with charts that keep their shapes");
  require(
      !options.keeps_uv || !but_packer.any(), "keep_uv",
      "keeps charts as they are: segmentation, parameterizer, solver, pins and optimizer have no meaning");
}

/// The policies that are given, or those of the mode with the stages that are named.
inline Policies policies_of(const Soup_options& options)
{
  if (options.policies)
    return *options.policies;
  check_stages(options);
  const bool is_paper = options.mode == Atlas_mode::paper;
  if (is_paper)
    require_nothing_to_merge(options, "mode", "paper ");
  Policies policies = is_paper ? paper_preset(Exact_validator(default_max_area_ratio, 0))
                               : preset(options.mode, merge_options_of(options), options.symmetry);
  set_stages(options.stages, options.mode, options.effort, policies);
  return policies;
}

/// Who wants few, large or mirrored charts, or says how they are made, gets them as they are, unless he says
/// so.
inline std::optional<double> seam_exchange_rate_of(const Soup_options& options)
{
  if (!options.seam_exchange_rate &&
      (options.max_charts > 0 || options.min_chart_texels > 0 || options.symmetry != Symmetry::off ||
       !options.stages.segmentation.empty()))
    return 0;
  return options.seam_exchange_rate;
}

/// The policies that merge the charts of the soup's coordinates, and keep the shapes of all others.
inline Policies merging_policies(Policies policies, const Soup_options& options, const Polygon_soup& model,
                                 const Surface& surface)
{
  Merge_options merge = merge_options_of(options);
  merge.are_borders_smoothed = false; // they are where the file has them
  const File_charts charts(surface, model.uv);
  const Exact_validator any_density(std::numeric_limits<double>::infinity(), 0);
  policies.segmentation = Merged_segmentation(charts, trial_parameterizer(optimize_charts(options.mode)),
                                              Identity_optimizer(), merge);
  policies.parameterizer =
      Unmerged_uv_parameterizer(charts, Existing_uv_parameterizer(surface, model.uv), policies.parameterizer);
  policies.validator = Unmerged_uv_validator(charts, any_density, policies.validator);
  policies.splitter = Unmerging_splitter(charts, policies.splitter);
  return policies;
}

/// What a list has for faces or corners, by their numbers.
template <typename Value>
struct Listed
{
  using key_type = Index;
  using value_type = Value;
  using reference = Value;
  using category = boost::readable_property_map_tag;

  const std::vector<Value>& list;

  friend Value get(const Listed& map, Index i) { return map.list[i]; }
};

/// \param uv  output; what is not selected, or is pinned, keeps the model's coordinates
template <typename NamedParameters>
Atlas_report atlas_of_selection(const Soup_options& options, const Polygon_soup& model,
                                const Surface& surface, std::vector<Point_2>& uv, const NamedParameters& np)
{
  if (!options.selection && !options.pins)
    return generate_atlas(surface, uv, np);
  require(options.rules.empty(), options.pins ? "pinned" : "selected",
          "does not go with rules for materials");
  uv = model.uv;
  if (options.pins) {
    require(options.pins->size() == surface.number_of_corners, "pinned",
            "must have an entry for each corner");
  }
  if (!options.selection)
    return generate_atlas(surface, uv, np.pinned_map(Listed<bool>{*options.pins}));
  require(options.selection->size() == surface.number_of_faces, "selected",
          "must have an entry for each face");
  std::vector<Index> pages = model.face_page;
  pages.resize(surface.number_of_faces, 0);
  const auto selected =
      np.face_selection_map(Listed<bool>{*options.selection}).face_page_map(Listed<Index>{pages});
  return options.pins ? generate_atlas(surface, uv, selected.pinned_map(Listed<bool>{*options.pins}))
                      : generate_atlas(surface, uv, selected);
}

ATLAS_INLINE Atlas_report atlas_of_soup(const Soup_options& options, const Polygon_soup& model,
                                        Surface& surface, std::vector<Point_2>& uv,
                                        const std::function<bool(Stage, double)>& progress)
{
  check(options.page); // before policies ask for its size
  const Policies policies = policies_of(options);
  const auto common = parameters::page_options(options.page)
                          .packer(Material_packer{surface, model, options.rules, policies.packer})
                          .min_coverage(options.min_coverage)
                          .seam_exchange_rate(seam_exchange_rate_of(options))
                          .min_texels_per_chart(options.min_texels_per_chart)
                          .number_of_threads(options.threads)
                          .progress(progress);
  set_weights(options.rules, model, surface);
  if (options.keeps_uv) {
    constrain_to_uv(surface, model.uv);
    const Exact_validator any_density(std::numeric_limits<double>::infinity(), 0);
    return generate_atlas(surface, uv,
                          common.segmentation(Patch_segmentation())
                              .parameterizer(Existing_uv_parameterizer(surface, model.uv))
                              .validator(any_density));
  }
  if (options.separates_materials)
    separate_materials(model, surface);
  else if (!surface.density_weight.empty())
    separate_weights(surface);
  if (options.merges_uv) {
    const Policies merging = merging_policies(policies, options, model, surface);
    return generate_atlas(surface, uv,
                          common.segmentation(merging.segmentation)
                              .parameterizer(merging.parameterizer)
                              .validator(merging.validator)
                              .splitter(merging.splitter)
                              .hard_angle(options.hard_angle));
  }
  return atlas_of_selection(options, model, surface, uv,
                            common.policies(policies)
                                .mode(options.mode)
                                .only_given_seams(options.has_only_given_seams)
                                .hard_angle(options.hard_angle)
                                .straighten(options.is_straightened));
}

ATLAS_INLINE Repacked_charts repack_soup(const Soup_options& options, const Polygon_soup& model,
                                         Surface& surface, const Execution& execution)
{
  set_weights(options.rules, model, surface);
  const Material_packer packer{surface, model, options.rules, Raster_packer(options.effort)};
  return pack_charts(surface, model.uv, options.page, packer, execution);
}

ATLAS_INLINE std::vector<Index> pages_of_faces(const Repacked_charts& repacked, const Surface& surface)
{
  std::vector<Index> page(surface.number_of_faces, 0);
  for (std::size_t t = 0; t < surface.number_of_triangles(); ++t)
    page[surface.face[t]] = repacked.page[surface.corner[3 * t]];
  return page;
}

ATLAS_INLINE double packing_efficiency(const Repacked_charts& repacked, const Page_options& page)
{
  double sum = 0; // in texels
  for (std::size_t i = 0; i < repacked.charts.size(); ++i) {
    if (!repacked.packing.layers.empty() && repacked.packing.layers[i] > 0)
      continue;
    const Chart& chart = repacked.charts[i];
    const Placement& placement = repacked.packing.placements[i];
    double area = 0;
    for (const auto& [a, b, c] : chart.triangles)
      area += std::abs(CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]));
    sum += area * (placement.a * placement.a + placement.b * placement.b);
  }
  const double texels = double(page.width) * page.height * repacked.packing.number_of_pages;
  return texels > 0 ? sum / texels : 0;
}

} // namespace Atlas::internal

#endif
