// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_CHART_FAULTS_H
#define ATLAS_VALIDATION_INTERNAL_CHART_FAULTS_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/area_in_space.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// Pairs that are enough to see the overlapped zone of a chart.
inline constexpr std::size_t max_pairs_of_zone = 200'000;

/// The triangles of a chart in the plane.
inline std::vector<Triangle_uv> triangles_uv(const Chart& chart)
{
  std::vector<Triangle_uv> result;
  result.reserve(chart.number_of_triangles());
  for (const auto& [a, b, c] : chart.triangles)
    result.push_back({chart.uv[a], chart.uv[b], chart.uv[c]});
  return result;
}

/// Whether every vertex has a finite point of the plane.
inline bool has_coordinates(const Chart& chart)
{
  return chart.uv.size() == chart.points.size() &&
         std::all_of(chart.uv.begin(), chart.uv.end(),
                     [](const Point_2& p) { return std::isfinite(p.x()) && std::isfinite(p.y()); });
}

/// Whether a triangle is clockwise in the plane, or flat there though it has area in space. Exact.
inline bool is_flipped(const Chart& chart, Index t)
{
  const auto& [a, b, c] = chart.triangles[t];
  const CGAL::Orientation o = CGAL::orientation(chart.uv[a], chart.uv[b], chart.uv[c]);
  return o == CGAL::RIGHT_TURN ||
         (o == CGAL::COLLINEAR && has_area(chart.points[a], chart.points[b], chart.points[c]));
}

} // namespace Atlas::internal

#endif
