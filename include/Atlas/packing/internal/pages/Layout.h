// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_LAYOUT_H
#define ATLAS_PACKING_INTERNAL_PAGES_LAYOUT_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Packing.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/chart_clearance.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace Atlas::internal {

/// Where each outline of a set is, at one scale.
struct Layout
{
  double scale = 0;
  double margin = 0; ///< what every chart was grown by
  std::vector<Vec2> turns, positions;
};

/// The outlines of charts that stay where they are on a page, in texels.
struct Obstacles
{
  std::vector<Outline> outlines;

  bool is_empty() const { return outlines.empty(); }

  void add(const Chart& chart, const Placement& placement)
  {
    Chart placed;
    placed.triangles = chart.triangles;
    for (const Point_2& p : chart.uv)
      placed.uv.push_back(placement(p));
    Outline outline;
    outline.centre = extent_of(placed).centre;
    outline.rotation = Chart_rotation::none;
    build_outline(placed, 1, outline);
    if (!outline.is_empty())
      outlines.push_back(std::move(outline));
  }

  double area() const
  {
    return std::accumulate(outlines.begin(), outlines.end(), 0.0,
                           [](double sum, const Outline& o) { return sum + o.area; });
  }
};

/// Two charts of a page that are nearer than this, in texels, meet.
inline constexpr double no_distance = 1e-150;

/// Whether outlines keep twice the margin from each other and from obstacles, and the margin from the border
/// of the page. With a margin of 0, whether they do not meet. Obstacles are not checked against each other.
inline bool keeps_margin(const Outlines& outlines, const Layout& layout, double margin,
                         const Obstacles& obstacles, double width, double height)
{
  std::vector<Placed_outline> placed;
  const auto place = [&](const Outline& outline, Vec2 r, Vec2 position) {
    placed.push_back({&outline, {}});
    for (const Vec2& p : outline.points)
      placed.back().points.push_back(position + rotated(r, p));
  };
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (outlines.charts[i].is_empty())
      continue;
    place(outlines.charts[i], layout.scale * layout.turns[i], layout.positions[i]);
    for (const Vec2& p : placed.back().points)
      if (!(std::min({p.x, p.y, width - p.x, height - p.y}) >= margin))
        return false;
  }
  const std::size_t movable = placed.size();
  for (const Outline& outline : obstacles.outlines)
    place(outline, {1, 0}, outline.centre);
  bool is_kept = true;
  Chart_clearance(placed, std::max(2 * margin, no_distance)).search([&](Index i, Index j, double) {
    is_kept = i >= movable && j >= movable;
    return is_kept;
  });
  return is_kept;
}

} // namespace Atlas::internal

#endif
