// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_TRIAL_PARAMETERIZER_H
#define ATLAS_PIPELINE_INTERNAL_TRIAL_PARAMETERIZER_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/pipeline/presets.h>

namespace Atlas::internal {

/// How trial flattenings end: the decision to merge needs no more digits.
inline constexpr int default_trial_iterations = 8;
inline constexpr double default_trial_tolerance = 1e-3;

/// Whether charts are optimised in a mode.
inline Optimize_charts optimize_charts(Atlas_mode mode)
{
  return mode == Atlas_mode::conformal ? Optimize_charts::if_needed : Optimize_charts::always;
}

/// How unions of charts are flattened for trial.
inline Any_parameterizer trial_parameterizer(Optimize_charts optimize)
{
  Distortion_options options;
  options.max_iterations = default_trial_iterations;
  options.tolerance = default_trial_tolerance;
  return Bijective_parameterizer(optimize, options);
}

} // namespace Atlas::internal

#endif
