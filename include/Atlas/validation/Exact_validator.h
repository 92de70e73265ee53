// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_EXACT_VALIDATOR_H
#define ATLAS_VALIDATION_EXACT_VALIDATOR_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/area_in_space.h>
#include <Atlas/validation/internal/chart_densities.h>
#include <Atlas/validation/internal/split_chart.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

/// The bound of Levy et al. 2002, section 3.3, on the ratio of the largest to the smallest (area in space /
/// area in the plane) in a chart.
inline constexpr double default_max_area_ratio = 2;

/// \brief Accepts a chart that is exactly one-to-one and keeps areas well enough (Levy et al. 2002, section
/// 3.3).
///
/// Every triangle has to be counterclockwise in the plane; one without area in space may be flat. No two
/// triangles may overlap; contact is no overlap. Both are decided by exact predicates on the coordinates as
/// they are, in O(n log n). Unlike the usual argument (no flip and a simple border make a disc one-to-one)
/// the one used here holds for charts of any topology: see `is_overlap_free()`.
///
/// Models `ChartValidator`.
class Exact_validator
{
public:
  /// \param max_area_ratio  bound on the ratio of densities, at least 1; 0 and infinity switch the test off
  /// \param area_quantile   share of the chart's area in space, in [0, 0.5), that is left out at either end
  /// when the ratio is measured: 0 compares the extreme triangles as the paper does, 0.01 is robust
  explicit Exact_validator(double max_area_ratio = default_max_area_ratio, double area_quantile = 0)
      : max_area_ratio_(max_area_ratio), area_quantile_(area_quantile)
  {
    CGAL_precondition(max_area_ratio == 0 || max_area_ratio >= 1);
    CGAL_precondition(area_quantile >= 0 && area_quantile < 0.5);
  }

  double max_area_ratio() const { return max_area_ratio_; }
  double area_quantile() const { return area_quantile_; }

  /// The worst that is wrong with the chart, with the triangles to blame: `flipped` before `overlapping`
  /// before `area_ratio_exceeded` (then the culprits are the two extreme triangles). Coordinates that are
  /// missing or not finite give `solver_failed`. O(n log n).
  Chart_verdict validate(const Chart& chart, const Execution& execution) const
  {
    Chart_verdict verdict = check_numbers(chart);
    if (verdict.is_valid())
      verdict = check_orientation(chart);
    if (verdict.is_valid())
      verdict = check_overlap(chart, execution);
    if (verdict.is_valid())
      verdict = internal::Chart_densities(chart, area_quantile_).check(max_area_ratio_);
    if (!execution.proceed())
      verdict = {Chart_status::cancelled, {}};
    return verdict;
  }

  /// \brief Splits a refused chart where the cut mends what is wrong.
  ///
  /// - `overlapping`: along the border of the overlapped zone (the paper's figure 6); pieces of the zone come
  ///   off until none of the rest overlap. Where the zone is a single piece that winds over itself, the chart
  ///   is split half-way between two triangles that cover each other.
  /// - `area_ratio_exceeded`: two parts grown from the extreme triangles; steps towards triangles of another
  ///   density are longer.
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
  std::vector<Index> split(const Chart& chart, const Chart_verdict& verdict) const
  {
    const internal::Chart_graph graph(chart);
    auto [parts, components] = graph.components([](Index) { return true; });
    if (components > 1)
      return parts;
    if (check_numbers(chart).is_valid()) {
      if (verdict.status == Chart_status::overlapping)
        parts =
            internal::split_overlap(chart, graph, find_overlaps(triangles_uv(chart), Execution(), max_pairs));
      else if (verdict.status == Chart_status::area_ratio_exceeded)
        parts = internal::Chart_densities(chart, area_quantile_).split(graph);
      else if (verdict.status == Chart_status::flipped && is_flipped_later(chart, verdict))
        parts = internal::cut_off_small(chart, graph, verdict.culprits);
      else if (verdict.status == Chart_status::flipped)
        parts = internal::cut_through(graph, verdict.culprits);
    }
    if (!internal::is_split(parts))
      parts = internal::halve(graph);
    return internal::renumber(std::move(parts));
  }

private:
  /// Pairs that are enough to see the overlapped zone.
  static constexpr std::size_t max_pairs = 200'000;
  static std::vector<Triangle_uv> triangles_uv(const Chart& chart)
  {
    std::vector<Triangle_uv> result;
    result.reserve(chart.number_of_triangles());
    for (const auto& [a, b, c] : chart.triangles)
      result.push_back({chart.uv[a], chart.uv[b], chart.uv[c]});
    return result;
  }

  static Chart_verdict check_numbers(const Chart& chart)
  {
    const bool is_finite = std::all_of(chart.uv.begin(), chart.uv.end(), [](const Point_2& p) {
      return std::isfinite(p.x()) && std::isfinite(p.y());
    });
    return {is_finite && chart.uv.size() == chart.points.size() ? Chart_status::valid
                                                                : Chart_status::solver_failed,
            {}};
  }

  static bool has_area(const Chart& chart, std::size_t t)
  {
    const auto& [a, b, c] = chart.triangles[t];
    return internal::has_area(chart.points[a], chart.points[b], chart.points[c]);
  }

  static bool is_flipped(const Chart& chart, Index t)
  {
    const auto& [a, b, c] = chart.triangles[t];
    const CGAL::Orientation o = CGAL::orientation(chart.uv[a], chart.uv[b], chart.uv[c]);
    return o == CGAL::RIGHT_TURN || (o == CGAL::COLLINEAR && has_area(chart, t));
  }

  /// Whether these coordinates are not to blame: triangles flip when they are rounded for a page.
  static bool is_flipped_later(const Chart& chart, const Chart_verdict& verdict)
  {
    return std::none_of(verdict.culprits.begin(), verdict.culprits.end(),
                        [&](Index t) { return is_flipped(chart, t); });
  }

  static Chart_verdict check_orientation(const Chart& chart)
  {
    Chart_verdict verdict;
    for (Index t = 0; t < chart.number_of_triangles(); ++t)
      if (is_flipped(chart, t))
        verdict.culprits.push_back(t);
    if (!verdict.culprits.empty())
      verdict.status = Chart_status::flipped;
    return verdict;
  }

  static Chart_verdict check_overlap(const Chart& chart, const Execution& execution)
  {
    Chart_verdict verdict;
    const std::vector<Triangle_uv> triangles = triangles_uv(chart);
    if (is_overlap_free(triangles, internal::opposite_halfedges(chart.triangles)))
      return verdict;
    verdict.status = Chart_status::overlapping;
    verdict.culprits = triangles_of(find_overlaps(triangles, execution, max_pairs));
    return verdict;
  }

  double max_area_ratio_;
  double area_quantile_;
};

static_assert(ChartValidator<Exact_validator>);

} // namespace Atlas

#endif
