// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_CHARTS_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_CHARTS_IMPL_H

#include <Atlas/core/Chart.h>
#include <Atlas/segmentation/internal/arguments.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>
#include <Atlas/segmentation/internal/merging/Chart_merger.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/merging/merge_option_ranges.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>
#include <Atlas/segmentation/merge_charts.h>

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
      const double l = edge_length(surface, h);
      length[arcs.side[h] / 2] += l;
      cost[arcs.side[h] / 2] +=
          l * wanted_cost(surface, h) * (is_unwanted_seam(surface, h) ? penalty_of_unwanted_seams : 1);
    }
  for (Index a = 0; a < cost.size(); ++a)
    cost[a] = length[a] > 0 ? cost[a] / length[a] : 1;
  return cost;
}

/// Merges in several orders and returns the merger with the shortest seams of those that come nearest to the
/// number of charts that is asked for. What the first order costs tells how many can be afforded.
inline Chart_merger best_merger(const Chart_merger& unmerged, const Merge_options& options,
                                const Execution& execution)
{
  constexpr std::array orders{Merge_order::by_union,
                              Merge_order::by_mean_perimeter,
                              Merge_order::by_perimeter_in_union,
                              Merge_order::by_larger_perimeter,
                              Merge_order::by_length,
                              Merge_order::by_smaller_area};
  std::vector<Chart_merger> mergers{unmerged};
  mergers[0].run(orders[0]);
  const std::size_t affordable = options.max_work_of_orders / std::max<std::size_t>(mergers[0].work(), 1);
  while (mergers.size() < std::min({options.orders, affordable, orders.size()}))
    mergers.push_back(unmerged);
  execution.for_each(mergers.size() - 1, [&](std::size_t i) { mergers[i + 1].run(orders[i + 1]); });
  const auto score = [&](const Chart_merger& m) {
    const std::size_t charts = m.number_of_charts();
    return std::pair(options.max_charts > 0 ? std::max(charts, options.max_charts) : 0, m.seam_length());
  };
  return *std::min_element(mergers.begin(), mergers.end(),
                           [&](const Chart_merger& a, const Chart_merger& b) { return score(a) < score(b); });
}

/// Where the mean is what counts, single places may have that.
inline constexpr double loose_stretch = 2.5;

} // namespace internal

ATLAS_INLINE Merge_options few_seams_options()
{
  Merge_options options;
  options.max_distortion = 1.05;
  options.max_stretch = internal::loose_stretch;
  options.max_area_share = 1;
  options.solidity_of_large_charts = 0.45;
  options.min_solidity = 0.45;
  return options;
}

ATLAS_INLINE Merge_options conformal_options()
{
  Merge_options options;
  options.measure = Distortion_measure::area_ratio_quantiles;
  options.max_distortion = 2; // the paper's
  options.max_stretch = internal::loose_stretch;
  options.share_for_trials = 0.65;
  options.triangles_per_chart = 240;
  options.max_trial_triangles = 20000;
  return options;
}

ATLAS_INLINE void merge_charts(const Surface& surface, Segmentation& segmentation,
                               const Merge_options& options, const Any_parameterizer& parameterizer,
                               const Any_optimizer& optimizer, const Execution& execution)
{
  internal::require_valid(options);
  internal::require_numbered_segmentation_of(surface, segmentation);
  const internal::Chart_arcs arcs = internal::chart_arcs(surface, segmentation);
  const internal::Coarse_surface coarse =
      internal::Surface_simplifier(surface, segmentation, arcs, options.triangles_per_chart).run();
  const Execution alone; // trials run side by side, each on one thread
  const internal::Trial_flattening flatten = [&](Chart& chart) {
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
