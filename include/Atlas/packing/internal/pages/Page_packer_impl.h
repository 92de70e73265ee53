// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PAGE_PACKER_IMPL_H
#define ATLAS_PACKING_INTERNAL_PAGES_PAGE_PACKER_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/pages/Page_filler.h>
#include <Atlas/packing/internal/pages/packing_pieces.h>
#include <Atlas/packing/internal/pages/snap_to_texels.h>
#include <Atlas/packing/internal/shapes/chart_poses.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// What the error may be in the length and the angle of turns.
inline constexpr double turn_tolerance = 1e-9;

/// Whether a turn is one, and allowed.
inline bool is_turn(std::complex<double> turn, Chart_rotation rotation)
{
  if (!(std::abs(std::abs(turn) - 1) <= turn_tolerance))
    return false;
  switch (rotation) {
  case Chart_rotation::aligned:
  case Chart_rotation::free:
  case Chart_rotation::any:
    return true;
  case Chart_rotation::quarter_turns:
    return std::min(std::abs(turn.real()), std::abs(turn.imag())) <= turn_tolerance;
  case Chart_rotation::none:
    return std::abs(turn - 1.0) <= turn_tolerance;
  }
  return false;
}

inline bool is_finite_number(std::complex<double> z)
{
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

/// Throws unless the outlines of a page keep the margin of its layout, but for half of what coordinates may
/// lose by rounding: engines round too.
inline void check_margin(const Any_page_engine& engine, const Outlines& part, const Layout& layout,
                         const Obstacles& obstacles, const Page_options& page)
{
  const double margin = std::max(0.0, layout.margin - rounding_margin(page.width, page.height) / 2);
  if (!keeps_margin(part, layout, margin, obstacles, page.width, page.height))
    throw Policy_error("page engine", engine.type_name(),
                       "does not keep its margin of " + std::to_string(layout.margin) +
                           " texels on each side of every piece");
}

/// The locked charts by pages; `others` are the charts without those. Both are empty if there are none.
inline Obstacles_of_pages set_apart(std::span<const Chart> charts, const Page_options& options,
                                    std::vector<Chart>& others)
{
  Obstacles_of_pages obstacles;
  for (std::size_t i = 0; i < options.locked.size(); ++i) {
    if (!options.locked[i])
      continue;
    if (others.empty())
      others.assign(charts.begin(), charts.end());
    others[i] = {};
    obstacles[options.locked[i]->page].add(charts[i], *options.locked[i]);
  }
  return obstacles;
}

/// The placements of all pieces on filled pages; and what that says about the packing.
inline std::vector<Placement> placements_of(const Outlines& outlines, const std::vector<Filled_page>& pages,
                                            const Page_options& page, Packing& packing)
{
  std::vector<Placement> placements(outlines.size());
  std::vector<bool> is_placed(outlines.size(), false);
  for (Index k = 0; k < pages.size(); ++k) {
    const auto& [numbers, layout] = pages[k];
    if (numbers.empty())
      continue;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      placements[numbers[i]] =
          outlines.placement(numbers[i], layout.scale, layout.turns[i], layout.positions[i], k);
      is_placed[numbers[i]] = true;
    }
    packing.density = layout.scale * outlines.unit;
    packing.gutter =
        std::min(packing.gutter, 2 * std::max(0.0, layout.margin - rounding_margin(page.width, page.height)));
    packing.number_of_pages = std::max(packing.number_of_pages, k + 1);
  }
  for (std::size_t i = 0; i < outlines.size(); ++i)
    if (!is_placed[i]) // charts without triangles are nowhere, but have the density of all
      placements[i] = outlines.placement(i, packing.density / outlines.unit, {1, 0}, {});
  return placements;
}

/// Checks that the engine kept the margins of the pages.
inline void check_margins(const Any_page_engine& engine, const Outlines& outlines,
                          const Obstacles_of_pages& obstacles, const std::vector<Filled_page>& pages,
                          const Page_options& page)
{
  for (Index k = 0; k < pages.size(); ++k) {
    const auto locked = obstacles.find(k);
    if (!pages[k].pieces.empty())
      check_margin(engine, subset(outlines, pages[k].pieces), pages[k].layout,
                   locked == obstacles.end() ? Obstacles() : locked->second, page);
  }
}

/// Pieces in their poses, and the pages they fill; none if there is no room.
struct Filled_pages
{
  Outlines outlines;
  std::optional<std::vector<Filled_page>> pages;
};

/// How much fuller the first pages are, as a factor.
inline double gain(const Filled_pages& a, const Filled_pages& b)
{
  if (!a.pages || !b.pages)
    return a.pages ? HUGE_VAL : 0;
  const auto scale = [](const Filled_pages& filled) {
    double least = HUGE_VAL;
    for (const Filled_page& page : *filled.pages)
      if (!page.pieces.empty())
        least = std::min(least, page.layout.scale);
    return least;
  };
  const double ratio = scale(a) / scale(b);
  return ratio * ratio * double(b.pages->size()) / double(a.pages->size());
}

/// Gives up alignment of charts only if pages are fuller by this factor then.
inline constexpr double least_gain_of_free_rotation = 1.02;

/// Puts pieces on pages, aligned with them as `page` says.
inline Filled_pages fill_pages(std::span<const Chart> pieces, const Obstacles_of_pages& obstacles,
                               const Page_options& page, const Any_page_engine& engine,
                               const Execution& execution)
{
  const auto fill = [&](Outlines outlines) {
    const Page_filler filler(outlines, obstacles, page, engine, execution);
    auto pages = page.density > 0 ? filler.fill(page.density / outlines.unit) : filler.spread();
    return Filled_pages{std::move(outlines), std::move(pages)};
  };
  const Outlines plain = outlines_of(pieces, execution);
  Outlines outlines = plain;
  const bool is_any_aligned = take_poses(outlines, pieces, page, execution);
  Filled_pages result = fill(std::move(outlines));
  if (page.rotation == Chart_rotation::any && is_any_aligned)
    if (Filled_pages other = fill(free_again(plain, result.outlines));
        gain(other, result) >= least_gain_of_free_rotation)
      result = std::move(other);
  return result;
}

} // namespace internal

ATLAS_INLINE std::optional<Page_layout> Any_page_engine::lay_out(const Page_task& task,
                                                                 const Execution& execution) const
{
  std::optional<Page_layout> layout = policy().lay_out(task, execution);
  if (!layout)
    return layout;
  const auto fail = [&](const std::string& fault) { throw Policy_error("page engine", type_name(), fault); };
  const std::size_t n = task.pieces.size();
  if (layout->turns.size() != n || layout->positions.size() != n)
    fail("returned " + std::to_string(layout->turns.size()) + " turns and " +
         std::to_string(layout->positions.size()) + " positions for " + std::to_string(n) + " pieces");
  if (!(layout->scale > 0 && std::isfinite(layout->scale)))
    fail("returned a scale of " + std::to_string(layout->scale));
  if (layout->scale > task.most_scale)
    fail("returned a scale of " + std::to_string(layout->scale) + ", above the one wanted, " +
         std::to_string(task.most_scale));
  if (!(layout->margin >= 0 && std::isfinite(layout->margin)))
    fail("returned a margin of " + std::to_string(layout->margin));
  for (std::size_t i = 0; i < n; ++i) {
    if (!internal::is_turn(layout->turns[i], task.pieces[i].rotation))
      fail("turned piece " + std::to_string(i) + " by what is no turn, or not allowed");
    if (!internal::is_finite_number(layout->positions[i]))
      fail("put piece " + std::to_string(i) + " where coordinates are not finite");
  }
  return layout;
}

ATLAS_INLINE bool Any_page_engine::heeds_obstacles() const
{
  return policy().heeds_obstacles();
}

ATLAS_INLINE Packing Page_packer::pack(std::span<const Chart> charts, const Page_options& options,
                                       const Execution& execution) const
{
  using namespace internal;
  check(options, charts.size());
  Page_options page = options;
  page.gutter = options.effective_gutter();
  std::vector<Chart> free_charts;
  const Obstacles_of_pages obstacles = set_apart(charts, options, free_charts);
  const Packing_pieces pieces(free_charts.empty() ? charts : free_charts, options, execution);
  Packing packing;
  packing.placements.resize(charts.size());
  if (charts.empty())
    return packing;

  const auto [outlines, pages] = fill_pages(pieces.charts(), obstacles, page, engine_, execution);
  if (!pages)
    return packing;
  if (!execution.is_cancelled())
    check_margins(engine_, outlines, obstacles, *pages, page);
  packing.gutter = page.gutter;
  packing.density = options.density > 0 ? options.density : 1; // if there is nothing to pack
  packing.number_of_pages = obstacles.empty() ? 1 : obstacles.rbegin()->first + 1;
  std::vector<Placement> placements = placements_of(outlines, *pages, page, packing);
  if (options.snaps && packing.gutter >= snap_allowance) {
    execution.for_each(placements.size(),
                       [&](std::size_t i) { placements[i] = snapped(pieces.charts()[i], placements[i]); });
    packing.gutter = std::max(0.0, packing.gutter - snap_allowance);
  }
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const bool is_locked = !options.locked.empty() && options.locked[i];
    packing.placements[i] = is_locked ? *options.locked[i] : pieces.placement(i, placements);
  }
  if (options.stacking != Chart_stacking::none)
    for (std::size_t i = 0; i < charts.size(); ++i)
      packing.layers.push_back(pieces.layer(i));
  return packing;
}

} // namespace Atlas

#endif
