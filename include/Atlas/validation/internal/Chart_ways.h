// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_CHART_WAYS_H
#define ATLAS_VALIDATION_INTERNAL_CHART_WAYS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/halfedges.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The vertices of a chart, and cheapest ways between them over inner edges. The chart must outlive
/// this object.
class Chart_ways
{
public:
  explicit Chart_ways(const Chart& chart)
      : chart_(chart), opposite_(opposite_halfedges(chart.triangles)),
        is_border_(chart.number_of_vertices(), 0), first_(chart.number_of_vertices() + 1, 0),
        outgoing_(opposite_.size())
  {
    for (Index h = 0; h < opposite_.size(); ++h) {
      ++first_[tail(h) + 1];
      if (opposite_[h] == no_index)
        is_border_[tail(h)] = is_border_[head(h)] = 1;
    }
    for (std::size_t v = 1; v < first_.size(); ++v)
      first_[v] += first_[v - 1];
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (Index h = 0; h < opposite_.size(); ++h)
      outgoing_[next[tail(h)]++] = h;
  }

  Index tail(Index h) const { return chart_.triangles[h / 3][h % 3]; }
  Index head(Index h) const { return tail(next_halfedge(h)); }
  bool is_border(Index v) const { return is_border_[v] != 0; }
  const std::vector<Index>& opposite() const { return opposite_; }
  std::size_t number_of_vertices() const { return is_border_.size(); }

  /// In space.
  double length(Index h) const
  {
    return std::sqrt(CGAL::squared_distance(chart_.points[tail(h)], chart_.points[head(h)]));
  }

  double length(const std::vector<Index>& way) const
  {
    double sum = 0;
    for (const Index h : way)
      sum += length(h);
    return sum;
  }

  /// Calls `visit(w, h)` for the neighbours w of a vertex, which its halfedges h lead to.
  template <typename Visit>
  void for_each_neighbour(Index v, Visit visit) const
  {
    for (Index i = first_[v]; i < first_[v + 1]; ++i)
      visit(head(outgoing_[i]), outgoing_[i]);
  }

  /// Cheapest ways from some vertices.
  struct Ways
  {
    std::vector<double> cost;   ///< per vertex
    std::vector<Index> arrival; ///< per vertex: the halfedge that leads there
  };

  /// Cheapest ways over inner edges. They end at the border, and at closed vertices. O(n log n).
  /// \param cost       of a halfedge, not negative; infinite where there must be no way
  /// \param is_closed  per vertex; empty: none
  template <typename Cost>
  Ways from(const std::vector<Index>& starts, Cost cost,
            const std::vector<std::uint8_t>& is_closed = {}) const
  {
    Ways ways{std::vector<double>(number_of_vertices(), std::numeric_limits<double>::infinity()),
              std::vector<Index>(number_of_vertices(), no_index)};
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Index v : starts) {
      ways.cost[v] = 0;
      queue.emplace(0, v);
    }
    while (!queue.empty()) {
      const double so_far = queue.top().first;
      const Index v = queue.top().second;
      queue.pop();
      const bool is_start = ways.arrival[v] == no_index;
      if (so_far > ways.cost[v] || (is_border(v) && !is_start))
        continue;
      for_each_neighbour(v, [&](Index w, Index h) {
        if (opposite_[h] == no_index || (!is_closed.empty() && is_closed[w]))
          return;
        if (const double there = so_far + cost(h); there < ways.cost[w]) {
          ways.cost[w] = there;
          ways.arrival[w] = h;
          queue.emplace(there, w);
        }
      });
    }
    return ways;
  }

  /// The halfedges of the way to a vertex, the last one first.
  std::vector<Index> way_to(const Ways& ways, Index v) const
  {
    std::vector<Index> way;
    while (v != no_index && ways.arrival[v] != no_index) {
      way.push_back(ways.arrival[v]);
      v = tail(ways.arrival[v]);
    }
    return way;
  }

private:
  const Chart& chart_;
  std::vector<Index> opposite_;
  std::vector<std::uint8_t> is_border_; ///< per vertex
  std::vector<Index> first_, outgoing_; ///< halfedges by their tails
};

} // namespace Atlas::internal

#endif
