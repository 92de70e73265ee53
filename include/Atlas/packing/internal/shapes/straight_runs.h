// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_STRAIGHT_RUNS_H
#define ATLAS_PACKING_INTERNAL_SHAPES_STRAIGHT_RUNS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/core/internal/halfedges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// A part of a chart's border that is straight and parallel to an axis.
struct Straight_run
{
  double low = 0, high = 0; ///< of the coordinate that its vertices share
  double length = 0;
  std::vector<Index> vertices;

  double coordinate() const { return low + (high - low) / 2; }
};

/// The straight runs of a border along which one coordinate stays the same within `tolerance`: x where
/// `across` is 0, y where it is 1. Edges shorter than 64 times that tell no direction. O(n log n).
inline std::vector<Straight_run> straight_runs(const Chart& chart, int across, double tolerance)
{
  const std::vector<Index> opposite = opposite_halfedges(chart.triangles);
  const auto vertex = [&](Index h) { return chart.triangles[h / 3][h % 3]; };
  Union_find parts(chart.uv.size());
  std::vector<std::pair<Index, double>> edges; // a vertex and the length
  for (Index h = 0; h < opposite.size(); ++h) {
    if (opposite[h] != no_index)
      continue;
    const Index i = vertex(h), j = vertex(next_halfedge(h));
    const Vector_2 d = chart.uv[j] - chart.uv[i];
    const double along = std::abs(d[1 - across]), off = std::abs(d[across]);
    if (!(off <= tolerance) || !(along >= 64 * tolerance))
      continue;
    parts.unite(i, j);
    edges.emplace_back(i, along);
  }
  std::map<Index, Straight_run> runs;
  for (const auto& [v, along] : edges)
    runs[parts.find(v)].length += along;
  for (Index v = 0; v < chart.uv.size(); ++v)
    if (const auto run = runs.find(parts.find(v)); run != runs.end())
      run->second.vertices.push_back(v);
  std::vector<Straight_run> result;
  for (auto& [part, run] : runs) {
    const auto at = [&](Index v) { return chart.uv[v][across]; };
    const auto [low, high] = std::minmax_element(run.vertices.begin(), run.vertices.end(),
                                                 [&](Index i, Index j) { return at(i) < at(j); });
    run.low = at(*low);
    run.high = at(*high);
    if (run.high - run.low <= tolerance)
      result.push_back(std::move(run));
  }
  return result;
}

} // namespace Atlas::internal

#endif
