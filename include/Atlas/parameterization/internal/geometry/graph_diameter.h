// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_GRAPH_DIAMETER_H
#define ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_GRAPH_DIAMETER_H

#include <Atlas/parameterization/internal/geometry/border.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Two vertices and the length of the shortest path along edges between them.
struct Graph_diameter
{
  Index first = no_index, second = no_index;
  double length = 0;
  bool is_exact = false; ///< whether no two candidates are farther apart
};

/// \brief The two of some vertices of a chart that are farthest from each other along edges.
///
/// Shortest paths are computed from one vertex after another. Each time the triangle inequality bounds from
/// both sides how far any vertex is from the one farthest from it, until no vertex is left whose bound is
/// above the longest path found (F. Takes, W. Kosters, Determining the diameter of small world networks, CIKM
/// 2011). Long charts need a few sources, round ones all of their border.
class Graph_diameter_search
{
public:
  /// \param candidates  per vertex: whether it may be an end
  Graph_diameter_search(const Chart_geometry& geometry, const std::vector<bool>& candidates)
      : geometry_(geometry), adjacency_(geometry.chart())
  {
    for (Index v = 0; v < candidates.size(); ++v)
      if (candidates[v] && adjacency_.first[v] < adjacency_.first[v + 1])
        open_.push_back({v, 0, std::numeric_limits<double>::infinity()});
  }

  /// \param most_visits  when so many vertices have been visited, the longest path so far is the answer
  Graph_diameter run(std::size_t most_visits)
  {
    std::size_t visits = 0;
    // The first two sources make a double sweep; then those with the largest and the smallest bound in turn.
    Index source = open_.empty() ? no_index : open_.front().vertex;
    for (std::size_t round = 0; source != no_index; ++round) {
      if (round > 1 && visits + geometry_.number_of_vertices() > most_visits)
        return best_;
      visits += geometry_.number_of_vertices();
      const Index farthest = sweep(source);
      source = round == 0 ? farthest : next_source(round % 2 == 0);
    }
    best_.is_exact = true;
    return best_;
  }

private:
  /// A candidate, and how far from it the farthest one is.
  struct Candidate
  {
    Index vertex;
    double least, most;
  };

  /// From a source to all others; returns the farthest candidate, or none if there is no other.
  Index sweep(Index source)
  {
    find_distances(source);
    Index farthest = no_index;
    double eccentricity = 0;
    for (const Candidate& c : open_)
      if (const double d = distance_[c.vertex]; d < infinity && d > eccentricity) {
        eccentricity = d;
        farthest = c.vertex;
      }
    if (eccentricity > best_.length)
      best_ = {source, farthest, eccentricity, false};
    for (Candidate& c : open_) {
      const double d = distance_[c.vertex];
      c.least = std::max({c.least, d, eccentricity - d});
      c.most = c.vertex == source ? 0 : std::min(c.most, eccentricity + d);
    }
    // Rounding must not keep those that cannot do better.
    std::erase_if(open_, [&](const Candidate& c) { return c.most <= best_.length * (1 + 1e-12); });
    return farthest;
  }

  Index next_source(bool is_largest) const
  {
    const auto best = is_largest
                          ? std::max_element(open_.begin(), open_.end(),
                                             [](const auto& a, const auto& b) { return a.most < b.most; })
                          : std::min_element(open_.begin(), open_.end(),
                                             [](const auto& a, const auto& b) { return a.least < b.least; });
    return best == open_.end() ? no_index : best->vertex;
  }

  void find_distances(Index source)
  {
    using Item = std::pair<double, Index>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    distance_.assign(geometry_.number_of_vertices(), infinity);
    distance_[source] = 0;
    queue.emplace(0, source);
    while (!queue.empty()) {
      const auto [d, v] = queue.top();
      queue.pop();
      if (d > distance_[v])
        continue;
      for (std::size_t k = adjacency_.first[v]; k < adjacency_.first[v + 1]; ++k) {
        const Index w = adjacency_.neighbor[k];
        const double through = d + geometry_.distance(v, w);
        if (through < distance_[w]) {
          distance_[w] = through;
          queue.emplace(through, w);
        }
      }
    }
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  const Chart_geometry& geometry_;
  Vertex_adjacency adjacency_;
  std::vector<Candidate> open_; ///< those that may be an end of a longer path
  std::vector<double> distance_;
  Graph_diameter best_;
};

} // namespace Atlas::internal

#endif
