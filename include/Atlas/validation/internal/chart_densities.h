// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_CHART_DENSITIES_H
#define ATLAS_VALIDATION_INTERNAL_CHART_DENSITIES_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/area_in_space.h>
#include <Atlas/validation/internal/Chart_graph.h>
#include <Atlas/validation/internal/split_chart.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// How much model area there is per texture area in the triangles of a chart (Levy et al. 2002, section 3.3).
class Chart_densities
{
public:
  /// \param quantile  share of the area in space that is left out at either end when extremes are looked for
  Chart_densities(const Chart& chart, double quantile)
      : logarithm_(chart.number_of_triangles(), std::numeric_limits<double>::quiet_NaN())
  {
    std::vector<double> area(logarithm_.size(), 0);
    for (std::size_t t = 0; t < logarithm_.size(); ++t) {
      const auto& [a, b, c] = chart.triangles[t];
      if (!has_area(chart.points[a], chart.points[b], chart.points[c]))
        continue;
      area[t] = std::sqrt(CGAL::squared_area(chart.points[a], chart.points[b], chart.points[c]));
      logarithm_[t] = std::log(area[t]) - std::log(CGAL::area(chart.uv[a], chart.uv[b], chart.uv[c]));
    }
    find_extremes(area, quantile);
  }

  /// The ratio of the largest to the smallest is above the bound, unless that is 0 or infinite.
  Chart_verdict check(double max_ratio) const
  {
    if (max_ratio == 0 || low_ == no_index || !(logarithm_[high_] - logarithm_[low_] > std::log(max_ratio)))
      return {};
    return {Chart_status::area_ratio_exceeded, {std::min(low_, high_), std::max(low_, high_)}};
  }

  /// Two parts grown from the extreme triangles; steps towards triangles of another density are longer.
  std::vector<Index> split(const Chart_graph& graph) const
  {
    if (low_ == high_)
      return std::vector<Index>(graph.size(), 0);
    return nearer_of(distances(graph, low_), distances(graph, high_));
  }

private:
  /// A step to a triangle of the density at the other end of the range is so many times longer.
  static constexpr double density_cost = 8;

  void find_extremes(const std::vector<double>& area, double quantile)
  {
    std::vector<Index> order;
    double total = 0;
    for (Index t = 0; t < area.size(); ++t)
      if (std::isfinite(logarithm_[t])) {
        order.push_back(t);
        total += area[t];
      }
    if (order.empty())
      return;
    std::sort(order.begin(), order.end(), [&](Index s, Index t) {
      return logarithm_[s] != logarithm_[t] ? logarithm_[s] < logarithm_[t] : s < t;
    });
    const auto at_share = [&](auto first, auto last) {
      double sum = area[*first];
      while (sum <= quantile * total && std::next(first) != last)
        sum += area[*++first];
      return *first;
    };
    low_ = at_share(order.begin(), order.end());
    high_ = at_share(order.rbegin(), order.rend());
  }

  std::vector<double> distances(const Chart_graph& graph, Index seed) const
  {
    const double range = logarithm_[high_] - logarithm_[low_];
    return graph.distances(seed, [&](Index t) {
      const double off = std::abs(logarithm_[t] - logarithm_[seed]) / range;
      return std::isfinite(off) ? 1 + density_cost * std::min(off, 1.0) : 1.0;
    });
  }

  std::vector<double> logarithm_; ///< per triangle, of (area in space / area in the plane); NaN without area
  Index low_ = no_index, high_ = no_index; ///< the extreme triangles
};

} // namespace Atlas::internal

#endif
