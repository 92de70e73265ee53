// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_FILTER_NORMALS_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_FILTER_NORMALS_H

#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// The angle between normals that the filter takes for noise, in radians (about 30 degrees): the width of the
/// bilateral filter's range kernel.
inline constexpr double normal_filter_width = 0.5;

/// Bilateral filter of the triangles' normals: each becomes the mean of those around it, weighted by area and
/// by how near the normals are, so that noise goes and sharp edges stay (Y. Zheng, H. Fu, O. Au, C. Tai,
/// Bilateral normal filtering for mesh denoising, TVCG 2011). Linear in triangles times rounds.
inline void filter_normals(const Surface& surface, const Submesh& submesh, int rounds,
                           std::vector<Vector_3>& normals)
{
  if (rounds <= 0)
    return;
  std::vector<double> area(normals.size());
  for (Index t = 0; t < area.size(); ++t)
    area[t] = triangle_area(surface, t);
  std::vector<Vector_3> next(normals.size());
  for (int round = 0; round < rounds; ++round) {
    for (Index t = 0; t < normals.size(); ++t) {
      Vector_3 sum = area[t] * normals[t];
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (const Index o = submesh.opposite[h]; o != no_index) {
          const double d = (normals[o / 3] - normals[t]).squared_length();
          sum = sum +
                area[o / 3] * std::exp(-d / (2 * normal_filter_width * normal_filter_width)) * normals[o / 3];
        }
      const double length = std::sqrt(sum.squared_length());
      next[t] = length > 0 ? sum / length : normals[t];
    }
    normals.swap(next);
  }
}

} // namespace Atlas::internal

#endif
