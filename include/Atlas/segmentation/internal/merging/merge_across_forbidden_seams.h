// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_ACROSS_FORBIDDEN_SEAMS_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_ACROSS_FORBIDDEN_SEAMS_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/internal/elements/Element_graph.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Gives triangles that are joined by edges which must not be seams one chart, that which has most of their
/// area. Charts may fall apart or lose all their triangles by that. O(n log n).
inline void merge_across_forbidden_seams(const Surface& surface, Segmentation& segmentation)
{
  if (surface.constraint.empty())
    return;
  std::vector<Index> element;
  const Index count = elements_of_triangles(surface, element);
  std::vector<std::map<Index, double>> area_of_charts(count);
  for (Index t = 0; t < element.size(); ++t)
    area_of_charts[element[t]][segmentation.chart[t]] += triangle_area(surface, t);
  std::vector<Index> chart(count, no_index);
  for (Index e = 0; e < count; ++e) {
    double largest = -1;
    for (const auto& [c, area] : area_of_charts[e])
      if (area > largest)
        std::tie(largest, chart[e]) = std::pair(area, c);
  }
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (must_not_be_seam(surface, h))
      segmentation.cut[h] = 0;
  for (Index t = 0; t < element.size(); ++t)
    segmentation.chart[t] = chart[element[t]];
}

} // namespace Atlas::internal

#endif
