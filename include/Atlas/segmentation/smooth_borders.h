// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_SMOOTH_BORDERS_H
#define ATLAS_SEGMENTATION_SMOOTH_BORDERS_H

#include <Atlas/Chart.h>
#include <Atlas/Execution.h>
#include <Atlas/Surface.h>
#include <Atlas/extract_charts.h>
#include <Atlas/segmentation/internal/Border_smoother.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
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

/// What a seam costs along each edge: its length, less at sharp edges, much more where there should be none.
inline std::vector<float> seam_costs(const Surface& surface, const Smoothing_options& options)
{
  const std::vector<Vector_3> normals = face_normals(surface);
  double longest = 0;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    longest = std::max(longest, edge_length(surface, h));
  std::vector<float> cost(surface.opposite.size(), 0);
  for (Index h = 0; h < cost.size(); ++h) {
    const Index o = surface.opposite[h];
    if (o == no_index || o < h)
      continue;
    const double sharp = std::min(1., angle_between(normals[h / 3], normals[o / 3]) / options.sharp_angle);
    const double length = longest > 0 ? edge_length(surface, h) / longest : 0;
    const double penalty = must_not_cut(surface, h) ? cut_penalty_of_no_seam : 1;
    cost[h] = cost[o] = static_cast<float>(length * (1 - options.sharp_discount * sharp) * penalty);
  }
  return cost;
}

/// Pairs of charts with a common border, those with the most edges first.
inline std::vector<std::array<Index, 2>> neighboring_charts(const Surface& surface,
                                                            const Segmentation& segmentation)
{
  std::map<std::array<Index, 2>, std::size_t> edges;
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    if (!may_cross(surface, h))
      continue;
    const Index a = segmentation.chart[h / 3], b = segmentation.chart[surface.opposite[h] / 3];
    if (a < b)
      ++edges[{a, b}];
  }
  std::vector<std::pair<std::size_t, std::array<Index, 2>>> sorted;
  for (const auto& [pair, count] : edges)
    sorted.emplace_back(count, pair);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::array<Index, 2>> pairs;
  for (const auto& [count, pair] : sorted)
    pairs.push_back(pair);
  return pairs;
}

/// Takes as many pairs out of the list as can be worked on at once, in order.
inline std::vector<std::array<Index, 2>> take_independent_pairs(std::vector<std::array<Index, 2>>& pairs,
                                                                Index number_of_charts)
{
  std::vector<std::uint8_t> is_busy(number_of_charts, 0);
  std::vector<std::array<Index, 2>> taken, left;
  for (const auto& pair : pairs) {
    const bool is_free = !is_busy[pair[0]] && !is_busy[pair[1]];
    (is_free ? taken : left).push_back(pair);
    if (is_free)
      is_busy[pair[0]] = is_busy[pair[1]] = 1;
  }
  pairs.swap(left);
  return taken;
}

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
  constexpr std::size_t work_per_triangle = 64;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (const Index o = surface.opposite[h];
        o != no_index && segmentation.chart[h / 3] != segmentation.chart[o / 3])
      segmentation.cut[h] = 0;
  const std::vector<float> cost = internal::seam_costs(surface, options);
  internal::Smoothing_scratch scratch(surface.number_of_triangles());
  std::vector<std::vector<Index>> lists = triangles_of_charts(segmentation);
  std::size_t moved = 0;
  for (int round = 0; round < options.rounds; ++round) {
    auto pairs = internal::neighboring_charts(surface, segmentation);
    std::size_t work = work_per_triangle * surface.number_of_triangles();
    while (!pairs.empty() && !execution.is_cancelled()) {
      auto batch = internal::take_independent_pairs(pairs, segmentation.number_of_charts);
      std::erase_if(batch, [&](const auto& pair) {
        const std::size_t needed = lists[pair[0]].size() + lists[pair[1]].size();
        work -= std::min(work, needed);
        return work == 0;
      });
      std::vector<std::array<std::vector<Index>, 2>> changes(batch.size());
      execution.for_each(batch.size(), [&](std::size_t i) {
        internal::Border_smoother smoother(surface, segmentation, cost, lists[batch[i][0]],
                                           lists[batch[i][1]], scratch);
        if (smoother.run(options.rings) && keep(internal::chart_of_piece(surface, smoother.piece(0)),
                                                internal::chart_of_piece(surface, smoother.piece(1))))
          changes[i] = {smoother.triangles(0), smoother.triangles(1)};
      });
      for (std::size_t i = 0; i < batch.size(); ++i)
        for (int side = 0; side < 2 && !changes[i][0].empty(); ++side) {
          moved += side;
          lists[batch[i][side]] = changes[i][side];
          for (const Index t : changes[i][side])
            segmentation.chart[t] = batch[i][side];
        }
    }
    if (!execution.proceed(double(round + 1) / options.rounds))
      break;
  }
  return moved;
}

} // namespace Atlas

#endif
