// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_PRESETS_H
#define ATLAS_PIPELINE_PRESETS_H

#include <Atlas/packing/Raster_packer.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Identity_optimizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/validation/Exact_validator.h>

#include <limits>

namespace Atlas {

/// \brief What matters most in an atlas.
enum class Atlas_mode {
  standard,  ///< few charts, short seams, low distortion: mean symmetric Dirichlet energy of at most 1.035
  few_seams, ///< fewer and larger charts, shorter seams; a bound of 1.05
  conformal  ///< the paper: least squares conformal maps as they are, densities in a chart within a factor of
             ///< 2
};

/// The name of a mode, as programs write it.
inline const char* name(Atlas_mode mode)
{
  switch (mode) {
  case Atlas_mode::standard:
    return "standard";
  case Atlas_mode::few_seams:
    return "few_seams";
  case Atlas_mode::conformal:
    return "conformal";
  }
  return "unknown";
}

/// When charts merge in a mode.
inline Merge_options merge_options(Atlas_mode mode)
{
  switch (mode) {
  case Atlas_mode::few_seams:
    return few_seams_options();
  case Atlas_mode::conformal:
    return conformal_options();
  case Atlas_mode::standard:
    break;
  }
  return Merge_options();
}

/// Whether charts are optimised in a mode.
inline Finish finish(Atlas_mode mode)
{
  return mode == Atlas_mode::conformal ? Finish::as_it_is : Finish::low_distortion;
}

/// Within a chart, areas in the plane over areas in space differ by at most this factor, the extreme
/// `default_density_quantile` of the area on either side left out: texel density varies at most by its square
/// root.
inline constexpr double default_density_ratio = 4;
/// The share of a chart's area that the bound on density leaves out at either end: a few triangles decide
/// nothing.
inline constexpr double default_density_quantile = 0.01;

/// How trial flattenings end: the decision to merge needs no more digits.
inline constexpr int default_trial_iterations = 8;
inline constexpr double default_trial_tolerance = 1e-3;

/// Charts of about the same direction, merged while their union flattens well.
struct Default_segmentation : Merged_segmentation
{
  explicit Default_segmentation(Atlas_mode mode = Atlas_mode::standard)
      : Default_segmentation(merge_options(mode), finish(mode))
  {}

  /// \param options  when charts merge
  /// \param finish   how the charts will be flattened
  Default_segmentation(const Merge_options& options, Finish finish)
      : Merged_segmentation(Variational_segmentation(), trial_parameterizer(finish), Identity_optimizer(),
                            options)
  {}

private:
  static Bijective_parameterizer<> trial_parameterizer(Finish finish)
  {
    Distortion_options options;
    options.max_iterations = default_trial_iterations;
    options.tolerance = default_trial_tolerance;
    return Bijective_parameterizer<>(finish, options);
  }
};

/// LSCM, made one-to-one where it is not, with low symmetric Dirichlet energy.
struct Default_parameterizer : Bijective_parameterizer<>
{
  explicit Default_parameterizer(Atlas_mode mode = Atlas_mode::standard)
      : Bijective_parameterizer(finish(mode))
  {}
};

/// The default parameterizer optimises already.
using Default_optimizer = Identity_optimizer;

using Default_packer = Raster_packer;

/// Exact one-to-one test, and a bound on density: the one under which charts merge, if it is of that kind,
/// else a safety net. There is none where a wish for few or large charts goes before.
struct Default_validator : Exact_validator
{
  explicit Default_validator(Atlas_mode mode = Atlas_mode::standard) : Default_validator(merge_options(mode))
  {}

  /// \param options  when charts merge
  explicit Default_validator(const Merge_options& options)
      : Exact_validator(max_density_ratio(options),
                        options.measure == Distortion_measure::area_ratio ? 0 : default_density_quantile)
  {}

private:
  static double max_density_ratio(const Merge_options& options)
  {
    if (options.max_charts > 0 || options.min_chart_area > 0)
      return std::numeric_limits<double>::infinity();
    const bool is_bounded = options.measure == Distortion_measure::area_ratio ||
                            options.measure == Distortion_measure::area_ratio_quantiles;
    return is_bounded ? options.max_distortion : default_density_ratio;
  }
};

} // namespace Atlas

#endif
