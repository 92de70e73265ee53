// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_SMOOTH_BORDERS_H
#define ATLAS_SEGMENTATION_SMOOTH_BORDERS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/segmentation/internal/smoothing/Border_smoother.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief How borders between charts are smoothed.
struct Smoothing_options
{
  /// Borders move by at most so many rings of triangles in a round.
  int rings = 4;
  /// Every border is tried once a round.
  int rounds = 2;
  /// Angle between normals, in radians, at which a seam is cheapest.
  double sharp_angle = CGAL_PI / 4;
  /// How much cheaper it is there than in flat land, in [0, 1].
  double sharp_discount = 0.75;
};

/// Accepts every change.
struct Accept_all
{
  bool operator()(const Chart&, const Chart&) const { return true; }
};

namespace internal {

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

  /// Returns how many borders moved.
  template <typename Keep>
  std::size_t run_round(int rings, const Execution& execution, const Keep& keep)
  {
    constexpr std::size_t work_per_triangle = 64;
    std::size_t moved = 0, work = work_per_triangle * surface_.number_of_triangles();
    std::vector<Chart_border> borders = borders_of_charts(surface_, segmentation_, limits_);
    while (!borders.empty() && execution.proceed()) {
      std::vector<Chart_border> batch = take_independent(borders, segmentation_.number_of_charts);
      std::erase_if(batch, [&](const Chart_border& border) {
        const std::size_t needed = sizes_[border.pair[0]] + sizes_[border.pair[1]];
        work -= std::min(work, needed);
        return work == 0;
      });
      std::vector<std::vector<Index>> changes(batch.size());
      execution.for_each(batch.size(), [&](std::size_t i) {
        const auto [a, b] = batch[i].pair;
        Border_smoother smoother(surface_, costs_, limits_, segmentation_.chart, {a, b},
                                 {sizes_[a], sizes_[b]}, scratch_, stamp_ + static_cast<Index>(2 * i));
        if (!smoother.run(batch[i].halfedges, rings))
          return;
        if constexpr (!std::is_same_v<Keep, Accept_all>)
          if (!keep(smoother.chart(0), smoother.chart(1)))
            return;
        changes[i] = smoother.changed();
      });
      stamp_ += static_cast<Index>(2 * batch.size());
      for (std::size_t i = 0; i < batch.size(); ++i) {
        moved += !changes[i].empty();
        for (const Index t : changes[i]) {
          Index& chart = segmentation_.chart[t];
          --sizes_[chart];
          chart = batch[i].pair[chart == batch[i].pair[0]];
          ++sizes_[chart];
        }
      }
    }
    return moved;
  }

private:
  const Surface& surface_;
  Segmentation& segmentation_;
  const Smoothing_limits& limits_;
  Seam_costs costs_;
  Smoothing_scratch scratch_;
  std::vector<std::size_t> sizes_; ///< per chart: its triangles
  Index stamp_ = 1;
};

} // namespace internal

/// \brief Makes the seams between charts shorter and smoother.
///
/// The border between each two neighbouring charts moves to the cheapest place in a band around it, by a
/// minimum cut; seams are cheap along sharp edges, so that borders do not leave features. A change is kept if
/// both charts are discs and `keep` says yes. Cuts inside charts stay where they are. Charts keep their
/// numbers, faces stay whole, patches, wanted seams and forbidden seams are respected.
///
/// \param segmentation  of discs, as cut_to_discs() makes them. Marks of cuts between different charts are
///                      cleared, since the edges are seams anyway.
/// \param keep          called with both charts as they would be, not yet flattened; from several threads.
///                      A pair of charts is tried at most once a round.
/// \returns how many borders moved
///
/// Near-linear: the work of a round is bounded by a multiple of the number of triangles; where one chart has
/// very many neighbours, the shortest borders are left out. Parallel over pairs of charts.
template <typename Keep = Accept_all>
requires std::predicate<const Keep&, const Chart&, const Chart&> std::size_t
smooth_borders(const Surface& surface, Segmentation& segmentation, const Smoothing_options& options = {},
               const Execution& execution = Execution(), const Keep& keep = {})
{
  const internal::Smoothing_limits limits = internal::smoothing_limits(surface, segmentation);
  internal::Segmentation_smoother smoother(surface, segmentation, limits, options);
  std::size_t moved = 0;
  for (int round = 0; round < options.rounds; ++round) {
    moved += smoother.run_round(options.rings, execution, keep);
    if (!execution.proceed(double(round + 1) / options.rounds))
      break;
  }
  return moved;
}

} // namespace Atlas

#endif
