// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_MEAN_WEIGHT_H
#define ATLAS_CORE_INTERNAL_MEAN_WEIGHT_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>

#include <cmath>
#include <cstddef>

namespace Atlas::internal {

/// The mean of the density weights of a chart's triangles, by area in space; 1 if they have no area.
/// \pre the surface has weights
inline double mean_weight(const Surface& surface, const Chart& chart)
{
  double area = 0, sum = 0;
  for (std::size_t t = 0; t < chart.source.size(); ++t) {
    const auto& [a, b, c] = chart.triangles[t];
    const double share = std::sqrt(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c]));
    area += share;
    sum += share * surface.density_weight[chart.source[t]];
  }
  return area > 0 ? sum / area : 1;
}

} // namespace Atlas::internal

#endif
