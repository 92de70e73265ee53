// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_SCHNYDER_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_SCHNYDER_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>

namespace Atlas {

/// \brief A straight-line drawing of the chart on an integer grid: Schnyder 1990.
///
/// Built without floating-point arithmetic from the connectivity alone, so one-to-one for every disc, also
/// where Tutte's map shrinks below double precision. Shapes are as bad as can be: it is the last start for an
/// optimiser. Scaled by a power of two, to the chart's area within a factor of 4. Linear time but for the
/// sorting of edges.
class Schnyder_parameterizer
{
public:
  /// \return `valid`, or `not_a_disc`; the coordinates are then all zero
  Chart_status parameterize(Chart& chart, const Execution& execution) const;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/fixed_border/Schnyder_parameterizer_impl.h>
#endif

#endif
