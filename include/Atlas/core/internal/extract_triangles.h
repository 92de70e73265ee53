// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_EXTRACT_TRIANGLES_H
#define ATLAS_CORE_INTERNAL_EXTRACT_TRIANGLES_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/halfedges.h>

#include <span>
#include <vector>

namespace Atlas::internal {

/// Copies triangles out as a chart: they are glued across halfedges h with `is_glued(h)`, and `point(h)` is
/// where h starts. See extract_chart(). Linear in `triangles`.
template <typename IsGlued, typename Point>
Chart extract_triangles(const std::vector<Index>& opposite, std::span<const Index> triangles,
                        std::vector<Index>& local, IsGlued is_glued, Point point)
{
  Chart chart;
  chart.source.assign(triangles.begin(), triangles.end());
  chart.triangles.assign(triangles.size(), {no_index, no_index, no_index});
  for (Index t = 0; t < triangles.size(); ++t)
    local[triangles[t]] = t;
  const auto slot = [&](Index h) -> Index& { return chart.triangles[local[h / 3]][h % 3]; };

  for (const Index t : triangles) {
    for (Index start = 3 * t; start < 3 * t + 3; ++start) {
      if (slot(start) != no_index)
        continue;
      const Index vertex = static_cast<Index>(chart.points.size());
      chart.points.push_back(point(start));
      for_each_in_fan(opposite, start, is_glued, [&](Index h) { slot(h) = vertex; });
    }
  }
  return chart;
}

} // namespace Atlas::internal

#endif
