// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_BOUNDING_BOX_H
#define ATLAS_CORE_INTERNAL_BOUNDING_BOX_H

#include <Atlas/core/Surface.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Atlas::internal {

/// The bounding box of the triangles of a surface, vertices without one left out.
struct Bounding_box
{
  std::array<double, 3> center{};
  double half_side = 0; ///< half the largest side; negative if there is no triangle
};

/// Linear. Halves are taken first: the sum and the difference of large numbers may overflow.
inline Bounding_box bounding_box(const Surface& surface)
{
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (const auto& triangle : surface.triangles)
    for (const Index v : triangle)
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], surface.points[v][i]);
        high[i] = std::max(high[i], surface.points[v][i]);
      }
  Bounding_box box{{}, -INFINITY};
  for (int i = 0; i < 3; ++i) {
    box.center[i] = low[i] / 2 + high[i] / 2;
    box.half_side = std::max(box.half_side, high[i] / 2 - low[i] / 2);
  }
  return box;
}

} // namespace Atlas::internal

#endif
