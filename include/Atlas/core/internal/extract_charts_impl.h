// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_EXTRACT_CHARTS_IMPL_H
#define ATLAS_CORE_INTERNAL_EXTRACT_CHARTS_IMPL_H

#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/halfedges.h>

#include <cstddef>

namespace Atlas {

ATLAS_INLINE Chart extract_chart(const Surface& surface, const Segmentation& segmentation,
                                 std::span<const Index> triangles, std::vector<Index>& local)
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
      chart.points.push_back(surface.point(start));
      internal::for_each_in_fan(
          surface.opposite, start, [&](Index h) { return segmentation.is_glued(surface, h); },
          [&](Index h) { slot(h) = vertex; });
    }
  }
  return chart;
}

ATLAS_INLINE std::vector<std::vector<Index>> triangles_of_charts(const Segmentation& segmentation)
{
  std::vector<std::vector<Index>> lists(segmentation.number_of_charts);
  for (Index t = 0; t < segmentation.chart.size(); ++t)
    lists[segmentation.chart[t]].push_back(t);
  return lists;
}

ATLAS_INLINE std::vector<Chart> extract_charts(const Surface& surface, const Segmentation& segmentation)
{
  std::vector<Index> local(surface.number_of_triangles());
  std::vector<Chart> charts;
  charts.reserve(segmentation.number_of_charts);
  for (const std::vector<Index>& triangles : triangles_of_charts(segmentation))
    charts.push_back(extract_chart(surface, segmentation, triangles, local));
  return charts;
}

ATLAS_INLINE Chart_topology topology(const Chart& chart)
{
  const std::vector<Index> opposite = internal::opposite_halfedges(chart.triangles);
  Chart_topology result;
  result.border_loops = static_cast<Index>(internal::border_loops(opposite).size());
  long long border = 0;
  for (const Index o : opposite)
    border += o == no_index;
  const long long edges = (static_cast<long long>(opposite.size()) + border) / 2;
  result.euler = static_cast<long long>(chart.number_of_vertices()) - edges +
                 static_cast<long long>(chart.number_of_triangles());

  result.components = internal::connected_components(opposite).count;
  return result;
}

} // namespace Atlas

#endif
