// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_BIJECTIVE_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_BIJECTIVE_PARAMETERIZER_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>

#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// Mean energy of a chart of which parts shrank to almost nothing in Tutte's map and could not recover.
inline constexpr double hopeless_energy = 1e6;

} // namespace internal

ATLAS_INLINE Bijective_parameterizer::Bijective_parameterizer(Optimize_charts optimize,
                                                              const Distortion_options& options)
    : Bijective_parameterizer(optimize, options, LSCM_parameterizer<>())
{}

ATLAS_INLINE Bijective_parameterizer::Bijective_parameterizer(Optimize_charts optimize,
                                                              const Distortion_options& options,
                                                              Any_parameterizer first)
    : when_(optimize), options_(options), first_(std::move(first))
{
  internal::check_options(options_);
}

ATLAS_INLINE Chart_status Bijective_parameterizer::parameterize(Chart& chart,
                                                                const Execution& execution) const
{
  Flattening_record record;
  return parameterize(chart, execution, record);
}

ATLAS_INLINE Chart_status Bijective_parameterizer::parameterize(Chart& chart, const Execution& execution,
                                                                Flattening_record& record) const
{
  internal::check_chart(chart);
  record = {};
  if (try_first(chart, execution, record))
    return Chart_status::valid;
  if (execution.is_cancelled())
    return Chart_status::cancelled;
  record.start = Flattening_start::tutte;
  if (Tutte_parameterizer().parameterize(chart, execution) == Chart_status::valid) {
    const Chart_status status = optimize(chart, execution, record);
    if (status == Chart_status::cancelled || record.distortion.after < internal::hopeless_energy)
      return status;
  }
  record.start = Flattening_start::schnyder;
  if (const Chart_status status = Schnyder_parameterizer().parameterize(chart, execution);
      status != Chart_status::valid)
    return status;
  return optimize(chart, execution, record);
}

ATLAS_INLINE bool Bijective_parameterizer::try_first(Chart& chart, const Execution& execution,
                                                     Flattening_record& record) const
{
  if (first_.parameterize(chart, execution) != Chart_status::valid || execution.is_cancelled())
    return false;
  internal::Injectivity_checker checker(chart);
  if (checker.borders().size() != 1)
    return false;
  std::vector<internal::Complex> u;
  for (const Point_2& p : chart.uv)
    u.emplace_back(p.x(), p.y());
  record.flips = checker.number_of_flips(u);
  record.was_overlapping = !checker.is_border_simple(u);
  if (record.flips > 0)
    return false;
  if (when_ == Optimize_charts::if_needed && !record.was_overlapping)
    return true;
  return optimize(chart, execution, record) == Chart_status::valid;
}

ATLAS_INLINE Chart_status Bijective_parameterizer::optimize(Chart& chart, const Execution& execution,
                                                            Flattening_record& record) const
{
  record.is_optimized = true;
  const Chart_status status =
      Symmetric_dirichlet_optimizer(options_).optimize(chart, execution, record.distortion);
  if (when_ == Optimize_charts::always || status != Chart_status::valid)
    return status;
  // The scale-free energy of conformal maps needs a start in which no part is far too small.
  Distortion_record of_angles;
  return MIPS_optimizer(options_).optimize(chart, execution, of_angles);
}

} // namespace Atlas

#endif
