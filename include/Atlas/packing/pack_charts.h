// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_PACK_CHARTS_H
#define ATLAS_PACKING_PACK_CHARTS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/charts_of_uv.h>
#include <Atlas/core/concepts.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/mean_weight.h>
#include <Atlas/packing/Raster_packer.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace Atlas {

/// \brief Coordinates that have been packed anew.
struct Repacked_charts
{
  std::vector<Point_2> uv;   ///< per input corner: in [0, 1]^2 of its page; as it was where it was not finite
  std::vector<Index> page;   ///< per input corner
  std::vector<Chart> charts; ///< in the coordinates that came in
  Segmentation segmentation; ///< which triangle is in which chart; those without coordinates in none
  Packing packing;
};

/// \brief Packs texture coordinates that came from elsewhere; the shapes of charts stay as they are.
///
/// \param uv  per corner of the input: its coordinates; not finite where there are none
///
/// Charts keep their relative sizes, but for `page.weights`, or else the weights of the surface; overlapping
/// or folded charts are packed as they are. Charts are numbered in the order of their first triangles. Where
/// there is no room at all, the packing has no page and coordinates are left alone.
template <ChartPacker Packer = Raster_packer>
Repacked_charts pack_charts(const Surface& surface, std::span<const Point_2> uv,
                            const Page_options& options = {}, const Packer& packer = Packer(),
                            const Execution& execution = Execution())
{
  Repacked_charts result;
  result.uv.assign(uv.begin(), uv.end());
  result.page.assign(uv.size(), 0);
  result.segmentation = charts_of_uv(surface, uv);
  std::vector<std::vector<Index>> triangles(result.segmentation.number_of_charts);
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    if (const Index c = result.segmentation.chart[t]; c != no_index)
      triangles[c].push_back(t);
  std::vector<Index> local(surface.number_of_triangles());
  for (const std::vector<Index>& list : triangles) {
    Chart chart = extract_chart(surface, result.segmentation, list, local);
    chart.uv.resize(chart.number_of_vertices());
    for (std::size_t t = 0; t < list.size(); ++t)
      for (Index i = 0; i < 3; ++i)
        chart.uv[chart.triangles[t][i]] = uv[surface.corner[3 * list[t] + i]];
    result.charts.push_back(std::move(chart));
  }
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
