// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_CULPRIT_SPLITTER_H
#define ATLAS_VALIDATION_CULPRIT_SPLITTER_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/library.h>

#include <vector>

namespace Atlas {

/// \brief Splits a refused chart where the cut mends what is wrong (Levy et al. 2002, section 3.3).
///
/// - `overlapping`: along the border of the overlapped zone (the paper's figure 6); pieces of the zone come
///   off until none of the rest overlap. Where the zone is a single piece that winds over itself, the chart
///   is split half-way between two triangles that cover each other.
/// - `area_ratio_exceeded`: two parts grown from the extreme triangles; steps towards triangles of another
///   density are longer.
/// - `bound_exceeded`: a short cut through the place with most distortion.
/// - `flipped`: a cut through the flipped triangles that has half of them on either side. A vertex that was
///   too sharp to be flattened lies on the border then.
///   Triangles that are counterclockwise in `chart.uv` and are to blame all the same are too small for the
///   numbers that coordinates are rounded to: they come off together with their small neighbours, since a
///   chart of their own gets a scale of its own.
/// - anything else: two halves.
/// - a chart that is not connected falls into its components, whatever the verdict.
///
/// Parts are numbered in the order of their first triangle; there are at least two if the chart has more
/// than one triangle.
///
/// *Termination.* Every part has fewer triangles than the chart, and a single triangle is always accepted
/// once it is flattened: repeated splitting ends after at most n - 1 splits, whatever is flattened in
/// between. With the coordinates they have, `overlapping` charts whose zone does not wind over itself are
/// mended in one round; where the cut goes through the zone or through flipped triangles, about half of the
/// culprits go to either side, and halves have n/2 triangles.
///
/// *Rounds.* What a caller flattens anew may fail anew, so the number of rounds has a bound only if he
/// halves: a verdict of `solver_failed` gives halves, and charts that cannot be flattened at all are gone
/// after log2(n) such rounds. `generate_atlas()` does so from the 8th round on: at most 8 + log2(n) rounds
/// of flattening after each of at most 6 rounds on the page. O(n log n) a split.
///
/// Models `ChartSplitter`.
class Culprit_splitter
{
public:
  /// \param area_quantile  as that of the `Exact_validator` whose verdicts these are
  /// \throws Invalid_argument unless it is in [0, 0.5)
  explicit Culprit_splitter(double area_quantile = 0);

  /// The part of each triangle.
  std::vector<Index> split(const Chart& chart, const Chart_verdict& verdict) const;

private:
  double area_quantile_;
};

static_assert(ChartSplitter<Culprit_splitter>);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/validation/internal/Culprit_splitter_impl.h>
#endif

#endif
