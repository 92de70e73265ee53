// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_IDLE_CORNERS_H
#define ATLAS_PIPELINE_INTERNAL_IDLE_CORNERS_H

#include <Atlas/core/Kernel.h>

#include <vector>

namespace Atlas::internal {

/// Corners that no triangle uses (of rejected faces, or the second of two equal neighbours) take the
/// coordinates of the used corner before them, so that their faces have no area in the plane.
inline void write_idle_corners(std::vector<Point_2>& corner_uv, const Point_2& nowhere)
{
  Point_2 last(0.5, 0.5);
  for (Point_2& p : corner_uv) {
    if (p == nowhere)
      p = last;
    last = p;
  }
}

} // namespace Atlas::internal

#endif
