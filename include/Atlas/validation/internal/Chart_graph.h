// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_CHART_GRAPH_H
#define ATLAS_VALIDATION_INTERNAL_CHART_GRAPH_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/halfedges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The triangles of a chart and how far neighbours are from each other in space: what is needed to grow
/// parts.
class Chart_graph
{
public:
  explicit Chart_graph(const Chart& chart) : opposite_(opposite_halfedges(chart.triangles))
  {
    centroids_.reserve(chart.number_of_triangles());
    for (const auto& [a, b, c] : chart.triangles)
      centroids_.push_back(CGAL::centroid(chart.points[a], chart.points[b], chart.points[c]));
  }

  std::size_t size() const { return centroids_.size(); }
  Index opposite(Index h) const { return opposite_[h]; }

  /// Lengths of the shortest paths over edges from triangle to triangle; infinite where there is none. The
  /// length of a step is multiplied by `cost(triangle it leads to)`, at least 1. O(n log n).
  template <typename Cost>
  std::vector<double> distances(Index source, Cost cost) const
  {
    using Entry = std::pair<double, Index>;
    std::vector<double> distance(size(), std::numeric_limits<double>::infinity());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance[source] = 0;
    queue.emplace(0, source);
    while (!queue.empty()) {
      const auto [d, t] = queue.top();
      queue.pop();
      if (d > distance[t])
        continue;
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        if (opposite_[h] == no_index)
          continue;
        const Index n = opposite_[h] / 3;
        const double there = d + cost(n) * std::sqrt(CGAL::squared_distance(centroids_[t], centroids_[n]));
        if (there < distance[n]) {
          distance[n] = there;
          queue.emplace(there, n);
        }
      }
    }
    return distance;
  }
  std::vector<double> distances(Index source) const
  {
    return distances(source, [](Index) { return 1; });
  }

  /// Numbers the connected components of the triangles with `is_in`, all others get `no_index`.
  template <typename Predicate>
  std::pair<std::vector<Index>, Index> components(Predicate is_in) const
  {
    Components result = connected_components(opposite_, is_in, [](Index) { return true; });
    return {std::move(result.of_triangle), result.count};
  }

private:
  std::vector<Index> opposite_;
  std::vector<Point_3> centroids_;
};

/// The triangle at the largest finite distance, the first of equals.
inline Index farthest(const std::vector<double>& distance)
{
  Index best = 0;
  for (Index t = 1; t < distance.size(); ++t)
    if (std::isfinite(distance[t]) && (!std::isfinite(distance[best]) || distance[t] > distance[best]))
      best = t;
  return best;
}

} // namespace Atlas::internal

#endif
