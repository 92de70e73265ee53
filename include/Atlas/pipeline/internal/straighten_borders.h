// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_STRAIGHTEN_BORDERS_H
#define ATLAS_PIPELINE_INTERNAL_STRAIGHTEN_BORDERS_H

#include <Atlas/core/Chart.h>
#include <Atlas/packing/internal/shapes/straight_runs.h>
#include <Atlas/pipeline/internal/round_coordinates.h>

namespace Atlas::internal {

/// Gives the vertices of each straight border that is parallel to an axis of the page one coordinate, which
/// rounding each of them by itself would not: they may lie on either side of the middle between two cells.
/// Before coordinates are rounded; no vertex moves by more than two cells of the grid.
inline void straighten_borders(Chart& chart)
{
  constexpr double tolerance = 4 / grid_cells;
  for (const int across : {0, 1})
    for (const Straight_run& run : straight_runs(chart, across, tolerance))
      for (const Index v : run.vertices) {
        const Point_2& p = chart.uv[v];
        chart.uv[v] = across == 0 ? Point_2(run.coordinate(), p.y()) : Point_2(p.x(), run.coordinate());
      }
}

} // namespace Atlas::internal

#endif
