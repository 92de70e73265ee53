// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PACK_CHARTS_IMPL_H
#define ATLAS_PACKING_INTERNAL_PAGES_PACK_CHARTS_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/core/internal/mean_weight.h>
#include <Atlas/packing/pack_charts.h>

#include <cstddef>
#include <span>
#include <vector>

namespace Atlas {

namespace internal {

/// The triangles of each chart, without those that are in none.
inline std::vector<std::vector<Index>> triangles_in_charts(const Segmentation& segmentation)
{
  std::vector<std::vector<Index>> triangles(segmentation.number_of_charts);
  for (Index t = 0; t < segmentation.chart.size(); ++t)
    if (const Index c = segmentation.chart[t]; c != no_index)
      triangles[c].push_back(t);
  return triangles;
}

/// The charts with the coordinates of their corners.
inline std::vector<Chart> charts_with_uv(const Surface& surface, const Segmentation& segmentation,
                                         const std::vector<std::vector<Index>>& triangles,
                                         std::span<const Point_2> uv)
{
  std::vector<Chart> charts;
  std::vector<Index> local(surface.number_of_triangles());
  for (const std::vector<Index>& list : triangles) {
    Chart chart = extract_chart(surface, segmentation, list, local);
    chart.uv.resize(chart.number_of_vertices());
    for (std::size_t t = 0; t < list.size(); ++t)
      for (Index i = 0; i < 3; ++i)
        chart.uv[chart.triangles[t][i]] = uv[surface.corner[3 * list[t] + i]];
    charts.push_back(std::move(chart));
  }
  return charts;
}

} // namespace internal

ATLAS_INLINE Repacked_charts pack_charts(const Surface& surface, std::span<const Point_2> uv,
                                         const Page_options& options, const Any_packer& packer,
                                         const Execution& execution)
{
  check(options);
  internal::require(uv.size() >= surface.number_of_corners, "uv", "must have a point for each corner");
  Repacked_charts result;
  result.uv.assign(uv.begin(), uv.end());
  result.page.assign(uv.size(), 0);
  result.segmentation = charts_of_uv(surface, uv);
  const std::vector<std::vector<Index>> triangles = internal::triangles_in_charts(result.segmentation);
  result.charts = internal::charts_with_uv(surface, result.segmentation, triangles, uv);
  Page_options page = options;
  if (page.weights.empty() && !surface.density_weight.empty())
    for (const Chart& chart : result.charts)
      page.weights.push_back(internal::mean_weight(surface, chart));
  result.packing = packer.pack(result.charts, page, execution);
  if (result.packing.number_of_pages == 0)
    return result;
  for (std::size_t c = 0; c < triangles.size(); ++c) {
    const Placement& placement = result.packing.placements[c];
    for (const Index t : triangles[c])
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        const Point_2 texel = placement(uv[surface.corner[h]]);
        result.uv[surface.corner[h]] = Point_2(texel.x() / page.width, texel.y() / page.height);
        result.page[surface.corner[h]] = placement.page;
      }
  }
  return result;
}

} // namespace Atlas

#endif
