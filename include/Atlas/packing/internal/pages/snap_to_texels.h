// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_SNAP_TO_TEXELS_H
#define ATLAS_PACKING_INTERNAL_PAGES_SNAP_TO_TEXELS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Packing.h>
#include <Atlas/packing/internal/shapes/straight_runs.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Atlas::internal {

/// What a coordinate becomes: x -> scale x + shift.
struct Axis_map
{
  double scale = 1, shift = 0;
};

/// The map that brings straight borders of a chart, which is in texels, onto borders of texels.
///
/// Where the chart ends in straight borders on both sides, both go to the nearest border of a texel, if that
/// stretches the chart by no more than `max_snap_stretch`. Else the longest straight border does, and the
/// chart is only moved. No point moves by more than half a texel.
inline Axis_map snapping_map(const Chart& placed, int across)
{
  constexpr double tolerance = 1e-3, least_length = 1; // texels
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const auto& triangle : placed.triangles)
    for (const Index v : triangle) {
      low = std::min(low, placed.uv[v][across]);
      high = std::max(high, placed.uv[v][across]);
    }
  const Straight_run *longest = nullptr, *first = nullptr, *last = nullptr;
  const std::vector<Straight_run> runs = straight_runs(placed, across, tolerance);
  for (const Straight_run& run : runs) {
    if (run.length < least_length)
      continue;
    longest = !longest || run.length > longest->length ? &run : longest;
    first = run.low <= low ? &run : first;
    last = run.high >= high ? &run : last;
  }
  if (!longest)
    return {};
  if (first && last && first != last) {
    const double from = first->coordinate(), size = last->coordinate() - from;
    const double to = std::round(from), wanted = std::round(from + size) - to;
    if (const double scale = wanted / size; std::abs(scale - 1) <= max_snap_stretch)
      return {scale, to - scale * from};
  }
  return {1, std::round(longest->coordinate()) - longest->coordinate()};
}

/// The placement that brings straight borders of a chart onto borders of texels, along both axes.
inline Placement snapped(const Chart& chart, Placement placement)
{
  Chart placed;
  placed.triangles = chart.triangles;
  placed.uv.reserve(chart.uv.size());
  for (const Point_2& p : chart.uv)
    placed.uv.push_back(placement(p));
  const Axis_map x = snapping_map(placed, 0), y = snapping_map(placed, 1);
  placement.stretch_x *= x.scale;
  placement.stretch_y *= y.scale;
  placement.x = x.scale * placement.x + x.shift;
  placement.y = y.scale * placement.y + y.shift;
  return placement;
}

} // namespace Atlas::internal

#endif
