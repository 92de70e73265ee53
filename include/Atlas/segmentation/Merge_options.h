// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_MERGE_OPTIONS_H
#define ATLAS_SEGMENTATION_MERGE_OPTIONS_H

#include <Atlas/measure/distortion.h>

#include <cstddef>

namespace Atlas {

/// \brief When charts may merge.
struct Merge_options
{
  /// What is bounded.
  Distortion_measure measure = Distortion_measure::symmetric_dirichlet;
  /// The bound of each chart that comes from merging, as flattened on the coarse surface.
  double max_distortion = 1.035;
  /// The share of what the bound allows beyond 1 that trials on the coarse surface may use: less than 1
  /// leaves a margin for what shows at full resolution only.
  double share_for_trials = 1;
  /// Charts get no larger than this share of the surface's area, or pages would not pack ...
  double max_area_share = 0.25;
  /// ... unless they fill this share of their convex hull.
  double solidity_of_large_charts = 0.85;
  /// Charts that come from merging fill at least this share of their convex hull.
  double min_solidity = 0.55;
  /// No two edges of the border of such a chart come closer in the plane than this share of their length: a
  /// chart that keeps off itself in outline will do so in detail.
  double min_gap = 0.05;
  /// Charts do not merge if their common border differs more between their layouts: root mean square
  /// distance after rigid alignment over the square root of the area.
  double max_misfit = 0.2;
  /// About how many triangles each chart has on the coarse surface on which charts are flattened for trial.
  double triangles_per_chart = 70;
  /// Charts whose union has more triangles on the coarse surface do not merge: this bounds the cost of a
  /// trial.
  std::size_t max_trial_triangles = 5000;
  /// Pairs of charts that are tried at a time, and maybe in parallel. Part of the result: not a number of
  /// threads.
  std::size_t batch = 8;
  /// Merging is done in so many orders, 1 to 6, and the shortest seams are taken.
  std::size_t orders = 6;
  /// But in no more orders than flatten about so many triangles for trial, all together: a bound on the time
  /// for surfaces of a hundred handles and more, whose charts can hardly be merged.
  std::size_t max_work_of_orders = 1'000'000;
  /// Merging goes on past the bound until there are at most so many charts, as far as discs, patches and
  /// seams allow; 0: no such wish.
  std::size_t max_charts = 0;
  /// Charts below this share of the surface's area join a neighbour even past the bound, if the union is a
  /// disc; 0: no such wish.
  double min_chart_area = 0;
  /// `Merged_segmentation`: whether borders are smoothed before charts merge, and where the bound allows it,
  /// afterwards.
  bool are_borders_smoothed = true;
};

/// Fewer charts and shorter seams for more distortion: a bound of 1.05, and charts as large and as ramified
/// as it allows. On the eight meshes of the manual's table a quarter of UVAtlas's charts and less than two
/// thirds of its seams; pages fill less well, since a large chart leaves gaps that nothing can fill.
inline Merge_options few_seams_options()
{
  Merge_options options;
  options.max_distortion = 1.05;
  options.max_area_share = 1;
  options.solidity_of_large_charts = 0.45;
  options.min_solidity = 0.45;
  return options;
}

/// For maps that are conformal and nothing else (section 3.3 of the LSCM paper): densities in a chart differ
/// by a factor of two at most, but for the extreme hundredth of the area at either end. To be used with a
/// parameterizer that keeps LSCM's maps as they are, and a validator with the same bound. The extremes of a
/// conformal map sit in the details of the border, which the coarse surface does not have; so trials keep a
/// margin, and the surface is finer than usual.
inline Merge_options conformal_options()
{
  Merge_options options;
  options.measure = Distortion_measure::area_ratio_quantiles;
  options.max_distortion = 2; // the paper's
  options.share_for_trials = 0.65;
  options.triangles_per_chart = 240;
  options.max_trial_triangles = 20000;
  return options;
}

} // namespace Atlas

#endif
