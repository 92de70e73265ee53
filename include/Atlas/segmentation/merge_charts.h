// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_MERGE_CHARTS_H
#define ATLAS_SEGMENTATION_MERGE_CHARTS_H

#include <Atlas/Chart.h>
#include <Atlas/Execution.h>
#include <Atlas/Surface.h>
#include <Atlas/concepts.h>
#include <Atlas/segmentation/Merge_options.h>
#include <Atlas/segmentation/internal/Chart_arcs.h>
#include <Atlas/segmentation/internal/Chart_merger.h>
#include <Atlas/segmentation/internal/Coarse_surface.h>

#include <vector>

namespace Atlas {

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
  internal::Chart_merger merger(coarse, arcs, segmentation.number_of_charts, options, flatten, execution);
  merger.run();

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
