// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_BORDER_H
#define ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_BORDER_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Per vertex, its neighbours: [first[v], first[v+1]) of `neighbor`; one may occur twice.
struct Vertex_adjacency
{
  std::vector<std::size_t> first;
  std::vector<Index> neighbor;

  explicit Vertex_adjacency(const Chart& chart) : first(chart.number_of_vertices() + 1, 0)
  {
    // Every vertex knows the next corner of each of its triangles, and the previous one only where the fan
    // of triangles begins; but finding that out costs more than storing edges twice.
    for (const auto& corner : chart.triangles)
      for (const Index v : corner)
        first[v + 1] += 2;
    for (std::size_t v = 0; v + 1 < first.size(); ++v)
      first[v + 1] += first[v];
    neighbor.resize(first.back());
    std::vector<std::size_t> place(first.begin(), first.end() - 1);
    for (const auto& corner : chart.triangles)
      for (int i = 0; i < 3; ++i) {
        neighbor[place[corner[i]]++] = corner[(i + 1) % 3];
        neighbor[place[corner[i]]++] = corner[(i + 2) % 3];
      }
  }
};

/// Which vertices are on the border. Around an inner vertex the triangles lead out to each neighbour as often
/// as they lead in from it, so that no edges need to be matched. O(n).
inline std::vector<bool> border_vertices(const Chart& chart)
{
  std::vector<long long> balance(chart.number_of_vertices(), 0);
  for (const auto& corner : chart.triangles)
    for (int i = 0; i < 3; ++i)
      balance[corner[i]] +=
          static_cast<long long>(corner[(i + 1) % 3]) - static_cast<long long>(corner[(i + 2) % 3]);
  std::vector<bool> result(balance.size());
  for (std::size_t v = 0; v < balance.size(); ++v)
    result[v] = balance[v] != 0;
  return result;
}

inline constexpr double detour = 4;

/// The vertex farthest from `start` along edges among `candidates`, and its distance. No vertex counts for
/// more than `detour` times its distance in space: the two copies of a place on a slit are far from each
/// other along edges, but a map that keeps shapes puts them into one place again. O(n log n).
inline std::pair<Index, double> farthest_vertex(const Chart_geometry& geometry,
                                                const Vertex_adjacency& adjacency, Index start,
                                                const std::vector<bool>& candidates)
{
  std::vector<double> distance(geometry.number_of_vertices(), std::numeric_limits<double>::infinity());
  using Item = std::pair<double, Index>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  distance[start] = 0;
  queue.emplace(0, start);
  std::pair<Index, double> best(start, 0);
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance[v])
      continue;
    if (const double far = std::min(d, detour * geometry.distance(start, v));
        candidates[v] && far > best.second)
      best = {v, far};
    for (std::size_t k = adjacency.first[v]; k < adjacency.first[v + 1]; ++k) {
      const Index w = adjacency.neighbor[k];
      const double through = d + geometry.distance(v, w);
      if (through < distance[w]) {
        distance[w] = through;
        queue.emplace(through, w);
      }
    }
  }
  return best;
}

/// Two different vertices far apart, on the border where there is one: the ends of a double sweep of shortest
/// paths, which on most charts is the graph diameter that the LSCM paper asks for.
inline std::array<Index, 2> far_apart_vertices(const Chart_geometry& geometry)
{
  const Chart& chart = geometry.chart();
  const Vertex_adjacency adjacency(chart);
  std::vector<bool> candidates = border_vertices(chart);
  Index start = no_index;
  for (Index v = 0; v < candidates.size() && start == no_index; ++v)
    if (candidates[v])
      start = v;
  if (start == no_index) {
    candidates.assign(candidates.size(), true);
    start = chart.triangles.front()[0];
  }
  const Index first = farthest_vertex(geometry, adjacency, start, candidates).first;
  const Index second = farthest_vertex(geometry, adjacency, first, candidates).first;
  if (second != first)
    return {first, second};
  // All vertices in one place, or a single one on the border: any other vertex will do.
  for (std::size_t k = adjacency.first[first]; k < adjacency.first[first + 1]; ++k)
    if (adjacency.neighbor[k] != first)
      return {first, adjacency.neighbor[k]};
  return {first, first == 0 ? Index(1) : Index(0)};
}

} // namespace Atlas::internal

#endif
