// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_EXACT_VALIDATOR_H
#define ATLAS_VALIDATION_EXACT_VALIDATOR_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/library.h>

namespace Atlas {

/// The bound of Levy et al. 2002, section 3.3, on the ratio of the largest to the smallest (area in space /
/// area in the plane) in a chart.
inline constexpr double default_max_area_ratio = 2;

/// \brief Accepts a chart that is exactly one-to-one and keeps areas well enough (Levy et al. 2002, section
/// 3.3).
///
/// Every triangle has to be counterclockwise in the plane; one without area in space may be flat. No two
/// triangles may overlap; contact is no overlap. Both are decided by exact predicates on the coordinates as
/// they are, in O(n log n). Unlike the usual argument (no flip and a simple border make a disc one-to-one)
/// the one used here holds for charts of any topology: see `is_overlap_free()`.
///
/// Models `ChartValidator`.
class Exact_validator
{
public:
  /// \param max_area_ratio  bound on the ratio of densities, at least 1; 0 and infinity switch the test off
  /// \param area_quantile   share of the chart's area in space, in [0, 0.5), that is left out at either end
  /// when the ratio is measured: 0 compares the extreme triangles as the paper does, 0.01 is robust
  /// \param bound           on the distortion of a chart
  /// \throws Invalid_argument if one of them is out of its range
  explicit Exact_validator(double max_area_ratio = default_max_area_ratio, double area_quantile = 0,
                           const Distortion_bound& bound = {});

  /// The bound on the ratio of densities.
  double max_area_ratio() const { return max_area_ratio_; }
  /// The share of the area that it leaves out at either end.
  double area_quantile() const { return area_quantile_; }
  /// The bound on the distortion.
  const Distortion_bound& bound() const { return bound_; }

  /// The worst that is wrong with the chart, with the triangles to blame: `flipped` before `overlapping`
  /// before `area_ratio_exceeded` (then the culprits are the two extreme triangles) before `bound_exceeded`
  /// (then it is the triangle that is stretched most). Coordinates that are missing or not finite give
  /// `solver_failed`. O(n log n).
  Chart_verdict validate(const Chart& chart, const Execution& execution) const;

private:
  double max_area_ratio_;
  double area_quantile_;
  Distortion_bound bound_;
};

static_assert(ChartValidator<Exact_validator>);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/validation/internal/Exact_validator_impl.h>
#endif

#endif
