// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PACK_PAGES_H
#define ATLAS_PACKING_INTERNAL_PACK_PAGES_H

#include <Atlas/Chart.h>
#include <Atlas/Execution.h>
#include <Atlas/Packing.h>
#include <Atlas/packing/internal/Outline.h>
#include <Atlas/packing/internal/horizon_layout.h>
#include <Atlas/packing/internal/obstacle_layout.h>
#include <Atlas/packing/internal/packing_pieces.h>
#include <Atlas/packing/internal/scale_search.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The outlines with the given numbers, in the unit of all.
inline Outlines subset(const Outlines& outlines, std::span<const Index> numbers)
{
  Outlines result;
  result.unit = outlines.unit;
  for (const Index i : numbers) {
    result.charts.push_back(outlines.charts[i]);
    result.area += outlines.charts[i].area;
  }
  return result;
}

/// A page that has been filled.
struct Filled_page
{
  std::vector<Index> pieces;
  Layout layout;
};

/// The outlines by decreasing radius: what is hard to place first.
inline std::vector<Index> by_size(const Outlines& outlines)
{
  std::vector<Index> order(outlines.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](Index i, Index j) { return outlines.charts[i].radius > outlines.charts[j].radius; });
  return order;
}

inline bool is_obstructed(const std::vector<Obstacles>& obstacles, std::size_t page)
{
  return page < obstacles.size() && !obstacles[page].outlines.empty();
}

/// Fills pages one after the other at a given scale. A page gets pieces, the largest that are left first, as
/// long as they fill less than a share of it, which is lowered until the page has room for them all.
///
/// A piece that is alone on a page and does not fit lowers the scale: then nothing is returned, and `scale`
/// is what would do.
/// A page on which obstacles leave no room for the largest piece stays as it is.
template <typename Engine>
std::optional<std::vector<Filled_page>>
fill_pages(const Outlines& outlines, const std::vector<Obstacles>& obstacles, const Page_options& page,
           double& scale, Engine engine, const Execution& execution)
{
  std::vector<Index> left = by_size(outlines);
  std::vector<Filled_page> pages;
  const double texels = double(page.width) * page.height, gutter = page.gutter;
  const auto room = [&](Index i) {
    const Outline& outline = outlines.charts[i];
    return scale * scale * outline.area + gutter * (2 * scale * outline.radius + gutter);
  };
  while (!left.empty() && execution.proceed(1 - double(left.size()) / static_cast<double>(outlines.size()))) {
    for (double share = 0.95;; share *= 0.93) {
      Filled_page filled;
      std::vector<Index> others;
      double used = 0;
      for (const Index i : left) {
        const bool is_in = filled.pieces.empty() || used + room(i) <= share * texels;
        (is_in ? filled.pieces : others).push_back(i);
        used += is_in ? room(i) : 0;
      }
      const bool has_obstacles = is_obstructed(obstacles, pages.size());
      const Outlines part = subset(outlines, filled.pieces);
      std::optional<Layout> layout =
          has_obstacles ? obstacle_layout(part, obstacles[pages.size()], page, scale, execution)
                        : engine(part, page, scale, execution);
      const bool is_alone = filled.pieces.size() == 1;
      const bool fits = layout && layout->scale >= scale && (is_alone || layout->margin >= gutter / 2) &&
                        !(has_obstacles && layout->margin < gutter / 2);
      if (!fits && !is_alone)
        continue;
      if (!fits && has_obstacles) {
        pages.emplace_back();
        break;
      }
      if (!fits) {
        scale = layout && layout->scale < scale ? layout->scale : scale / 2;
        return std::nullopt;
      }
      filled.layout = std::move(*layout);
      pages.push_back(std::move(filled));
      left = std::move(others);
      break;
    }
  }
  return pages;
}

/// Spreads pieces over a number of pages evenly by area, and gives all the scale of the fullest page.
template <typename Engine>
std::optional<std::vector<Filled_page>>
spread_over_pages(const Outlines& outlines, const std::vector<Obstacles>& obstacles, const Page_options& page,
                  Engine engine, const Execution& execution)
{
  const std::size_t n = std::max({std::size_t(1), std::min<std::size_t>(page.pages, outlines.size()),
                                  std::min<std::size_t>(page.pages, obstacles.size())});
  std::vector<Filled_page> pages(n);
  std::vector<std::pair<double, double>> used(n); // area, radii for pieces without area
  // Obstacles count as what the pieces are likely to be there.
  double taken = 0;
  for (std::size_t k = 0; k < n && k < obstacles.size(); ++k)
    taken += used[k].first = obstacles[k].area();
  const double room = double(page.width) * page.height * static_cast<double>(n);
  for (auto& entry : used)
    entry.first *= outlines.area / std::max(room - taken, 0.01 * room);
  for (const Index i : by_size(outlines)) {
    const std::size_t k = static_cast<std::size_t>(std::min_element(used.begin(), used.end()) - used.begin());
    pages[k].pieces.push_back(i);
    used[k].first += outlines.charts[i].area;
    used[k].second += outlines.charts[i].radius + 1e-9;
  }
  for (Filled_page& filled : pages)
    std::sort(filled.pieces.begin(), filled.pieces.end());
  double scale = HUGE_VAL;
  for (int attempt = 0; attempt < 60; ++attempt) {
    bool is_even = true;
    for (Filled_page& filled : pages) {
      if (attempt > 0 && filled.layout.scale == scale)
        continue;
      is_even = false;
      const Outlines part = subset(outlines, filled.pieces);
      // A search that is to stop at a scale may stay below it by chance: the others follow.
      const auto number = static_cast<std::size_t>(&filled - pages.data());
      std::optional<Layout> layout =
          is_obstructed(obstacles, number) ? obstacle_layout(part, obstacles[number], page, scale, execution)
          : attempt < 4                    ? engine(part, page, scale, execution)
                        : horizon_layout(part, page, Horizon_source::outline, scale, execution);
      if (!layout)
        return std::nullopt;
      filled.layout = std::move(*layout);
    }
    if (is_even)
      return pages;
    for (const Filled_page& filled : pages)
      scale = std::min(scale, filled.layout.scale);
    if (n == 1)
      return pages;
  }
  return std::nullopt;
}

/// The locked charts of each page, up to the last that has some; `others` are the charts without those. None
/// and empty if there are none.
inline std::vector<Obstacles> set_apart(std::span<const Chart> charts, const Page_options& options,
                                        std::vector<Chart>& others)
{
  std::vector<Obstacles> obstacles;
  for (std::size_t i = 0; i < charts.size() && i < options.locked.size(); ++i) {
    if (!options.locked[i])
      continue;
    if (others.empty())
      others.assign(charts.begin(), charts.end());
    others[i] = {};
    const std::size_t page = options.locked[i]->page;
    obstacles.resize(std::max(obstacles.size(), page + 1));
    obstacles[page].add(charts[i], *options.locked[i]);
  }
  return obstacles;
}

/// What all packers have in common: pieces made of charts, pages, and the way back.
///
/// `engine(outlines, page, most_scale, execution)` lays pieces out on one page at the largest scale it finds,
/// at most `most_scale`.
template <typename Engine>
Packing pack_pages(std::span<const Chart> charts, const Page_options& options, Engine engine,
                   const Execution& execution)
{
  Page_options page = options;
  page.gutter = options.effective_gutter();
  std::vector<Chart> free_charts;
  const std::vector<Obstacles> obstacles = set_apart(charts, options, free_charts);
  const Packing_pieces pieces(free_charts.empty() ? charts : free_charts, options, execution);
  const Outlines outlines = outlines_of(pieces.charts(), execution);
  Packing packing;
  packing.placements.resize(charts.size());
  if (charts.empty() || page.width == 0 || page.height == 0)
    return packing;

  std::optional<std::vector<Filled_page>> pages;
  if (options.density > 0) {
    double scale = options.density / outlines.unit;
    for (int attempt = 0; attempt < 100 && !pages && !execution.is_cancelled(); ++attempt)
      pages = fill_pages(outlines, obstacles, page, scale, engine, execution);
  } else {
    pages = spread_over_pages(outlines, obstacles, page, engine, execution);
  }
  if (!pages)
    return packing;
  std::vector<Placement> placements(outlines.size());
  packing.gutter = page.gutter;
  for (Index k = 0; k < pages->size(); ++k) {
    const auto& [numbers, layout] = (*pages)[k];
    if (numbers.empty())
      continue;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      placements[numbers[i]] =
          outlines.placement(numbers[i], layout.scale, layout.turns[i], layout.positions[i], k);
    packing.density = layout.scale * outlines.unit;
    packing.gutter = std::min(packing.gutter, 2 * std::max(0.0, layout.margin - rounding_margin(page)));
  }
  packing.number_of_pages = static_cast<Index>(std::max(pages->size(), obstacles.size()));
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const bool is_locked = i < options.locked.size() && options.locked[i];
    packing.placements[i] = is_locked ? *options.locked[i] : pieces.placement(i, placements);
  }
  return packing;
}

} // namespace Atlas::internal

#endif
