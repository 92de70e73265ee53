// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_STRAIGHT_STRAIGHT_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_STRAIGHT_STRAIGHT_PARAMETERIZER_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/measure/internal/straight_layout.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace Atlas {

ATLAS_INLINE Straight_parameterizer::Straight_parameterizer(std::vector<Index> face, Any_parameterizer other,
                                                            const Distortion_bound& bound)
    : face_(std::move(face)), other_(std::move(other)), bound_(bound)
{}

ATLAS_INLINE Chart_status Straight_parameterizer::parameterize(Chart& chart, const Execution& execution) const
{
  Flattening_record record;
  return parameterize(chart, execution, record);
}

ATLAS_INLINE Chart_status Straight_parameterizer::parameterize(Chart& chart, const Execution& execution,
                                                               Flattening_record& record) const
{
  internal::require(
      std::all_of(chart.source.begin(), chart.source.end(), [&](Index t) { return t < face_.size(); }),
      "chart", "is not one of the surface");
  record = {};
  if (internal::lay_out_straight(chart, face_, bound_))
    return Chart_status::valid;
  return other_.parameterize(chart, execution, record);
}

} // namespace Atlas

#endif
