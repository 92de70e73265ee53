// SPDX-License-Identifier: MIT
#ifndef ATLAS_MEASURE_INTERNAL_AREA_IMPL_H
#define ATLAS_MEASURE_INTERNAL_AREA_IMPL_H

#include <Atlas/measure/distortion.h>

#include <cmath>

namespace Atlas {

ATLAS_INLINE double area_3d(const Surface& surface)
{
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += std::sqrt(CGAL::squared_area(surface.points[a], surface.points[b], surface.points[c]));
  return sum;
}

ATLAS_INLINE double area_3d(const Chart& chart)
{
  double sum = 0;
  for (const auto& [a, b, c] : chart.triangles)
    sum += std::sqrt(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c]));
  return sum;
}

ATLAS_INLINE double area_uv(const Chart& chart)
{
  double sum = 0;
  for (const auto& [a, b, c] : chart.triangles)
    sum += CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]);
  return sum;
}

ATLAS_INLINE double seam_length(const Surface& surface, const Segmentation& segmentation)
{
  double sum = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] != no_index && h < surface.opposite[h] && !segmentation.is_glued(surface, h))
      sum += std::sqrt(CGAL::squared_distance(surface.point(h), surface.point(next_halfedge(h))));
  return sum;
}

} // namespace Atlas

#endif
