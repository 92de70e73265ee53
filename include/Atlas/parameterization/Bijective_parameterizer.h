// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_BIJECTIVE_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_BIJECTIVE_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Flattening_record.h>
#include <Atlas/core/concepts.h>
#include <Atlas/parameterization/LSCM_parameterizer.h>
#include <Atlas/parameterization/MIPS_optimizer.h>
#include <Atlas/parameterization/Schnyder_parameterizer.h>
#include <Atlas/parameterization/Symmetric_dirichlet_optimizer.h>
#include <Atlas/parameterization/Tutte_parameterizer.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Whether every chart is optimised, or only those that need it to be one-to-one.
enum class Finish {
  low_distortion, ///< symmetric Dirichlet on every chart
  as_it_is ///< the first choice where it is one-to-one; elsewhere a map that is, and is as conformal as that
           ///< allows
};

/// \brief Flattens every disc one-to-one: the chosen parameterizer, then an optimiser that cannot flip; where
/// that does not give a one-to-one map, the optimiser from Tutte's map; and where double precision does
/// not hold that, from Schnyder's drawing.
///
/// With `Finish::as_it_is` the repaired map is led on to the least MIPS energy (Hormann and Greiner 2000),
/// which is conformal distortion, instead of the least symmetric Dirichlet energy.
///
/// One-to-one means: proved by exact predicates on the coordinates in double precision.
template <ChartParameterizer First = LSCM_parameterizer<>>
class Bijective_parameterizer
{
public:
  explicit Bijective_parameterizer(Finish finish = Finish::low_distortion, Distortion_options options = {},
                                   First first = First())
      : finish_(finish), options_(options), first_(std::move(first))
  {}

  /// \return `valid` for every disc with area; else the reason
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    Flattening_record record;
    return parameterize(chart, execution, record);
  }

  Chart_status parameterize(Chart& chart, const Execution& execution, Flattening_record& record) const
  {
    record = {};
    if (try_first(chart, execution, record))
      return Chart_status::valid;
    if (execution.is_cancelled())
      return Chart_status::cancelled;
    record.start = Flattening_start::tutte;
    if (Tutte_parameterizer().parameterize(chart, execution) == Chart_status::valid) {
      const Chart_status status = optimize(chart, execution, record);
      if (status == Chart_status::cancelled || record.distortion.after < hopeless)
        return status;
    }
    record.start = Flattening_start::schnyder;
    if (const Chart_status status = Schnyder_parameterizer().parameterize(chart, execution);
        status != Chart_status::valid)
      return status;
    return optimize(chart, execution, record);
  }

private:
  /// Mean energy of a chart of which parts shrank to almost nothing in Tutte's map and could not recover.
  static constexpr double hopeless = 1e6;

  bool try_first(Chart& chart, const Execution& execution, Flattening_record& record) const
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
    if (finish_ == Finish::as_it_is && !record.was_overlapping)
      return true;
    return optimize(chart, execution, record) == Chart_status::valid;
  }

  Chart_status optimize(Chart& chart, const Execution& execution, Flattening_record& record) const
  {
    record.is_optimized = true;
    const Chart_status status =
        Symmetric_dirichlet_optimizer(options_).optimize(chart, execution, record.distortion);
    if (finish_ == Finish::low_distortion || status != Chart_status::valid)
      return status;
    // The scale-free energy of conformal maps needs a start in which no part is far too small.
    Distortion_record of_angles;
    return MIPS_optimizer(options_).optimize(chart, execution, of_angles);
  }

  Finish finish_;
  Distortion_options options_;
  First first_;
};

} // namespace Atlas

#endif
