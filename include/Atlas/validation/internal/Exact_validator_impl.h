// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_EXACT_VALIDATOR_IMPL_H
#define ATLAS_VALIDATION_INTERNAL_EXACT_VALIDATOR_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/internal/chart_densities.h>
#include <Atlas/validation/internal/chart_faults.h>

namespace Atlas {

namespace internal {

inline Chart_verdict check_orientation(const Chart& chart)
{
  Chart_verdict verdict;
  for (Index t = 0; t < chart.number_of_triangles(); ++t)
    if (is_flipped(chart, t))
      verdict.culprits.push_back(t);
  if (!verdict.culprits.empty())
    verdict.status = Chart_status::flipped;
  return verdict;
}

inline Chart_verdict check_overlap(const Chart& chart, const Execution& execution)
{
  Chart_verdict verdict;
  const std::vector<Triangle_uv> triangles = triangles_uv(chart);
  if (is_overlap_free(triangles, opposite_halfedges(chart.triangles)))
    return verdict;
  verdict.status = Chart_status::overlapping;
  verdict.culprits = triangles_of(find_overlaps(triangles, execution, max_pairs_of_zone));
  return verdict;
}

} // namespace internal

ATLAS_INLINE Exact_validator::Exact_validator(double max_area_ratio, double area_quantile)
    : max_area_ratio_(max_area_ratio), area_quantile_(area_quantile)
{
  internal::require(max_area_ratio == 0 || max_area_ratio >= 1, "max_area_ratio",
                    "must be at least 1, or 0 for no bound");
  internal::require(area_quantile >= 0 && area_quantile < 0.5, "area_quantile", "must be in [0, 0.5)");
}

ATLAS_INLINE Chart_verdict Exact_validator::validate(const Chart& chart, const Execution& execution) const
{
  Chart_verdict verdict;
  if (!internal::has_coordinates(chart))
    verdict.status = Chart_status::solver_failed;
  if (verdict.is_valid())
    verdict = internal::check_orientation(chart);
  if (verdict.is_valid())
    verdict = internal::check_overlap(chart, execution);
  if (verdict.is_valid())
    verdict = internal::Chart_densities(chart, area_quantile_).check(max_area_ratio_);
  if (!execution.proceed())
    verdict = {Chart_status::cancelled, {}};
  return verdict;
}

} // namespace Atlas

#endif
