// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_WORST_PLACE_H
#define ATLAS_VALIDATION_INTERNAL_WORST_PLACE_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/measure/distortion.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The inner vertex of a flattened chart around which distortion is largest, and cuts through it.
///
/// Distortion gathers where the surface is curved as no plane is, such as at the tip of a cone, far from the
/// border. A cut that ends there opens the cone; one that goes through it halves the angle that is missing.
class Worst_place
{
public:
  /// What a cut costs at a halfedge of the chart, not negative; infinite where there must be none.
  using Cost = std::function<double(Index)>;

  Worst_place(const Chart& chart, Cost cost)
      : chart_(chart), cost_(std::move(cost)), opposite_(opposite_halfedges(chart.triangles)),
        is_border_(chart.number_of_vertices(), 0), position_(chart.number_of_vertices(), 0)
  {
    index_vertices();
    measure_border();
    find_worst();
  }

  /// The cheapest path of halfedges between the worst vertex and the border, that at the border first; none
  /// if there is no inner vertex.
  std::vector<Index> slit() const
  {
    if (worst_ == no_index)
      return {};
    const Paths paths = search({});
    return paths.to(nearest(paths), chart_);
  }

  /// The part of each triangle, 0 or 1: the cut goes from the worst vertex to the border on either side. Of
  /// all ends the one is taken that gives the shortest cut for the length of border it cuts off. All are 0
  /// if there is no such cut.
  std::vector<Index> parts() const
  {
    std::vector<Index> cut = slit();
    if (cut.empty())
      return std::vector<Index>(chart_.number_of_triangles(), 0);
    const Index start = head(cut.front());
    double length = 0;
    for (const Index h : cut)
      length += edge_length(h);
    std::vector<std::uint8_t> is_closed(chart_.number_of_vertices(), 0);
    for (const Index h : cut)
      is_closed[head(h)] = 1;
    const Paths paths = search(is_closed);
    const std::vector<Index> other = paths.to(opposite_end(paths, start, length), chart_);
    cut.insert(cut.end(), other.begin(), other.end());
    return sides(cut);
  }

private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  /// How often distortion is averaged over neighbours before the worst vertex is looked for: a place is more
  /// than a triangle.
  static constexpr int averaging_rounds = 2;

  /// Cheapest paths from the worst vertex.
  struct Paths
  {
    std::vector<double> cost;   ///< per vertex
    std::vector<Index> arrival; ///< per vertex: the halfedge that leads there

    /// The halfedges of the path from the worst vertex, the last one first.
    std::vector<Index> to(Index v, const Chart& chart) const
    {
      std::vector<Index> path;
      while (v != no_index && arrival[v] != no_index) {
        path.push_back(arrival[v]);
        v = chart.triangles[arrival[v] / 3][arrival[v] % 3];
      }
      return path;
    }
  };

  Index tail(Index h) const { return chart_.triangles[h / 3][h % 3]; }
  Index head(Index h) const { return tail(next_halfedge(h)); }
  double edge_length(Index h) const
  {
    return std::sqrt(CGAL::squared_distance(chart_.points[tail(h)], chart_.points[head(h)]));
  }

  void index_vertices()
  {
    first_.assign(chart_.number_of_vertices() + 1, 0);
    for (Index h = 0; h < opposite_.size(); ++h)
      ++first_[tail(h) + 1];
    for (std::size_t v = 1; v < first_.size(); ++v)
      first_[v] += first_[v - 1];
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    outgoing_.resize(opposite_.size());
    for (Index h = 0; h < opposite_.size(); ++h)
      outgoing_[next[tail(h)]++] = h;
  }

  /// Where border vertices are along the border.
  void measure_border()
  {
    for (const std::vector<Index>& loop : border_loops(opposite_)) {
      double length = 0;
      for (const Index h : loop) {
        is_border_[tail(h)] = 1;
        position_[tail(h)] = length;
        length += edge_length(h);
      }
      perimeter_ = std::max(perimeter_, length);
    }
  }

  /// Calls `visit(w, h)` for the neighbours w of a vertex, which its halfedges h lead to.
  template <typename Visit>
  void for_each_neighbour(Index v, Visit visit) const
  {
    for (Index i = first_[v]; i < first_[v + 1]; ++i)
      visit(head(outgoing_[i]), outgoing_[i]);
  }

  void find_worst()
  {
    std::vector<double> weight(chart_.number_of_vertices(), 0), excess(weight);
    const std::vector<Triangle_distortion> measured = triangle_distortions(chart_);
    const Distortion all = summarize_distortion(measured);
    const double g2 = all.area_uv / all.area_3d;
    for (Index t = 0; t < measured.size(); ++t)
      if (const Triangle_distortion& m = measured[t]; m.is_measurable())
        for (const Index v : chart_.triangles[t]) {
          const double a = g2 * m.largest * m.largest, b = g2 * m.smallest * m.smallest;
          weight[v] += m.area_3d;
          excess[v] += m.area_3d * ((a + b + 1 / a + 1 / b) / 4 - 1);
        }
    for (int round = 0; round < averaging_rounds; ++round) {
      std::vector<double> weights = weight, excesses = excess;
      for (Index v = 0; v < weight.size(); ++v)
        for_each_neighbour(v, [&](Index w, Index) {
          weights[v] += weight[w];
          excesses[v] += excess[w];
        });
      weight.swap(weights);
      excess.swap(excesses);
    }
    double most = 0;
    for (Index v = 0; v < weight.size(); ++v)
      if (!is_border_[v] && weight[v] > 0 && excess[v] / weight[v] > most) {
        most = excess[v] / weight[v];
        worst_ = v;
      }
  }

  /// Dijkstra over inner edges up to the border, not through closed vertices.
  Paths search(const std::vector<std::uint8_t>& is_closed) const
  {
    Paths paths{std::vector<double>(chart_.number_of_vertices(), infinite),
                std::vector<Index>(chart_.number_of_vertices(), no_index)};
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    paths.cost[worst_] = 0;
    queue.emplace(0, worst_);
    while (!queue.empty()) {
      const double cost = queue.top().first;
      const Index v = queue.top().second;
      queue.pop();
      if (cost > paths.cost[v] || is_border_[v])
        continue;
      for_each_neighbour(v, [&](Index w, Index h) {
        if (opposite_[h] == no_index || w == worst_ || (!is_closed.empty() && is_closed[w]))
          return;
        if (const double there = cost + cost_(h); there < paths.cost[w]) {
          paths.cost[w] = there;
          paths.arrival[w] = h;
          queue.emplace(there, w);
        }
      });
    }
    return paths;
  }

  Index nearest(const Paths& paths) const
  {
    Index best = no_index;
    for (Index v = 0; v < is_border_.size(); ++v)
      if (is_border_[v] && std::isfinite(paths.cost[v]) &&
          (best == no_index || paths.cost[v] < paths.cost[best]))
        best = v;
    return best;
  }

  /// \param length  of the cut so far, that ends on the border at `start`
  Index opposite_end(const Paths& paths, Index start, double length) const
  {
    Index best = no_index;
    double least = infinite;
    for (Index v = 0; v < is_border_.size(); ++v) {
      if (!is_border_[v] || v == start || !std::isfinite(paths.cost[v]))
        continue;
      const double way = std::abs(position_[v] - position_[start]);
      const double cut_off = std::min(way, perimeter_ - way);
      if (const double ratio = (length + paths.cost[v]) / cut_off; ratio < least) {
        least = ratio;
        best = v;
      }
    }
    return best;
  }

  std::vector<Index> sides(const std::vector<Index>& cut) const
  {
    std::vector<std::uint8_t> is_cut(opposite_.size(), 0);
    for (const Index h : cut)
      is_cut[h] = is_cut[opposite_[h]] = 1;
    return connected_components(
               opposite_, [](Index) { return true; }, [&](Index h) { return !is_cut[h]; })
        .of_triangle;
  }

  const Chart& chart_;
  Cost cost_;
  std::vector<Index> opposite_, first_, outgoing_; ///< halfedges by their tails
  std::vector<std::uint8_t> is_border_;
  std::vector<double> position_;
  double perimeter_ = 0;
  Index worst_ = no_index;
};

} // namespace Atlas::internal

#endif
