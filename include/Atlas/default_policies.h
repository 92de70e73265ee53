// SPDX-License-Identifier: MIT
#ifndef ATLAS_DEFAULT_POLICIES_H
#define ATLAS_DEFAULT_POLICIES_H

#include <Atlas/packing/Raster_packer.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Identity_optimizer.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/validation/Exact_validator.h>

namespace Atlas {

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
struct Default_segmentation
    : Merged_segmentation<Variational_segmentation, Bijective_parameterizer<>, Identity_optimizer>
{
  Default_segmentation() : Merged_segmentation(Variational_segmentation(), trial_parameterizer()) {}

private:
  static Bijective_parameterizer<> trial_parameterizer()
  {
    Distortion_options options;
    options.max_iterations = default_trial_iterations;
    options.tolerance = default_trial_tolerance;
    return Bijective_parameterizer<>(Finish::low_distortion, options);
  }
};

/// LSCM, made one-to-one where it is not, with low symmetric Dirichlet energy.
using Default_parameterizer = Bijective_parameterizer<>;

/// The default parameterizer optimises already.
using Default_optimizer = Identity_optimizer;

using Default_packer = Raster_packer;

/// Exact one-to-one test, and a bound on density that serves as a safety net of the merge.
struct Default_validator : Exact_validator
{
  Default_validator() : Exact_validator(default_density_ratio, default_density_quantile) {}
};

} // namespace Atlas

#endif
