// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_PRESETS_IMPL_H
#define ATLAS_PIPELINE_INTERNAL_PRESETS_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/packing/Horizon_packer.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/internal/raster/raster_layout.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/pipeline/internal/trial_parameterizer.h>
#include <Atlas/pipeline/presets.h>
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/validation/Culprit_splitter.h>
#include <Atlas/validation/Exact_validator.h>

#include <limits>
#include <utility>

namespace Atlas {

namespace internal {

/// The power of the energy whose mean charts of the mode `standard` end at: it lowers the worst places, and
/// costs the mean little.
inline constexpr unsigned standard_tail_exponent = 4;

/// The share of a page that charts cover as a rule.
inline constexpr double usual_packing_efficiency = 0.6;

/// Whether charts may exceed their bound, for there shall be few or large ones.
inline bool has_wishes(const Merge_options& options)
{
  return options.max_charts > 0 || options.min_chart_area > 0;
}

/// The bound on densities that goes with options for merging; infinite where wishes go before.
inline double max_density_ratio(const Merge_options& options)
{
  if (has_wishes(options))
    return std::numeric_limits<double>::infinity();
  const bool is_bounded = options.measure == Distortion_measure::area_ratio ||
                          options.measure == Distortion_measure::area_ratio_quantiles;
  return is_bounded ? options.max_distortion : default_density_ratio;
}

/// The bound that charts are split for; none where wishes go before.
inline Distortion_bound kept_bound(const Merge_options& options)
{
  return has_wishes(options) ? Distortion_bound() : bound_of(options);
}

/// Who tells how well nets fill a page: that nets are compared takes one first layout of good size.
inline Any_packer trial_packer()
{
  Search_budget budget = racing_budget();
  budget.searches = 1;
  budget.rounds = 0;
  budget.max_charts = max_charts_of_fast_search;
  return Page_packer(Raster_engine{budget});
}

/// How charts that have been decided on are flattened. In the other modes the mean is what their bounds leave
/// least room in.
inline Any_parameterizer final_parameterizer(Atlas_mode mode)
{
  Distortion_options options;
  if (mode == Atlas_mode::standard)
    options.tail_exponent = standard_tail_exponent;
  return Bijective_parameterizer(optimize_charts(mode), options);
}

/// In the standard mode charts are opened by slits, so that people see no bad spot, to a share of what the
/// bound allows beyond 1. Not so where charts may exceed their bound, nor where seams shall be mirrored.
inline Repair_options repair_options(Atlas_mode mode, const Merge_options& options, Symmetry symmetry)
{
  constexpr double share = 0.56; // 1.28 of 1.5: less costs more seam than it is worth
  Repair_options result;
  if (mode == Atlas_mode::standard && symmetry == Symmetry::off && !has_wishes(options)) {
    result.wanted_stretch = 1 + share * (options.max_stretch - 1);
    Distortion_options of_slits;
    of_slits.tail_exponent = standard_tail_exponent;
    of_slits.starts_near_minimum = true;
    of_slits.max_iterations = 10; // smooth charts take less, rough ones would gain little
    result.slit_optimizer = Symmetric_dirichlet_optimizer(of_slits);
  }
  return result;
}

} // namespace internal

ATLAS_INLINE Merge_options merge_options(Atlas_mode mode)
{
  switch (mode) {
  case Atlas_mode::few_seams:
    return few_seams_options();
  case Atlas_mode::conformal:
    return conformal_options();
  case Atlas_mode::standard:
  case Atlas_mode::paper:
    break;
  }
  return Merge_options();
}

ATLAS_INLINE double seam_exchange_rate(Atlas_mode mode)
{
  return mode == Atlas_mode::standard ? 0.5 : 0;
}

ATLAS_INLINE Policies preset(Atlas_mode mode, const Merge_options& options, Symmetry symmetry)
{
  internal::require(mode != Atlas_mode::paper, "mode",
                    "`paper` needs a validator: that of the paper is Stencil_validator, of the component "
                    "Atlas::Rendering");
  const Optimize_charts optimize = internal::optimize_charts(mode);
  const double quantile = options.measure == Distortion_measure::area_ratio ? 0 : default_density_quantile;
  Merged_segmentation curved(Variational_segmentation(), internal::trial_parameterizer(optimize),
                             Identity_optimizer(), options);
  return {Developable_segmentation(Mirrored_segmentation(std::move(curved), symmetry),
                                   internal::trial_packer(), options.max_charts),
          Isometric_parameterizer(internal::final_parameterizer(mode)),
          Identity_optimizer(),
          Exact_validator(internal::max_density_ratio(options), quantile, internal::kept_bound(options)),
          Culprit_splitter(quantile),
          Raster_packer(),
          internal::repair_options(mode, options, symmetry)};
}

ATLAS_INLINE Policies paper_preset(Any_validator validator)
{
  return {Feature_segmentation::paper(),
          LSCM_parameterizer<Paper_LSCM_traits>(),
          Identity_optimizer(),
          std::move(validator),
          Culprit_splitter(),
          Horizon_packer(),
          Repair_options::paper()};
}

ATLAS_INLINE double area_share_of_texels(double texels, const Page_options& page)
{
  return texels / (internal::usual_packing_efficiency * double(page.width) * page.height);
}

} // namespace Atlas

#endif
