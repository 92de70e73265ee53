// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_PRESETS_H
#define ATLAS_PIPELINE_PRESETS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/segmentation/merge_charts.h>

namespace Atlas {

/// \brief What matters most in an atlas.
enum class Atlas_mode {
  standard,  ///< few charts, short seams, low distortion: mean symmetric Dirichlet energy of at most 1.035
  few_seams, ///< fewer and larger charts, shorter seams; a bound of 1.05
  conformal  ///< least squares conformal maps as they are; densities in a chart within a factor of 2
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
Merge_options merge_options(Atlas_mode mode);

/// Within a chart, areas in the plane over areas in space differ by at most this factor, the extreme
/// `default_density_quantile` of the area on either side left out: texel density varies at most by its square
/// root.
inline constexpr double default_density_ratio = 4;
/// The share of a chart's area that the bound on density leaves out at either end: a few triangles decide
/// nothing.
inline constexpr double default_density_quantile = 0.01;

/// \brief The policies of a run, one for each stage.
struct Policies
{
  Any_segmentation segmentation;
  Any_parameterizer parameterizer;
  Any_optimizer optimizer;
  Any_validator validator;
  Any_splitter splitter;
  Any_packer packer;
};

/// \brief The policies of a mode. Each may be exchanged for another.
///
/// - `segmentation`: `Variational_segmentation`, merged as `options` say (`Merged_segmentation`)
/// - `parameterizer`: `Bijective_parameterizer`: LSCM, made one-to-one where it is not; but for the conformal
/// mode, with
///   low symmetric Dirichlet energy
/// - `optimizer`: `Identity_optimizer`, as the parameterizer optimises already
/// - `validator`: `Exact_validator`, with a bound on densities: that of `options`, if they bound densities,
/// else
///   `default_density_ratio`. There is none where a wish for few or large charts goes before.
/// - `splitter`: `Culprit_splitter`
/// - `packer`: `Raster_packer`
///
/// \param options  when charts merge
/// \throws Invalid_argument if an option is out of its range
Policies preset(Atlas_mode mode, const Merge_options& options);

/// The policies of a mode with its own options.
inline Policies preset(Atlas_mode mode = Atlas_mode::standard)
{
  return preset(mode, merge_options(mode));
}

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/pipeline/internal/presets_impl.h>
#endif

#endif
