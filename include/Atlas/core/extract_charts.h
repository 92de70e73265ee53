// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_EXTRACT_CHARTS_H
#define ATLAS_CORE_EXTRACT_CHARTS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>

#include <cstddef>
#include <span>
#include <vector>

namespace Atlas {

/// \brief Copies triangles of one chart out of the surface.
///
/// Corners are one vertex of the chart when they are connected around a vertex of the surface by triangles
/// glued along edges; so cuts open, and vertices where sheets only touch come apart. Linear in `triangles`.
///
/// \param triangles  all triangles of one chart of `segmentation`
/// \param local      scratch: per triangle of the surface; need not be initialised, only be large enough
inline Chart extract_chart(const Surface& surface, const Segmentation& segmentation,
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

/// Per chart, its triangles in increasing order.
inline std::vector<std::vector<Index>> triangles_of_charts(const Segmentation& segmentation)
{
  std::vector<std::vector<Index>> lists(segmentation.number_of_charts);
  for (Index t = 0; t < segmentation.chart.size(); ++t)
    lists[segmentation.chart[t]].push_back(t);
  return lists;
}

/// Copies all charts out of the surface, in the order of their numbers.
inline std::vector<Chart> extract_charts(const Surface& surface, const Segmentation& segmentation)
{
  std::vector<Index> local(surface.number_of_triangles());
  std::vector<Chart> charts;
  charts.reserve(segmentation.number_of_charts);
  for (const std::vector<Index>& triangles : triangles_of_charts(segmentation))
    charts.push_back(extract_chart(surface, segmentation, triangles, local));
  return charts;
}

/// What decides whether a chart is a disc.
struct Chart_topology
{
  Index components = 0; ///< connected over edges
  Index border_loops = 0;
  long long euler = 0; ///< vertices - edges + triangles

  bool is_disc() const { return components == 1 && border_loops == 1 && euler == 1; }
};

/// Counts components, border loops and the Euler characteristic. O(n log n).
inline Chart_topology topology(const Chart& chart)
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
