// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_SPLIT_CHART_H
#define ATLAS_VALIDATION_INTERNAL_SPLIT_CHART_H

#include <Atlas/core/Chart.h>
#include <Atlas/validation/internal/Chart_graph.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Whether there are at least two different numbers.
inline bool is_split(const std::vector<Index>& parts)
{
  return std::any_of(parts.begin(), parts.end(), [&](Index p) { return p != parts.front(); });
}

/// Two parts: what is nearer to one triangle, and what is nearer to the other.
inline std::vector<Index> nearer_of(const std::vector<double>& to_first, const std::vector<double>& to_second)
{
  std::vector<Index> parts(to_first.size());
  for (std::size_t t = 0; t < parts.size(); ++t)
    parts[t] = to_second[t] < to_first[t];
  return parts;
}

/// Two parts with the same number of triangles, or one more in the second: cut along a level of (distance to
/// one end of a longest path - distance to its other end).
inline std::vector<Index> halve(const Chart_graph& graph)
{
  std::vector<Index> parts(graph.size(), 0), order(graph.size());
  if (graph.size() < 2)
    return parts;
  const std::vector<double> to_end = graph.distances(farthest(graph.distances(0)));
  const std::vector<double> to_other = graph.distances(farthest(to_end));
  std::vector<double> level(graph.size());
  for (std::size_t t = 0; t < level.size(); ++t)
    level[t] = std::isfinite(to_end[t]) && std::isfinite(to_other[t]) ? to_end[t] - to_other[t] : 0;
  std::iota(order.begin(), order.end(), Index(0));
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  std::nth_element(order.begin(), middle, order.end(),
                   [&](Index s, Index t) { return level[s] != level[t] ? level[s] < level[t] : s < t; });
  for (auto i = middle; i != order.end(); ++i)
    parts[*i] = 1;
  return parts;
}

/// Two parts with a cut through the triangles to blame, half of them on either side: along the level of
/// (distance to one end of the chart - distance to the other end) that is their median.
inline std::vector<Index> cut_through(const Chart_graph& graph, std::span<const Index> culprits)
{
  std::vector<Index> parts(graph.size(), 0);
  if (culprits.empty())
    return parts;
  const std::vector<double> to_end = graph.distances(farthest(graph.distances(culprits.front())));
  const std::vector<double> to_other = graph.distances(farthest(to_end));
  std::vector<double> levels;
  for (const Index t : culprits)
    if (std::isfinite(to_end[t]))
      levels.push_back(to_end[t] - to_other[t]);
  if (levels.empty())
    return parts;
  const auto median = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::nth_element(levels.begin(), median, levels.end());
  for (std::size_t t = 0; t < parts.size(); ++t)
    parts[t] = !(to_end[t] - to_other[t] < *median);
  return parts;
}

/// Two parts: the triangles to blame, together with the small ones next to them, and the rest. For what is
/// too small for the numbers that coordinates are rounded to: as a chart of its own it gets a scale of its
/// own.
inline std::vector<Index> cut_off_small(const Chart& chart, const Chart_graph& graph,
                                        std::span<const Index> culprits)
{
  // Next to what does not survive the rounding there is what barely does.
  constexpr double margin = 8;
  // From this part of the chart on triangles are not small, only thin.
  constexpr double largest_small = 1.0 / 256;
  const auto size = [&](Index t) {
    const auto& [a, b, c] = chart.triangles[t];
    return std::sqrt(std::max({CGAL::squared_distance(chart.uv[a], chart.uv[b]),
                               CGAL::squared_distance(chart.uv[b], chart.uv[c]),
                               CGAL::squared_distance(chart.uv[c], chart.uv[a])}));
  };
  const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
  const double extent = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  double limit = 0;
  for (const Index t : culprits)
    if (const double reach = margin * size(t); reach <= largest_small * extent)
      limit = std::max(limit, reach);
  std::vector<Index> parts(graph.size(), 0), stack(culprits.begin(), culprits.end());
  for (const Index t : culprits)
    parts[t] = 1;
  while (!stack.empty()) {
    const Index t = stack.back();
    stack.pop_back();
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (const Index o = graph.opposite(h); o != no_index && parts[o / 3] == 0 && size(o / 3) <= limit) {
        parts[o / 3] = 1;
        stack.push_back(o / 3);
      }
  }
  return parts;
}

/// The zone in which a chart covers itself, as pieces that hang together over edges.
struct Overlapped_zone
{
  std::vector<Index> piece; ///< per triangle, `no_index` outside of the zone
  Index number_of_pieces = 0;
  std::set<std::pair<Index, Index>> conflicts; ///< pieces that overlap each other, or themselves

  Overlapped_zone(const Chart_graph& graph, const std::vector<std::pair<Index, Index>>& pairs)
  {
    std::vector<bool> is_in(graph.size(), false);
    for (const auto& [s, t] : pairs)
      is_in[s] = is_in[t] = true;
    std::tie(piece, number_of_pieces) = graph.components([&](Index t) { return is_in[t]; });
    for (const auto& [s, t] : pairs)
      conflicts.insert(std::minmax(piece[s], piece[t]));
  }

  bool overlaps_itself() const
  {
    return std::any_of(conflicts.begin(), conflicts.end(), [](const auto& c) { return c.first == c.second; });
  }

  /// Pieces that have to go so that no two of those that stay overlap: again and again the one with the most
  /// overlaps for the length of its border.
  std::vector<bool> pieces_to_remove(const Chart& chart, const Chart_graph& graph) const
  {
    std::vector<double> border(number_of_pieces, 0);
    for (Index h = 0; h < 3 * graph.size(); ++h)
      if (const Index o = graph.opposite(h);
          piece[h / 3] != no_index && o != no_index && piece[o / 3] != piece[h / 3]) {
        const Index g = next_halfedge(h);
        border[piece[h / 3]] += std::sqrt(CGAL::squared_distance(
            chart.points[chart.triangles[h / 3][h % 3]], chart.points[chart.triangles[g / 3][g % 3]]));
      }
    std::vector<Index> degree(number_of_pieces, 0), order(number_of_pieces);
    for (const auto& [a, b] : conflicts) {
      ++degree[a];
      ++degree[b];
    }
    std::iota(order.begin(), order.end(), Index(0));
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const double p = degree[a] * border[b], q = degree[b] * border[a];
      return p != q ? p > q : a < b;
    });
    // In this order a piece goes if it still overlaps one that comes later, or has been kept.
    std::vector<bool> removed(number_of_pieces, false);
    std::vector<std::vector<Index>> others(number_of_pieces);
    for (const auto& [a, b] : conflicts) {
      others[a].push_back(b);
      others[b].push_back(a);
    }
    for (const Index a : order)
      removed[a] = std::any_of(others[a].begin(), others[a].end(), [&](Index b) { return !removed[b]; });
    return removed;
  }
};

/// Cuts along the border of the overlapped zone: pieces of it become parts of their own, as few as will do.
/// What is cut off from the bulk of the chart by such a piece stays with it.
inline std::vector<Index> cut_off(const Chart& chart, const Chart_graph& graph, const Overlapped_zone& zone)
{
  const std::vector<bool> removed = zone.pieces_to_remove(chart, graph);
  const auto is_removed = [&](Index t) { return zone.piece[t] != no_index && removed[zone.piece[t]]; };
  const auto [rest, count] = graph.components([&](Index t) { return !is_removed(t); });

  std::vector<Index> sizes(count, 0), neighbour(count, no_index);
  std::vector<bool> is_clean(count, true);
  for (Index t = 0; t < graph.size(); ++t)
    if (rest[t] != no_index) {
      ++sizes[rest[t]];
      if (zone.piece[t] != no_index)
        is_clean[rest[t]] = false;
    }
  for (Index h = 0; h < 3 * graph.size(); ++h)
    if (const Index o = graph.opposite(h); o != no_index && rest[h / 3] != no_index &&
                                           rest[o / 3] == no_index && neighbour[rest[h / 3]] == no_index)
      neighbour[rest[h / 3]] = zone.piece[o / 3];

  const auto bulk = static_cast<Index>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<Index> parts(graph.size());
  for (Index t = 0; t < graph.size(); ++t) {
    const Index r = rest[t];
    if (r == no_index)
      parts[t] = 1 + zone.piece[t];
    else if (r == bulk)
      parts[t] = 0;
    else if (is_clean[r] && neighbour[r] != no_index)
      parts[t] = 1 + neighbour[r];
    else
      parts[t] = 1 + zone.number_of_pieces + r;
  }
  return parts;
}

/// Parts such that the given overlaps are between different ones, if they are complete.
inline std::vector<Index> split_overlap(const Chart& chart, const Chart_graph& graph,
                                        const Overlaps& overlaps)
{
  if (overlaps.pairs.empty())
    return std::vector<Index>(graph.size(), 0);
  const Overlapped_zone zone(graph, overlaps.pairs);
  if (overlaps.is_complete && !zone.overlaps_itself())
    return cut_off(chart, graph, zone);

  // The sheets hang together inside the zone: part them between two triangles far apart that overlap.
  const std::vector<double> distance = graph.distances(overlaps.pairs.front().first);
  const auto span = [&](const auto& p) { return std::abs(distance[p.first] - distance[p.second]); };
  const auto [s, t] = *std::max_element(overlaps.pairs.begin(), overlaps.pairs.end(),
                                        [&](const auto& p, const auto& q) { return span(p) < span(q); });
  return nearer_of(graph.distances(s), graph.distances(t));
}

/// The same parts with numbers 0, 1, ... in the order of their first triangle.
inline std::vector<Index> renumber(std::vector<Index> parts)
{
  std::vector<Index> name;
  Index count = 0;
  for (Index& part : parts) {
    if (part >= name.size())
      name.resize(part + std::size_t(1), no_index);
    if (name[part] == no_index)
      name[part] = count++;
    part = name[part];
  }
  return parts;
}

} // namespace Atlas::internal

#endif
