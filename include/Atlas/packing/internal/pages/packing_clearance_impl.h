// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PACKING_CLEARANCE_IMPL_H
#define ATLAS_PACKING_INTERNAL_PAGES_PACKING_CLEARANCE_IMPL_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/errors.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/chart_clearance.h>
#include <Atlas/packing/pack_charts.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace Atlas {

ATLAS_INLINE Packing_clearance packing_clearance(std::span<const Chart> charts, const Packing& packing,
                                                 const Page_options& page, double limit)
{
  using internal::Vec2;
  internal::require(packing.placements.size() == charts.size(), "packing",
                    "must have a placement for each chart");
  const internal::Outlines outlines = internal::outlines_of(charts, Execution(1));
  const double size[2] = {static_cast<double>(page.width), static_cast<double>(page.height)};
  const auto stored = [](double texel, double n) {
    return static_cast<double>(static_cast<float>(texel / n)) * n;
  };
  Packing_clearance result{limit, std::max(size[0], size[1])};
  std::map<Index, std::vector<internal::Placed_outline>> pages;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Placement& placement = packing.placements[i];
    const internal::Outline& outline = outlines.charts[i];
    internal::Placed_outline placed{&outline, {}};
    for (const Index v : outline.vertices) {
      const Point_2 t = placement(charts[i].uv[v]);
      const Vec2 r{stored(t.x(), size[0]), stored(t.y(), size[1])};
      result.border = std::min({result.border, r.x, r.y, size[0] - r.x, size[1] - r.y});
      placed.points.push_back(r);
    }
    if (!outline.is_empty())
      pages[placement.page].push_back(std::move(placed));
  }
  for (const auto& [page_number, placed] : pages)
    internal::Chart_clearance(placed, limit).search([&](Index, Index, double distance) {
      result.charts = std::min(result.charts, distance);
      return result.charts > 0;
    });
  return result;
}

} // namespace Atlas

#endif
