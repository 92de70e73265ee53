// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_MERGED_SEGMENTATION_H
#define ATLAS_SEGMENTATION_MERGED_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/concepts.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/measure/area.h>
#include <Atlas/segmentation/Merge_options.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/merging/merge_across_forbidden_seams.h>
#include <Atlas/segmentation/internal/merging/merge_trial.h>
#include <Atlas/segmentation/internal/rejoining/Fragment_merger.h>
#include <Atlas/segmentation/internal/smoothing/Seam_band.h>
#include <Atlas/segmentation/merge_charts.h>
#include <Atlas/segmentation/smooth_borders.h>

#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Few charts under a bound: many charts of another model, merged while the bound allows it.
///
/// \tparam Base           makes the charts to begin with: more than needed, of simple shape
/// \tparam Parameterizer  flattens unions for trial
/// \tparam Optimizer      lowers their distortion
///
/// The charts are discs. Edges that must not be seams (`Edge_constraint::no_seam`) are none wherever discs
/// can be had otherwise, and seams keep off edges where they cost much (`Surface::seam_cost`). A model of
/// `ChartSegmentation`. See `merge_charts()`.
template <ChartSegmentation Base, ChartParameterizer Parameterizer, UVOptimizer Optimizer>
class Merged_segmentation
{
public:
  explicit Merged_segmentation(Base base = Base(), Parameterizer parameterizer = Parameterizer(),
                               Optimizer optimizer = Optimizer(), const Merge_options& options = {})
      : base_(std::move(base)), parameterizer_(std::move(parameterizer)), optimizer_(std::move(optimizer)),
        options_(options)
  {}

  const Base& base() const { return base_; }
  const Merge_options& options() const { return options_; }
  /// Of the charts that come from merging. Splits that a flattening needs later only lower the distortion.
  Distortion_bound bound() const { return {options_.measure, options_.max_distortion}; }

  /// Once cancelled, returns the charts of that moment.
  Segmentation segment(const Surface& surface, const Execution& execution) const
  {
    Segmentation segmentation = base_.segment(surface, execution);
    internal::merge_across_forbidden_seams(surface, segmentation);
    if (!execution.is_cancelled())
      cut_to_discs(surface, segmentation, execution);
    // Straight arcs between the many charts: what remains of them are short seams, slits included.
    Smoothing_options smoothing;
    smoothing.rounds = 1;
    if (options_.are_borders_smoothed && !execution.is_cancelled())
      smooth_borders(surface, segmentation, smoothing, execution);
    if (!execution.is_cancelled())
      merge_charts(surface, segmentation, options_, parameterizer_, optimizer_, execution);
    if (options_.are_borders_smoothed && !execution.is_cancelled())
      smooth_within_bound(surface, segmentation, execution);
    if (!execution.is_cancelled())
      merge_on_finer_copies(surface, segmentation, execution);
    return segmentation;
  }

private:
  /// How far borders move at a time, in rings of triangles.
  static constexpr std::array smoothing_rings{8, 4, 2};
  /// How much cheaper seams along sharp edges are then: less than before merging, since what has become of a
  /// border shall be short.
  static constexpr double discount_after_merging = 0.4;

  void smooth_within_bound(const Surface& surface, Segmentation& segmentation,
                           const Execution& execution) const
  {
    const int reach = std::accumulate(smoothing_rings.begin(), smoothing_rings.end(), 1);
    internal::Seam_band around(surface, segmentation, reach,
                               internal::triangles_of_smoothed_charts(options_));
    Smoothing_options options;
    options.sharp_discount = discount_after_merging;
    internal::Segmentation_smoother smoother(around.surface(), around.segmentation(), around.limits(),
                                             options);
    const double area = area_3d(surface);
    for (const int rings : smoothing_rings)
      if (execution.proceed(0.9))
        smoother.run_round(rings, execution, [&](const Chart& a, const Chart& b) {
          return is_kept(a, area) && is_kept(b, area);
        });
    around.write_back(segmentation);
  }

  struct Tried_chart
  {
    Chart chart;
    bool is_kept = false;
  };

  /// What was refused on the coarse surface, once more on finer copies: charts of few triangles may look
  /// bent there though they are not.
  void merge_on_finer_copies(const Surface& surface, Segmentation& segmentation,
                             const Execution& execution) const
  {
    const double area = area_3d(surface);
    std::vector<Tried_chart> charts;
    for (Chart& chart : extract_charts(surface, segmentation))
      charts.push_back({std::move(chart)});
    if (charts.size() < 2)
      return;
    std::vector<Index> all(charts.size());
    std::iota(all.begin(), all.end(), Index(0));
    const auto flatten = [&](Chart chart) {
      const bool kept = is_kept(chart, area);
      return Tried_chart{std::move(chart), kept};
    };
    const auto accept = [](const Tried_chart& joined, const Tried_chart&, const Tried_chart&) {
      return joined.is_kept;
    };
    internal::Fragment_merger(surface, segmentation, charts, flatten, accept, 1, execution).run(all);
    internal::close_gaps(segmentation, charts);
  }

  bool is_kept(const Chart& chart, double whole_area) const
  {
    const Execution alone; // charts are tried side by side, each on one thread
    return internal::passes_trial(chart, whole_area, options_, [&](Chart& c) {
      const Chart_status status = parameterizer_.parameterize(c, alone);
      return status == Chart_status::valid ? optimizer_.optimize(c, alone) : status;
    });
  }

  Base base_;
  Parameterizer parameterizer_;
  Optimizer optimizer_;
  Merge_options options_;
};

} // namespace Atlas

#endif
