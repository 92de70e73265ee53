// SPDX-License-Identifier: MIT
// Before the guard: where there is no library, that header includes its definitions, and they need all of
// this one.
#include <Atlas/segmentation/smooth_borders.h>

#ifndef ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_SEGMENTATION_SMOOTHER_H
#define ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_SEGMENTATION_SMOOTHER_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/internal/smoothing/Border_smoother.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The border between two charts: halfedges on the side of the first one.
struct Chart_border
{
  std::array<Index, 2> pair;
  std::vector<Index> halfedges;
};

/// The borders between neighbouring charts, those with the most edges first.
inline std::vector<Chart_border> borders_of_charts(const Surface& surface, const Segmentation& segmentation,
                                                   const Smoothing_limits& limits)
{
  std::vector<std::array<Index, 3>> edges; // chart, chart, halfedge
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (limits.is_open[h])
      if (const Index a = segmentation.chart[h / 3], b = segmentation.chart[surface.opposite[h] / 3]; a < b)
        edges.push_back({a, b, h});
  std::sort(edges.begin(), edges.end());
  std::vector<Chart_border> borders;
  for (const auto& [a, b, h] : edges) {
    if (borders.empty() || borders.back().pair != std::array{a, b})
      borders.push_back({{a, b}, {}});
    borders.back().halfedges.push_back(h);
  }
  std::stable_sort(borders.begin(), borders.end(), [](const Chart_border& a, const Chart_border& b) {
    return a.halfedges.size() > b.halfedges.size();
  });
  return borders;
}

/// Takes as many borders out of the list as can be worked on at once, in order.
inline std::vector<Chart_border> take_independent(std::vector<Chart_border>& borders, Index number_of_charts)
{
  std::vector<std::uint8_t> is_busy(number_of_charts, 0);
  std::vector<Chart_border> taken, left;
  for (Chart_border& border : borders) {
    const bool is_free = !is_busy[border.pair[0]] && !is_busy[border.pair[1]];
    is_busy[border.pair[0]] |= is_free;
    is_busy[border.pair[1]] |= is_free;
    (is_free ? taken : left).push_back(std::move(border));
  }
  borders.swap(left);
  return taken;
}

/// Clears the marks of cuts between different charts; triangles at a cut inside a chart stay where they are,
/// or the cut would lose its end.
inline Smoothing_limits smoothing_limits(const Surface& surface, Segmentation& segmentation)
{
  std::vector<std::uint8_t> is_at_cut(surface.points.size(), 0);
  Smoothing_limits limits;
  limits.is_open.resize(surface.opposite.size());
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    if (o == no_index)
      continue;
    if (segmentation.chart[h / 3] != segmentation.chart[o / 3])
      segmentation.cut[h] = 0;
    else if (segmentation.cut[h])
      is_at_cut[surface.triangles[h / 3][h % 3]] = is_at_cut[surface.triangles[h / 3][next_halfedge(h) % 3]] =
          1;
    limits.is_open[h] = !segmentation.cut[h] && may_cross(surface, h);
  }
  for (const auto& [a, b, c] : surface.triangles)
    limits.is_stuck.push_back(is_at_cut[a] || is_at_cut[b] || is_at_cut[c]);
  return limits;
}

/// \brief Moves the borders of a segmentation, each once a round.
class Segmentation_smoother
{
public:
  Segmentation_smoother(const Surface& surface, Segmentation& segmentation, const Smoothing_limits& limits,
                        const Smoothing_options& options)
      : surface_(surface), segmentation_(segmentation), limits_(limits),
        costs_(surface, options.sharp_angle, options.sharp_discount), scratch_(surface.number_of_triangles()),
        sizes_(segmentation.number_of_charts, 0)
  {
    for (const Index c : segmentation.chart)
      ++sizes_[c];
  }

  /// Decides on two charts as they would be, and has their numbers. Called from several threads, but never
  /// for one chart at a time.
  using Filter = std::function<bool(const std::array<Chart, 2>&, const std::array<Index, 2>&)>;

  /// Returns how many borders moved. An empty `keep` keeps every change.
  std::size_t run_round(int rings, const Execution& execution, const Filter& keep)
  {
    std::size_t moved = 0, work = work_per_triangle * surface_.number_of_triangles();
    std::vector<Chart_border> borders = borders_of_charts(surface_, segmentation_, limits_);
    while (!borders.empty() && execution.proceed()) {
      std::vector<Chart_border> batch = take_independent(borders, segmentation_.number_of_charts);
      std::erase_if(batch, [&](const Chart_border& border) {
        const std::size_t needed = sizes_[border.pair[0]] + sizes_[border.pair[1]];
        work -= std::min(work, needed);
        return work == 0;
      });
      const std::vector<std::vector<Index>> changes = try_changes(batch, rings, execution, keep);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        moved += !changes[i].empty();
        change_sides(batch[i].pair, changes[i]);
      }
    }
    return moved;
  }

private:
  /// A border costs the triangles of both its charts; all borders of a round together may cost so many times
  /// those of the surface.
  static constexpr std::size_t work_per_triangle = 64;

  /// Per border, the triangles that change sides; none where it stays.
  std::vector<std::vector<Index>> try_changes(const std::vector<Chart_border>& batch, int rings,
                                              const Execution& execution, const Filter& keep)
  {
    std::vector<std::vector<Index>> changes(batch.size());
    execution.for_each(batch.size(), [&](std::size_t i) {
      const auto [a, b] = batch[i].pair;
      Border_smoother smoother(surface_, costs_, limits_, segmentation_.chart, {a, b}, {sizes_[a], sizes_[b]},
                               scratch_, stamp_ + static_cast<Index>(2 * i));
      if (smoother.run(batch[i].halfedges, rings) &&
          (!keep || keep({smoother.chart(0), smoother.chart(1)}, batch[i].pair)))
        changes[i] = smoother.changed();
    });
    stamp_ += static_cast<Index>(2 * batch.size());
    return changes;
  }

  void change_sides(const std::array<Index, 2>& pair, const std::vector<Index>& triangles)
  {
    for (const Index t : triangles) {
      Index& chart = segmentation_.chart[t];
      --sizes_[chart];
      chart = pair[chart == pair[0]];
      ++sizes_[chart];
    }
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  const Smoothing_limits& limits_;
  Seam_costs costs_;
  Smoothing_scratch scratch_;
  std::vector<std::size_t> sizes_; ///< per chart: its triangles
  Index stamp_ = 1;
};

} // namespace Atlas::internal

#endif
