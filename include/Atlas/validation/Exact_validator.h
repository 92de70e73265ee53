// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_EXACT_VALIDATOR_H
#define ATLAS_VALIDATION_EXACT_VALIDATOR_H

#include <Atlas/concepts.h>
#include <Atlas/internal/area_in_space.h>
#include <Atlas/internal/split_chart.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
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
      verdict = check_area_ratio(chart);
    if (execution.is_cancelled())
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
  /// - anything else: two halves.
  /// - a chart that is not connected falls into its components, whatever the verdict.
  ///
  /// Parts are numbered in the order of their first triangle; there are at least two if the chart has
  /// more than one triangle. Every part has fewer triangles than the chart and a single triangle is always
  /// accepted once it is flattened, so repeated splitting ends. O(n log n).
  std::vector<Index> split(const Chart& chart, const Chart_verdict& verdict) const
  {
    const internal::Chart_graph graph(chart);
    auto [parts, components] = graph.components([](Index) { return true; });
    if (components > 1)
      return parts;
    if (check_numbers(chart).is_valid()) {
      if (verdict.status == Chart_status::overlapping)
        parts = split_overlap(chart, graph);
      else if (verdict.status == Chart_status::area_ratio_exceeded)
        parts = split_densities(chart, graph);
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
  /// A step to a triangle of the density at the other end of the range is so many times longer.
  static constexpr double density_cost = 8;

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

  static Chart_verdict check_orientation(const Chart& chart)
  {
    Chart_verdict verdict;
    for (Index t = 0; t < chart.number_of_triangles(); ++t) {
      const auto& [a, b, c] = chart.triangles[t];
      const CGAL::Orientation o = CGAL::orientation(chart.uv[a], chart.uv[b], chart.uv[c]);
      if (o == CGAL::RIGHT_TURN || (o == CGAL::COLLINEAR && has_area(chart, t)))
        verdict.culprits.push_back(t);
    }
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
    for (const auto& [s, t] : find_overlaps(triangles, execution, max_pairs).pairs) {
      verdict.culprits.push_back(s);
      verdict.culprits.push_back(t);
    }
    std::sort(verdict.culprits.begin(), verdict.culprits.end());
    verdict.culprits.erase(std::unique(verdict.culprits.begin(), verdict.culprits.end()),
                           verdict.culprits.end());
    return verdict;
  }

  /// Per triangle the logarithm of (area in space / area in the plane); NaN where there is no area in space.
  static std::vector<double> log_densities(const Chart& chart)
  {
    std::vector<double> result(chart.number_of_triangles(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t t = 0; t < result.size(); ++t) {
      const auto& [a, b, c] = chart.triangles[t];
      if (has_area(chart, t))
        result[t] = 0.5 * std::log(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c])) -
                    std::log(CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]));
    }
    return result;
  }

  /// The triangles of smallest and largest density, when the quantile has been left out at either end.
  std::pair<Index, Index> extreme_triangles(const Chart& chart, const std::vector<double>& densities) const
  {
    std::vector<Index> order;
    double total = 0;
    const auto area = [&](Index t) {
      const auto& [a, b, c] = chart.triangles[t];
      return std::sqrt(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c]));
    };
    for (Index t = 0; t < densities.size(); ++t)
      if (std::isfinite(densities[t])) {
        order.push_back(t);
        total += area(t);
      }
    if (order.empty())
      return {no_index, no_index};
    std::sort(order.begin(), order.end(), [&](Index s, Index t) {
      return densities[s] != densities[t] ? densities[s] < densities[t] : s < t;
    });
    const auto at_share = [&](auto first, auto last) {
      double sum = area(*first);
      while (sum <= area_quantile_ * total && std::next(first) != last)
        sum += area(*++first);
      return *first;
    };
    return {at_share(order.begin(), order.end()), at_share(order.rbegin(), order.rend())};
  }

  Chart_verdict check_area_ratio(const Chart& chart) const
  {
    Chart_verdict verdict;
    if (max_area_ratio_ == 0 || std::isinf(max_area_ratio_))
      return verdict;
    const std::vector<double> densities = log_densities(chart);
    const auto [low, high] = extreme_triangles(chart, densities);
    if (low != no_index && densities[high] - densities[low] > std::log(max_area_ratio_))
      verdict = {Chart_status::area_ratio_exceeded, {std::min(low, high), std::max(low, high)}};
    return verdict;
  }

  static std::vector<Index> split_overlap(const Chart& chart, const internal::Chart_graph& graph)
  {
    const Overlaps overlaps = find_overlaps(triangles_uv(chart), Execution(), max_pairs);
    if (overlaps.pairs.empty())
      return std::vector<Index>(graph.size(), 0);
    const internal::Overlapped_zone zone(graph, overlaps.pairs);
    if (overlaps.is_complete && !zone.overlaps_itself())
      return internal::cut_off(chart, graph, zone);

    // The two sheets hang together inside the zone: part them between two triangles far apart that overlap.
    std::vector<double> distance = graph.distances(overlaps.pairs.front().first);
    const auto span = [&](const std::pair<Index, Index>& p) {
      return std::abs(distance[p.first] - distance[p.second]);
    };
    const auto far = *std::max_element(overlaps.pairs.begin(), overlaps.pairs.end(),
                                       [&](const auto& p, const auto& q) { return span(p) < span(q); });
    return internal::nearer_of(graph.distances(far.first), graph.distances(far.second));
  }

  std::vector<Index> split_densities(const Chart& chart, const internal::Chart_graph& graph) const
  {
    const std::vector<double> densities = log_densities(chart);
    const auto [low, high] = extreme_triangles(chart, densities);
    if (low == no_index || low == high)
      return std::vector<Index>(graph.size(), 0);
    const double range = densities[high] - densities[low];
    const auto distances = [&](Index seed) {
      return graph.distances(seed, [&](Index t) {
        const double off = std::abs(densities[t] - densities[seed]) / range;
        return std::isfinite(off) ? 1 + density_cost * std::min(off, 1.0) : 1.0;
      });
    };
    return internal::nearer_of(distances(low), distances(high));
  }

  double max_area_ratio_;
  double area_quantile_;
};

static_assert(ChartValidator<Exact_validator>);

} // namespace Atlas

#endif
