// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_HORIZON_HORIZON_LAYOUT_H
#define ATLAS_PACKING_INTERNAL_HORIZON_HORIZON_LAYOUT_H

#include <Atlas/packing/internal/horizon/horizon.h>
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/packing/internal/pages/scale_search.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/planar/internal/convex_hull.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// What the horizon of a chart is taken from, and where it goes.
enum class Horizon_source {
  outline,   ///< the chart, on the horizon of the page
  rectangle, ///< its least rectangle, on the horizon of the page
  rows       ///< its least rectangle, in rows
};

/// Puts the shapes on one page in the given order: per shape the lower left corner; nothing if there is no
/// room. \tparam Page  `Horizon_page` or `Row_page`
template <typename Page>
std::optional<std::vector<Vec2>> corners_on(Page page, const std::vector<Horizon_shape>& shapes,
                                            const std::vector<Index>& order, const Execution& execution)
{
  std::vector<Vec2> corners(shapes.size());
  for (const Index i : order) {
    const std::optional<Vec2> corner = page.insert(shapes[i]);
    if (!corner || execution.is_cancelled())
      return std::nullopt;
    corners[i] = *corner;
  }
  return corners;
}

/// The turn that puts `direction` upright, as far as it may be turned.
inline Vec2 upright(Vec2 direction, Chart_rotation rotation)
{
  const double l = length(direction);
  if (rotation == Chart_rotation::none || !(l > 0))
    return {1, 0};
  if (rotation == Chart_rotation::quarter_turns)
    return std::abs(direction.x) > std::abs(direction.y) ? Vec2{0, 1} : Vec2{1, 0};
  return (1 / l) * Vec2{direction.y, direction.x};
}

/// Per chart the turn that stands it upright: by its diameter, or by the longer side of its least rectangle.
inline std::vector<Vec2> upright_turns(const Outlines& outlines, Horizon_source source)
{
  std::vector<Vec2> turns(outlines.size(), Vec2{1, 0});
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const std::vector<Vec2> hull = convex_hull(outlines.charts[i].points);
    if (source == Horizon_source::outline) {
      turns[i] = upright(diameter(hull), outlines.charts[i].rotation);
      continue;
    }
    Vec2 e = least_rectangle_direction(hull);
    const auto extent = [&](Vec2 direction) {
      double low = 0, high = 0;
      for (const Vec2& p : hull) {
        low = std::min(low, dot(direction, p));
        high = std::max(high, dot(direction, p));
      }
      return high - low;
    };
    const Vec2 across{-e.y, e.x};
    turns[i] = upright(extent(e) >= extent(across) ? e : across, outlines.charts[i].rotation);
  }
  return turns;
}

/// The numbers of outlines, those that are highest after their turns first.
inline std::vector<Index> by_height(const Outlines& outlines, const std::vector<Vec2>& turns)
{
  std::vector<double> heights(outlines.size(), 0.0);
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    double low = 0, high = 0;
    for (const Vec2& p : outlines.charts[i].points) {
      low = std::min(low, rotated(turns[i], p).y);
      high = std::max(high, rotated(turns[i], p).y);
    }
    heights[i] = high - low;
  }
  std::vector<Index> order(outlines.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return heights[i] > heights[j]; });
  return order;
}

/// The layout of the paper's section 4 at the largest scale that fits the page, at most the one wanted;
/// nothing if even points without a gutter do not. Obstacles are not looked at.
inline std::optional<Layout> horizon_layout(const Outlines& outlines, const Page_task& page,
                                            Horizon_source source, const Execution& execution)
{
  const std::vector<Vec2> turns = upright_turns(outlines, source);
  std::vector<Index> order = by_height(outlines, turns);
  std::erase_if(order, [&](Index i) { return outlines.charts[i].is_empty(); });
  std::vector<Horizon_shape> shapes(outlines.size());
  const auto attempt = [&](double scale, double margin) -> std::optional<Layout> {
    Layout layout{scale, margin, turns, std::vector<Vec2>(outlines.size())};
    execution.for_each(outlines.size(), [&](std::size_t i) {
      if (outlines.charts[i].is_empty())
        return;
      shapes[i] = horizon_shape(outlines.charts[i], turns[i], scale, margin);
      if (source != Horizon_source::outline)
        flatten_horizons(shapes[i]);
    });
    const auto corners = source == Horizon_source::rows
                             ? corners_on(Row_page(page.width, page.height), shapes, order, execution)
                             : corners_on(Horizon_page(page.width, page.height), shapes, order, execution);
    for (std::size_t i = 0; corners && i < outlines.size(); ++i)
      layout.positions[i] = (*corners)[i] + shapes[i].origin;
    return corners ? std::optional(std::move(layout)) : std::nullopt;
  };
  // Thousands of charts on a large page are not worth ten attempts.
  const double precision = double(outlines.size()) * page.width > 1e7 ? 5e-3 : 1e-3;
  return search_scale(outlines, page, precision, attempt);
}

} // namespace Atlas::internal

#endif
