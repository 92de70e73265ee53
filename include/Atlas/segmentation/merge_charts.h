// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_MERGE_CHARTS_H
#define ATLAS_SEGMENTATION_MERGE_CHARTS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/concepts.h>
#include <Atlas/segmentation/Merge_options.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>
#include <Atlas/segmentation/internal/merging/Chart_merger.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// Per arc, what a seam costs there per length, on average.
inline std::vector<double> arc_weights(const Surface& surface, const Chart_arcs& arcs)
{
  std::vector<double> cost(arcs.number_of_arcs(), 0), length(arcs.number_of_arcs(), 0);
  for (Index h = 0; h < arcs.side.size(); ++h)
    if (arcs.side[h] != no_index) {
      const bool is_unwanted =
          !surface.constraint.empty() && surface.constraint[h] == Edge_constraint::no_seam;
      const double l = edge_length(surface, h);
      length[arcs.side[h] / 2] += l;
      cost[arcs.side[h] / 2] += l * wanted_cost(surface, h) * (is_unwanted ? penalty_of_unwanted_seams : 1);
    }
  for (Index a = 0; a < cost.size(); ++a)
    cost[a] = length[a] > 0 ? cost[a] / length[a] : 1;
  return cost;
}

/// Merges in several orders and returns the merger with the shortest seams of those that come nearest to the
/// number of charts that is asked for. What the first order costs tells how many can be afforded.
template <typename Merger>
Merger best_merger(const Merger& unmerged, const Merge_options& options, const Execution& execution)
{
  constexpr std::array orders{Merge_order::by_union,
                              Merge_order::by_mean_perimeter,
                              Merge_order::by_perimeter_in_union,
                              Merge_order::by_larger_perimeter,
                              Merge_order::by_length,
                              Merge_order::by_smaller_area};
  std::vector<Merger> mergers{unmerged};
  mergers[0].run(orders[0]);
  const std::size_t affordable = options.max_work_of_orders / std::max<std::size_t>(mergers[0].work(), 1);
  while (mergers.size() < std::min({options.orders, affordable, orders.size()}))
    mergers.push_back(unmerged);
  execution.for_each(mergers.size() - 1, [&](std::size_t i) { mergers[i + 1].run(orders[i + 1]); });
  const auto score = [&](const Merger& m) {
    const std::size_t charts = m.number_of_charts();
    return std::pair(options.max_charts > 0 ? std::max(charts, options.max_charts) : 0, m.seam_length());
  };
  return *std::min_element(mergers.begin(), mergers.end(),
                           [&](const Merger& a, const Merger& b) { return score(a) < score(b); });
}

} // namespace internal

/// \brief Merges adjacent charts while the union is a disc that can be flattened within a bound.
///
/// All charts have to be discs, as `cut_to_discs()` makes them, and stay discs. Charts merge along one run of
/// their common border; where they touch elsewhere too, a cut remains, which is closed from its ends where
/// the bound allows it. Pairs that share much of the smaller one's border go first. Each union is flattened
/// for trial by `parameterizer` and `optimizer`, on a coarse surface with the same charts: the chart's
/// distortion hardly depends on the resolution. So the bound holds at full resolution but for a small
/// difference, and whoever needs certainty flattens and validates the charts afterwards. Seams that the user
/// asks for and the limits of patches stay. Deterministic for any number of threads.
///
/// Seams count by their length times `Surface::seam_cost`, and very much where the user wants none: such
/// borders go first. Merging is done in several orders, and the result with the shortest seams is taken. With
/// `max_charts` or `min_chart_area`, merging goes on past the bound, in steps, until the wish is met or no
/// more unions are discs.
///
/// The cost is that of O(charts) flattenings of a few hundred triangles, and O(n) for the coarse surface.
template <ChartParameterizer Parameterizer, UVOptimizer Optimizer>
void merge_charts(const Surface& surface, Segmentation& segmentation, const Merge_options& options,
                  const Parameterizer& parameterizer, const Optimizer& optimizer,
                  const Execution& execution = Execution())
{
  const internal::Chart_arcs arcs = internal::chart_arcs(surface, segmentation);
  const internal::Coarse_surface coarse =
      internal::Surface_simplifier(surface, segmentation, arcs, options.triangles_per_chart).run();
  const Execution alone; // trials run side by side, each on one thread
  const auto flatten = [&](Chart& chart) {
    const Chart_status status = parameterizer.parameterize(chart, alone);
    return status == Chart_status::valid ? optimizer.optimize(chart, alone) : status;
  };
  const internal::Chart_merger unmerged(coarse, arcs, internal::arc_weights(surface, arcs),
                                        segmentation.number_of_charts, options, flatten, execution);
  internal::Chart_merger merger = internal::best_merger(unmerged, options, execution);

  std::vector<Index> number(segmentation.number_of_charts, no_index);
  segmentation.number_of_charts = 0;
  for (Index& c : segmentation.chart) {
    Index& n = number[merger.chart_of(c)];
    if (n == no_index)
      n = segmentation.number_of_charts++;
    c = n;
  }
  for (Index h = 0; h < arcs.side.size(); ++h)
    if (arcs.side[h] != no_index && surface.opposite[h] != no_index)
      segmentation.cut[h] = !merger.is_glued(arcs.side[h] / 2);
}

} // namespace Atlas

#endif
