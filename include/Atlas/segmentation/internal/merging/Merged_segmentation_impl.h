// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGED_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGED_SEGMENTATION_IMPL_H

#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/merging/merge_across_forbidden_seams.h>
#include <Atlas/segmentation/internal/merging/merge_option_ranges.h>
#include <Atlas/segmentation/internal/merging/merge_trial.h>
#include <Atlas/segmentation/internal/rejoining/Fragment_merger.h>
#include <Atlas/segmentation/internal/smoothing/Seam_band.h>
#include <Atlas/segmentation/internal/smoothing/Segmentation_smoother.h>
#include <Atlas/segmentation/internal/surface/favor_creases.h>
#include <Atlas/segmentation/merge_charts.h>
#include <Atlas/segmentation/smooth_borders.h>

#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// How far borders move at a time after charts have merged, in rings of triangles: far first, then the
/// details.
inline constexpr std::array smoothing_rings{8, 4, 2};
/// How much cheaper seams along sharp edges are then: less than before merging, since what has become of a
/// border shall be short.
inline constexpr double sharp_discount_after_merging = 0.4;

/// \brief What `Merged_segmentation` does after charts have merged: improves them within the bound.
class Merge_refiner
{
public:
  /// \param flatten  for trial; called from several threads
  Merge_refiner(const Surface& surface, Segmentation& segmentation, const Merge_options& options,
                Trial_flattening flatten, const Execution& execution)
      : surface_(surface), segmentation_(segmentation), options_(options), flatten_(std::move(flatten)),
        execution_(execution), area_(area_3d(surface))
  {}

  void smooth_within_bound()
  {
    const int reach = std::accumulate(smoothing_rings.begin(), smoothing_rings.end(), 1);
    Seam_band band(surface_, segmentation_, reach, triangles_of_coarse_copies(options_));
    Smoothing_options options;
    options.sharp_discount = sharp_discount_after_merging;
    Segmentation_smoother smoother(band.surface(), band.segmentation(), band.limits(), options);
    // A chart may be beyond the bound on this surface: then it must not get worse.
    const std::vector<Chart> before = extract_charts(band.surface(), band.segmentation());
    std::vector<std::optional<Trial_verdict>> verdicts(before.size());
    const auto is_kept = [&](const Trial_verdict& now, Index c) {
      if (!now.is_acceptable() && !verdicts[c])
        verdicts[c] = verdict_on(before[c]);
      return now.is_acceptable() || now.is_no_worse_than(*verdicts[c]);
    };
    const auto keep = [&](const std::array<Chart, 2>& now, const std::array<Index, 2>& pair) {
      std::array<Trial_verdict, 2> found;
      for (std::size_t i = 0; i < 2; ++i)
        if (found[i] = verdict_on(now[i]); !is_kept(found[i], pair[i]))
          return false;
      for (std::size_t i = 0; i < 2; ++i)
        verdicts[pair[i]] = found[i];
      return true;
    };
    for (const int rings : smoothing_rings)
      if (execution_.proceed(0.9))
        smoother.run_round(rings, execution_, keep);
    band.write_back(segmentation_);
  }

  /// What was refused on the coarse surface, once more on finer copies: charts of few triangles may look
  /// bent there though they are not.
  void merge_on_finer_copies()
  {
    std::vector<Flattened_chart> charts;
    for (Chart& chart : extract_charts(surface_, segmentation_))
      charts.push_back({std::move(chart), {}, {}});
    if (charts.size() < 2)
      return;
    std::vector<Index> all(charts.size());
    std::iota(all.begin(), all.end(), Index(0));
    const auto flatten = [&](Chart chart) {
      Flattened_chart result{std::move(chart), {}, {}};
      if (!verdict_on(result.chart).is_acceptable())
        result.verdict.status = Chart_status::area_ratio_exceeded;
      return result;
    };
    const auto accept = [](const Flattened_chart& merged, const Flattened_chart&, const Flattened_chart&) {
      return merged.verdict.is_valid();
    };
    constexpr std::size_t work = 1; // as many triangles as the surface has
    Fragment_merger(surface_, segmentation_, charts, flatten, accept, work, execution_).run(all);
    close_gaps(segmentation_, charts);
  }

private:
  Trial_verdict verdict_on(const Chart& chart) const { return examine(chart, area_, options_, flatten_); }

  const Surface& surface_;
  Segmentation& segmentation_;
  const Merge_options& options_;
  Trial_flattening flatten_;
  const Execution& execution_;
  double area_; ///< of the surface
};

} // namespace internal

ATLAS_INLINE Merged_segmentation::Merged_segmentation(Any_segmentation base, Any_parameterizer parameterizer,
                                                      Any_optimizer optimizer, const Merge_options& options)
    : base_(std::move(base)), parameterizer_(std::move(parameterizer)), optimizer_(std::move(optimizer)),
      options_(options)
{
  internal::require_valid(options);
}

ATLAS_INLINE Segmentation Merged_segmentation::segment(const Surface& input, const Execution& execution) const
{
  Surface surface = input;
  if (surface.seam_cost.empty()) // who gives costs knows where seams are wanted
    internal::favor_creases(surface);
  Segmentation segmentation = base_.segment(surface, execution);
  if (execution.is_cancelled())
    return segmentation;
  internal::merge_across_forbidden_seams(surface, segmentation);
  cut_to_discs(surface, segmentation, execution);
  // Straight arcs between the many charts: what remains of them are short seams, slits included.
  Smoothing_options smoothing;
  smoothing.rounds = 1;
  if (options_.are_borders_smoothed && !execution.is_cancelled())
    smooth_borders(surface, segmentation, smoothing, execution);
  if (!execution.is_cancelled())
    merge_charts(surface, segmentation, options_, parameterizer_, optimizer_, execution);

  const Execution alone; // charts are tried side by side, each on one thread
  const auto flatten = [&](Chart& chart) {
    const Chart_status status = parameterizer_.parameterize(chart, alone);
    return status == Chart_status::valid ? optimizer_.optimize(chart, alone) : status;
  };
  internal::Merge_refiner refiner(surface, segmentation, options_, flatten, execution);
  if (options_.are_borders_smoothed && !execution.is_cancelled())
    refiner.smooth_within_bound();
  if (!execution.is_cancelled())
    refiner.merge_on_finer_copies();
  return segmentation;
}

} // namespace Atlas

#endif
