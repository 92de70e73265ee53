// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_MERGE_CHARTS_H
#define ATLAS_SEGMENTATION_MERGE_CHARTS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <cstddef>

namespace Atlas {

/// \brief When charts may merge, and how long better ways to merge them are sought.
///
/// Charts are flattened for trial on a coarse copy of the surface, which has the same charts but few
/// triangles.
struct Merge_options
{
  /// The figure of distortion that is bounded.
  Distortion_measure measure = Distortion_measure::symmetric_dirichlet;
  /// Its bound for each chart that comes from merging: at least 1, which is no distortion; infinity: none.
  double max_distortion = 1.035;
  /// Besides, the stretch of a triangle, which is max(s1, 1/s2) with the chart scaled to its area in space:
  /// at least 1; infinity: no bound. Trials use nine tenths of what it allows beyond 1 ...
  double max_stretch = 1.5;
  /// ... is at most that on this share of each chart's area, in (0, 1]; 1: of every triangle.
  double max_stretch_share = 0.99;
  /// Trials may use this share of what the bound allows beyond 1: less than 1 leaves a margin for what only
  /// the full resolution shows. In (0, 1].
  double share_for_trials = 1;
  /// A chart may have at most this share of the surface's area, in (0, 1], because large charts leave gaps on
  /// the page, ...
  double max_area_share = 0.25;
  /// ... unless it fills at least this share of its convex hull when flat, in [0, 1].
  double solidity_of_large_charts = 0.85;
  /// Every chart that comes from merging fills at least this share of its convex hull, in [0, 1].
  double min_solidity = 0.55;
  /// Two edges of the border of such a chart are at least this share of the shorter one's length apart in the
  /// plane, neighbours excepted, in [0, 1]: a chart whose coarse outline keeps off itself will do so in
  /// detail.
  double min_gap = 0.05;
  /// Two charts are not tried together if their common border looks too different in their two layouts. After
  /// the best rotation and shift of one onto the other, the root mean square distance of the two is at most
  /// this many times the square root of the charts' area. Not negative; infinity: all are tried.
  double max_misfit = 0.2;
  /// About how many triangles a chart has on the coarse surface; positive.
  double triangles_per_chart = 70;
  /// A union with more triangles than that on the coarse surface is not tried: a bound on the cost of a
  /// trial.
  std::size_t max_trial_triangles = 5000;
  /// So many pairs of charts are tried at a time, and possibly in parallel; at least 1. It is part of the
  /// result, unlike the number of threads.
  std::size_t batch = 8;
  /// Merging is done in so many orders, 1 to 6, and the result with the shortest seams is taken ...
  std::size_t orders = 6;
  /// ... but in no more orders than flatten about so many triangles for trial, all together: a bound on the
  /// time for surfaces of a hundred handles and more, whose charts can hardly be merged.
  std::size_t max_work_of_orders = 1'000'000;
  /// Merging goes on past the bound until there are at most so many charts, as far as discs, patches and
  /// seams allow; 0: no such wish.
  std::size_t max_charts = 0;
  /// Charts below this share of the surface's area join a neighbour even past the bound, if the union is a
  /// disc; not negative; 0: no such wish; 1 and more: all charts join that can.
  double min_chart_area = 0;
  /// Only for `Merged_segmentation`: whether borders are smoothed before charts merge and, where the bound
  /// allows it, afterwards.
  bool are_borders_smoothed = true;
};

namespace internal {

/// What the options bound.
inline Distortion_bound bound_of(const Merge_options& options)
{
  return {options.measure, options.max_distortion, options.max_stretch, options.max_stretch_share};
}

} // namespace internal

/// Fewer charts and shorter seams for more distortion: a bound of 1.05, and charts as large and as ramified
/// as it allows. On the eight meshes of the manual's table a quarter of UVAtlas's charts and about two
/// thirds of its seams; pages fill less well, since a large chart leaves gaps that nothing can fill.
Merge_options few_seams_options();

/// For maps that are conformal and nothing else (section 3.3 of the LSCM paper): densities in a chart differ
/// by a factor of two at most, but for the extreme hundredth of the area at either end. To be used with a
/// parameterizer that keeps LSCM's maps as they are, and a validator with the same bound. The extremes of a
/// conformal map sit in the details of the border, which the coarse surface does not have; so trials keep a
/// margin, and the surface is finer than usual.
Merge_options conformal_options();

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
///
/// \throws Invalid_argument if an option is out of its range, or the segmentation has other sizes than the
/// surface
void merge_charts(const Surface& surface, Segmentation& segmentation, const Merge_options& options,
                  const Any_parameterizer& parameterizer, const Any_optimizer& optimizer,
                  const Execution& execution = Execution());

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/merging/merge_charts_impl.h>
#endif

#endif
