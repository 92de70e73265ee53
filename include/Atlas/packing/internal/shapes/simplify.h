// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_SIMPLIFY_H
#define ATLAS_PACKING_INTERNAL_SHAPES_SIMPLIFY_H

#include <Atlas/packing/internal/shapes/Outline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// The segments of an outline as chains of points; a closed chain repeats its first point at the end. Chains
/// start and end where not exactly one segment comes in and one goes out.
inline std::vector<std::vector<Index>> chains_of(const Outline& outline)
{
  const std::size_t n = outline.points.size(), m = outline.segments.size();
  std::vector<Index> out(n, no_index), ins(n, 0), outs(n, 0);
  for (Index s = 0; s < m; ++s) {
    out[outline.segments[s][0]] = s;
    ++outs[outline.segments[s][0]];
    ++ins[outline.segments[s][1]];
  }
  std::vector<std::vector<Index>> chains;
  std::vector<bool> used(m, false);
  const auto follow = [&](Index s) {
    std::vector<Index> chain{outline.segments[s][0]};
    while (!used[s]) {
      used[s] = true;
      const Index v = outline.segments[s][1];
      chain.push_back(v);
      if (ins[v] != 1 || outs[v] != 1)
        break;
      s = out[v];
    }
    chains.push_back(std::move(chain));
  };
  for (Index s = 0; s < m; ++s)
    if (const Index v = outline.segments[s][0]; ins[v] != 1 || outs[v] != 1)
      follow(s);
  // Closed chains start at their point farthest from the centre, which is a corner if there is one.
  std::vector<Index> starts;
  for (Index s = 0; s < m; ++s) {
    if (used[s])
      continue;
    Index best = s;
    for (Index t = s; !used[t]; t = out[outline.segments[t][1]]) {
      used[t] = true;
      if (length(outline.points[outline.segments[t][0]]) > length(outline.points[outline.segments[best][0]]))
        best = t;
    }
    starts.push_back(best);
  }
  std::fill(used.begin(), used.end(), false);
  for (const Index s : starts)
    follow(s);
  return chains;
}

/// Leaves out points of a chain so that none is farther than `tolerance` from the segment that stands for it.
/// From each point kept, the directions that pass all later points within the tolerance form a wedge; a point
/// outside the wedge, or nearer than the one before, ends the segment. Linear.
inline std::vector<Index> simplified_chain(const std::vector<Vec2>& points, const std::vector<Index>& chain,
                                           double tolerance)
{
  std::vector<Index> kept{chain.front()};
  Vec2 low, high; // directions of the sides of the wedge
  bool is_open = true;
  double reach = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    Vec2 d = points[chain[i]] - points[kept.back()];
    const bool fits = length(d) >= reach &&
                      (is_open || (cross(low, d) >= 0 && cross(d, high) >= 0 && dot(low + high, d) > 0));
    if (!fits) {
      kept.push_back(chain[i - 1]);
      is_open = true;
      reach = 0;
      d = points[chain[i]] - points[kept.back()];
    }
    reach = std::max(reach, length(d));
    if (length(d) <= tolerance)
      continue;
    const double sine = tolerance / length(d), cosine = std::sqrt(1 - sine * sine);
    const Vec2 left = rotated({cosine, sine}, d), right = rotated({cosine, -sine}, d);
    if (is_open || cross(low, right) > 0)
      low = right;
    if (is_open || cross(left, high) > 0)
      high = left;
    is_open = false;
  }
  kept.push_back(chain.back());
  return kept;
}

} // namespace Atlas::internal

#endif
