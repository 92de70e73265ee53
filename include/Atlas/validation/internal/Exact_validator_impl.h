// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_EXACT_VALIDATOR_IMPL_H
#define ATLAS_VALIDATION_INTERNAL_EXACT_VALIDATOR_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/validation/Exact_validator.h>
#include <Atlas/validation/internal/chart_densities.h>
#include <Atlas/validation/internal/chart_faults.h>

#include <algorithm>
#include <cmath>
#include <vector>

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

inline Chart_verdict check_bound(const Chart& chart, const Distortion_bound& bound)
{
  const std::vector<Triangle_distortion> measured = triangle_distortions(chart);
  const Distortion all = summarize_distortion(measured);
  if (all.triangles == 0 || used_share(measured, bound) <= 1)
    return {};
  const double g = std::sqrt(all.area_uv / all.area_3d);
  const auto stretch = [&](const Triangle_distortion& t) {
    return t.is_measurable() ? std::max(g * t.largest, 1 / (g * t.smallest)) : 0;
  };
  const auto worst = std::max_element(
      measured.begin(), measured.end(),
      [&](const Triangle_distortion& a, const Triangle_distortion& b) { return stretch(a) < stretch(b); });
  return {Chart_status::bound_exceeded, {static_cast<Index>(worst - measured.begin())}};
}

} // namespace internal

ATLAS_INLINE Exact_validator::Exact_validator(double max_area_ratio, double area_quantile,
                                              const Distortion_bound& bound)
    : max_area_ratio_(max_area_ratio), area_quantile_(area_quantile), bound_(bound)
{
  internal::require(bound.max >= 1 && bound.max_stretch >= 1, "bound", "must be at least 1");
  internal::require(bound.stretch_share > 0 && bound.stretch_share <= 1, "stretch_share",
                    "must be in (0, 1]");
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
  if (verdict.is_valid())
    verdict = internal::check_bound(chart, bound_);
  if (!execution.proceed())
    verdict = {Chart_status::cancelled, {}};
  return verdict;
}

} // namespace Atlas

#endif
