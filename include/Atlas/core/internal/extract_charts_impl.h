// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_EXTRACT_CHARTS_IMPL_H
#define ATLAS_CORE_INTERNAL_EXTRACT_CHARTS_IMPL_H

#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/extract_triangles.h>
#include <Atlas/core/internal/halfedges.h>

namespace Atlas {

ATLAS_INLINE Chart extract_chart(const Surface& surface, const Segmentation& segmentation,
                                 std::span<const Index> triangles, std::vector<Index>& local)
{
  return internal::extract_triangles(
      surface.opposite, triangles, local, [&](Index h) { return segmentation.is_glued(surface, h); },
      [&](Index h) -> const Point_3& { return surface.point(h); });
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
