// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_PACKING_CLEARANCE_H
#define ATLAS_PACKING_PACKING_CLEARANCE_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Packing.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/chart_clearance.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace Atlas {

/// \brief How far apart the charts of a packing are.
struct Packing_clearance
{
  double charts = 0; ///< least distance of two charts of a page in texels, 0 if they meet; at most `limit`
  double border = 0; ///< least distance of a chart from the border of its page, in texels; negative outside
};

/// \brief Measures the distance between charts on the coordinates as they are stored: placed, divided by the
/// size of the page, and rounded to single precision.
///
/// Distances are those between the segments that bound the charts; that two charts meet is decided by exact
/// predicates. A chart inside the hole of another is apart from it, one inside its interior is not.
/// Near-linear in the segments.
///
/// \param limit larger distances between charts are not looked for, in texels
inline Packing_clearance packing_clearance(std::span<const Chart> charts, const Packing& packing,
                                           const Page_options& page, double limit)
{
  using internal::Vec2;
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
