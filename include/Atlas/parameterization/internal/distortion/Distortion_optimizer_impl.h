// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_DISTORTION_OPTIMIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_DISTORTION_OPTIMIZER_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/parameterization/internal/distortion/Descent.h>
#include <Atlas/parameterization/internal/distortion/Multilevel_start.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

namespace Atlas::internal {

ATLAS_INLINE void check_options(const Distortion_options& options)
{
  require(options.tolerance >= 0, "tolerance", "must be at least 0");
  require(options.target >= 0, "target", "must be at least 0");
  require(options.tail_exponent >= 1, "tail_exponent", "must be at least 1");
  require(options.stretch_weight >= 0 && options.stretch_weight <= 1, "stretch_weight", "must be in [0, 1]");
}

/// \tparam Energy  one of those of distortion_energy.h
template <typename Energy>
Chart_status optimize_distortion(const Energy& energy, const Distortion_options& options, Chart& chart,
                                 const Execution& execution, Distortion_record& record)
{
  const Chart_geometry geometry(chart);
  Descent<Energy> descent(energy, options);
  typename Descent<Energy>::Minimizer minimizer(geometry, coordinates_of(geometry), descent.mean());
  record.before = record.after = minimizer.mean_energy() / Energy::isometry;
  if (minimizer.has_flip() || chart.triangles.empty())
    return Chart_status::flipped;
  minimizer.scale(minimizer.best_scale());
  const double target = options.target * Energy::isometry;
  if (options.keeps_border)
    minimizer.keep_border();
  else if (!options.starts_near_minimum && minimizer.mean_energy() > target) {
    Multilevel_start<Energy> start(geometry, minimizer.borders(), minimizer.coordinates(), descent);
    if (!start(execution) || !minimizer.adopt(start.coordinates()))
      descent.start_over();
    else if (start.is_guarded())
      minimizer.guard();
  }
  record.iterations = descent(minimizer, target, execution);
  minimizer.scale(density_correction(geometry, minimizer.coordinates()));
  store_coordinates(geometry, minimizer.coordinates(), 1, chart);
  record.after = minimizer.mean_energy() / Energy::isometry;
  record.was_border_guarded = minimizer.is_guarded();
  if (execution.is_cancelled())
    return Chart_status::cancelled;
  return minimizer.is_border_simple() ? Chart_status::valid : Chart_status::overlapping;
}

ATLAS_INLINE Chart_status optimize_distortion(Distortion_energy energy, const Distortion_options& options,
                                              Chart& chart, const Execution& execution,
                                              Distortion_record& record)
{
  check_flat_chart(chart);
  record = {};
  switch (energy) {
  case Distortion_energy::symmetric_dirichlet:
    return optimize_distortion(Symmetric_dirichlet(), options, chart, execution, record);
  case Distortion_energy::mips:
    return optimize_distortion(Mips(), options, chart, execution, record);
  case Distortion_energy::stretch:
    return optimize_distortion(Stretch(), options, chart, execution, record);
  case Distortion_energy::conformal_stretch:
    return optimize_distortion(Conformal_stretch{options.stretch_weight}, options, chart, execution, record);
  }
  throw Invalid_argument("energy", "must be one of the enumeration");
}

} // namespace Atlas::internal

#endif
