// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_CONSTRAIN_TO_UV_H
#define ATLAS_CORE_CONSTRAIN_TO_UV_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/charts_of_uv.h>

#include <CGAL/enum.h>

#include <span>

namespace Atlas {

/// \brief Makes patches of the charts that coordinates have, and seams of the cuts inside of them.
///
/// \param uv  per corner of the input: its coordinates; not finite where there are none
///
/// Where a chart folds over, the two sides become patches of their own: each of them is one-to-one unless it
/// overlaps itself. With `Patch_segmentation` and `Existing_uv_parameterizer` this keeps what others have
/// flattened. Linear.
inline void constrain_to_uv(Surface& surface, std::span<const Point_2> uv)
{
  const Segmentation charts = charts_of_uv(surface, uv);
  surface.patch = charts.chart;
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  for (Index h = 0; h < surface.constraint.size(); ++h)
    if (charts.cut[h])
      surface.constraint[h] = Edge_constraint::seam;
  for (Index t = 0; t < surface.patch.size(); ++t) {
    const auto at = [&](Index i) { return uv[surface.corner[3 * t + i]]; };
    if (charts.chart[t] != no_index && CGAL::orientation(at(0), at(1), at(2)) == CGAL::RIGHT_TURN)
      surface.patch[t] += charts.number_of_charts;
  }
}

} // namespace Atlas

#endif
