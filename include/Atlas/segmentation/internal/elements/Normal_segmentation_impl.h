// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_NORMAL_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_NORMAL_SEGMENTATION_IMPL_H

#include <Atlas/core/internal/Union_find.h>
#include <Atlas/segmentation/Normal_segmentation.h>
#include <Atlas/segmentation/internal/arguments.h>
#include <Atlas/segmentation/internal/elements/Element_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace Atlas {

namespace internal {

inline void require_valid(const Normal_segmentation::Options& options)
{
  require_in(options.cells_per_side, 1, 1000, "cells_per_side");
  require_share(options.min_share, "min_share");
}

/// The cell of a direction on a cube whose sides have n * n cells; the null vector has one of them.
inline Index cell_of_direction(const Vector_3& v, int n)
{
  const std::array<double, 3> x{v.x(), v.y(), v.z()};
  const auto size = [&](int i) { return std::abs(x[i]); };
  const int axis = size(0) >= size(1) && size(0) >= size(2) ? 0 : size(1) >= size(2) ? 1 : 2;
  Index side = static_cast<Index>(2 * axis + (x[axis] < 0));
  for (int k = 1; k <= 2; ++k) {
    const double share = size(axis) > 0 ? (x[(axis + k) % 3] / size(axis) + 1) / 2 : 0;
    side =
        side * static_cast<Index>(n) + static_cast<Index>(std::clamp(static_cast<int>(share * n), 0, n - 1));
  }
  return side;
}

/// Groups each small element with the neighbour of the longest border. Returns the number of groups.
inline Index group_small_elements(const Element_graph& graph, double least, std::vector<Index>& group)
{
  Union_find groups(graph.size());
  for (Index e = 0; e < graph.size(); ++e) {
    if (graph.area[e] >= least || graph.first[e] == graph.first[e + 1])
      continue;
    const auto* begin = graph.links.data() + graph.first[e];
    const auto* end = graph.links.data() + graph.first[e + 1];
    const auto* best =
        std::max_element(begin, end, [](const auto& a, const auto& b) { return a.length < b.length; });
    groups.unite(e, best->element);
  }
  return groups.number_sets(group);
}

} // namespace internal

ATLAS_INLINE Normal_segmentation::Normal_segmentation(const Options& options) : options_(options)
{
  internal::require_valid(options);
}

ATLAS_INLINE Segmentation Normal_segmentation::segment(const Surface& surface,
                                                       const Execution& execution) const
{
  std::vector<Index> element;
  const Index count = internal::elements_of_triangles(surface, element);
  internal::Element_graph graph = internal::element_graph(surface, element, count);

  std::vector<Index> cells(count), chart;
  for (Index e = 0; e < count; ++e)
    cells[e] = internal::cell_of_direction(graph.area_vector[e], options_.cells_per_side);
  Index charts = internal::label_components(graph, cells, chart);
  const double least = options_.min_share * std::accumulate(graph.area.begin(), graph.area.end(), 0.0);
  graph = internal::contract(graph, chart, charts);
  // Each round at least halves the small charts that have a neighbour.
  while (execution.proceed(0.5)) {
    std::vector<Index> group;
    const Index fewer = internal::group_small_elements(graph, least, group);
    if (fewer == charts)
      break;
    for (Index& c : chart)
      c = group[c];
    graph = internal::contract(graph, group, fewer);
    charts = fewer;
  }
  return internal::segmentation_of_elements(surface, element, chart, charts);
}

} // namespace Atlas

#endif
