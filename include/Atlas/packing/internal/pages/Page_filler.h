// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PAGE_FILLER_H
#define ATLAS_PACKING_INTERNAL_PAGES_PAGE_FILLER_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/horizon/horizon_layout.h>
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/packing/internal/pages/obstacle_layout.h>
#include <Atlas/packing/internal/pages/page_task.h>
#include <Atlas/packing/internal/pages/scale_search.h>
#include <Atlas/packing/internal/shapes/Outline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
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

/// The outlines that are not empty by decreasing radius: what is hard to place first.
inline std::vector<Index> by_size(const Outlines& outlines)
{
  std::vector<Index> order;
  for (Index i = 0; i < outlines.size(); ++i)
    if (!outlines.charts[i].is_empty())
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index i, Index j) { return outlines.charts[i].radius > outlines.charts[j].radius; });
  return order;
}

/// The locked charts of the pages that have some.
using Obstacles_of_pages = std::map<Index, Obstacles>;

/// A page that has been filled.
struct Filled_page
{
  std::vector<Index> pieces;
  Layout layout;
};

/// Puts outlines on pages, each page by an engine; pages with obstacles by `obstacle_layout()` if the engine
/// does not heed them.
class Page_filler
{
public:
  Page_filler(const Outlines& outlines, const Obstacles_of_pages& obstacles, const Page_options& page,
              const Any_page_engine& engine, const Execution& execution)
      : outlines_(outlines), obstacles_(obstacles), page_(page), engine_(engine), execution_(execution)
  {}

  /// At a given scale, on as many pages as that takes; at a smaller one if a piece is larger than a page.
  std::optional<std::vector<Filled_page>> fill(double scale) const
  {
    std::optional<std::vector<Filled_page>> pages;
    lower_to_largest_piece(scale);
    for (int attempt = 0; attempt < 100 && !pages && !execution_.is_cancelled(); ++attempt)
      pages = fill_at(scale);
    return pages;
  }

  /// Spreads pieces over pages evenly by area, and gives all the scale of the fullest page.
  std::optional<std::vector<Filled_page>> spread() const
  {
    std::vector<Filled_page> pages = partition();
    for (std::size_t k = 0; k < pages.size(); ++k)
      if (!pages[k].pieces.empty() && !lay_out(pages, k, HUGE_VAL))
        return std::nullopt;
    for (int attempt = 0;; ++attempt) {
      double scale = HUGE_VAL;
      for (const Filled_page& filled : pages)
        if (!filled.pieces.empty())
          scale = std::min(scale, filled.layout.scale);
      bool is_even = true;
      for (std::size_t k = 0; k < pages.size(); ++k)
        if (!pages[k].pieces.empty() && pages[k].layout.scale != scale && !shrink(pages, k, scale)) {
          is_even = false;
          // A search that is to stop at a scale may stay below it by chance: the others follow.
          if (attempt >= 60 || execution_.is_cancelled() || !lay_out(pages, k, scale, attempt >= 4))
            return std::nullopt;
        }
      if (is_even)
        return pages;
    }
  }

private:
  const Obstacles* obstacles_on(std::size_t page) const
  {
    const auto it = obstacles_.find(static_cast<Index>(page));
    return it == obstacles_.end() || it->second.outlines.empty() ? nullptr : &it->second;
  }

  /// What a page asks for. The pieces and obstacles are only made for engines.
  Page_task task(double scale) const
  {
    Page_task result;
    result.width = page_.width;
    result.height = page_.height;
    result.gutter = page_.gutter;
    result.margin = page_.gutter / 2 + rounding_margin(page_.width, page_.height);
    result.most_scale = scale;
    return result;
  }

  std::optional<Layout> layout(const Outlines& part, const Obstacles* obstacles, double scale) const
  {
    Page_task page = task(scale);
    if (obstacles && !engine_.heeds_obstacles())
      return obstacle_layout(part, *obstacles, page, execution_);
    for (const Outline& outline : part.charts)
      page.pieces.push_back(page_piece(outline));
    if (obstacles)
      for (const Outline& outline : obstacles->outlines)
        page.obstacles.push_back({page_piece(outline), to_complex(outline.centre)});
    const std::optional<Page_layout> found = engine_.lay_out(page, execution_);
    return found ? std::optional(layout_of(*found)) : std::nullopt;
  }

  /// A layout that comes near to the scale without much ado.
  std::optional<Layout> simple_layout(const Outlines& part, const Obstacles* obstacles, double scale) const
  {
    return obstacles ? obstacle_layout(part, *obstacles, task(scale), execution_)
                     : horizon_layout(part, task(scale), Horizon_source::outline, execution_);
  }

  /// Lays out the pieces of a page at a scale of at most `scale`; false if there is no room at all.
  bool lay_out(std::vector<Filled_page>& pages, std::size_t k, double scale, bool is_simple = false) const
  {
    const Outlines part = subset(outlines_, pages[k].pieces);
    std::optional<Layout> found =
        is_simple ? simple_layout(part, obstacles_on(k), scale) : layout(part, obstacles_on(k), scale);
    if (found)
      pages[k].layout = std::move(*found);
    return found.has_value();
  }

  /// Shrinks the pieces of a page in their places, where they keep the gutter then.
  bool shrink(std::vector<Filled_page>& pages, std::size_t k, double scale) const
  {
    Layout smaller = pages[k].layout;
    smaller.scale = scale;
    const Obstacles* obstacles = obstacles_on(k);
    const Outlines part = subset(outlines_, pages[k].pieces);
    if (!keeps_margin(part, smaller, smaller.margin, obstacles ? *obstacles : Obstacles(), page_.width,
                      page_.height))
      return false;
    pages[k].layout = std::move(smaller);
    return true;
  }

  /// Lowers the scale until each piece that may be larger than a page has one to itself.
  void lower_to_largest_piece(double& scale) const
  {
    const double room = std::min(page_.width, page_.height) - page_.gutter;
    if (!(room > 0))
      return;
    for (const Index i : by_size(outlines_)) {
      if (2 * scale * outlines_.charts[i].radius < room || execution_.is_cancelled())
        break;
      const std::optional<Layout> alone = layout(subset(outlines_, std::span(&i, 1)), nullptr, scale);
      if (alone)
        scale = std::min(scale, alone->scale);
    }
  }

  /// What a piece takes of a page, with its gutter.
  double room_for(Index i, double scale) const
  {
    const Outline& outline = outlines_.charts[i];
    return scale * scale * outline.area + page_.gutter * (2 * scale * outline.radius + page_.gutter);
  }

  /// Moves pieces from `left`, the largest first, to the page as long as they take no more than `room`.
  std::vector<Index> take(std::vector<Index>& left, double room, double scale) const
  {
    std::vector<Index> taken, others;
    double used = 0;
    for (const Index i : left) {
      const bool is_in = taken.empty() || used + room_for(i, scale) <= room;
      (is_in ? taken : others).push_back(i);
      used += is_in ? room_for(i, scale) : 0;
    }
    left = std::move(others);
    return taken;
  }

  /// Fills pages one after the other. A page gets as many pieces as are likely to fit: first a little more
  /// than on the page before it, then as much less as the scale that was found says.
  ///
  /// A piece that is alone on a page and does not fit lowers the scale: then nothing is returned, and `scale`
  /// is what would do. A page on which obstacles leave no room for the largest piece stays as it is.
  std::optional<std::vector<Filled_page>> fill_at(double& scale) const
  {
    constexpr double first_share = 0.95, usual_share = 0.75, growth = 1.05, least_step = 0.5,
                     largest_step = 0.97;
    const double texels = double(page_.width) * page_.height;
    double likely_share = first_share;
    std::vector<Filled_page> pages;
    std::vector<Index> left = by_size(outlines_);
    const double n = static_cast<double>(left.size());
    while (!left.empty() && execution_.proceed(1 - static_cast<double>(left.size()) / n)) {
      const Obstacles* obstacles = obstacles_on(pages.size());
      double share = obstacles ? first_share : std::clamp(likely_share * growth, usual_share, first_share);
      for (;;) {
        Filled_page filled;
        std::vector<Index> others = left;
        filled.pieces = take(others, share * texels, scale);
        const bool is_alone = filled.pieces.size() == 1;
        std::optional<Layout> found = layout(subset(outlines_, filled.pieces), obstacles, scale);
        const bool fits =
            found && found->scale >= scale && (found->margin >= page_.gutter / 2 || (is_alone && !obstacles));
        if (fits) {
          if (!obstacles && !others.empty())
            likely_share = share;
          filled.layout = std::move(*found);
          pages.push_back(std::move(filled));
          left = std::move(others);
          break;
        }
        if (is_alone && !obstacles) {
          scale = found && found->scale < scale ? found->scale : scale / 2;
          return std::nullopt;
        }
        if (is_alone) {
          pages.emplace_back();
          break;
        }
        const double ratio = found ? found->scale / scale : 0;
        share *= std::clamp(ratio * ratio, least_step, largest_step);
      }
    }
    return pages;
  }

  /// Which pieces go to which page: the largest first, each to the page that is emptiest.
  std::vector<Filled_page> partition() const
  {
    const std::vector<Index> order = by_size(outlines_);
    const std::size_t wanted = order.size() + obstacles_.size();
    const std::size_t n = std::clamp<std::size_t>(page_.pages, 1, std::max<std::size_t>(1, wanted));
    std::vector<Filled_page> pages(n);
    std::vector<std::pair<double, double>> used(n); // area, radii for pieces without area
    // Obstacles count as what the pieces are likely to be there.
    double taken = 0;
    for (const auto& [k, obstacles] : obstacles_)
      if (k < n)
        taken += used[k].first = obstacles.area();
    const double room = double(page_.width) * page_.height * static_cast<double>(n);
    for (auto& entry : used)
      entry.first *= outlines_.area / std::max(room - taken, 0.01 * room);
    for (const Index i : order) {
      const auto k = std::min_element(used.begin(), used.end()) - used.begin();
      pages[k].pieces.push_back(i);
      used[k].first += outlines_.charts[i].area;
      used[k].second += outlines_.charts[i].radius + 1e-9;
    }
    for (Filled_page& filled : pages)
      std::sort(filled.pieces.begin(), filled.pieces.end());
    return pages;
  }

  const Outlines& outlines_;
  const Obstacles_of_pages& obstacles_;
  const Page_options& page_;
  const Any_page_engine& engine_;
  const Execution& execution_;
};

} // namespace Atlas::internal

#endif
