// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_SCALE_TO_AREA_H
#define ATLAS_PIPELINE_INTERNAL_SCALE_TO_AREA_H

#include <Atlas/core/Chart.h>
#include <Atlas/measure/distortion.h>

#include <algorithm>
#include <cmath>

namespace Atlas::internal {

/// Scales the chart to its area in space; but to no less than about a texel, so that tiny and needle-thin
/// charts get texels of their own and do not collapse when coordinates are rounded.
inline void scale_to_area(Chart& chart, double texel)
{
  constexpr double fineness = 4294967296.0; // cells across a chart to which its coordinates are snapped
  const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
  const double extent = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  if (!(extent > 0) || !std::isfinite(extent))
    return;
  const double in_plane = std::abs(area_uv(chart)) / extent / extent;
  const double side = std::max(texel, in_plane > 0 ? std::sqrt(area_3d(chart) / in_plane) : 0.0);
  const auto snap = [&](double x) { return std::round(x / extent * fineness) / fineness * side; };
  for (Point_2& p : chart.uv)
    p = Point_2(snap(p.x() - box.xmin()), snap(p.y() - box.ymin()));
}

} // namespace Atlas::internal

#endif
