// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_HALFEDGES_H
#define ATLAS_CORE_INTERNAL_HALFEDGES_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace Atlas::internal {

/// A halfedge of an edge whose ends are known but for one.
struct Half_of_edge
{
  Index other_end, halfedge;

  bool operator<(const Half_of_edge& e) const { return other_end < e.other_end; }
};

/// Sorts what is small as a rule: the halfedges of the edges at one vertex.
inline void sort_few(std::span<Half_of_edge> list)
{
  constexpr std::size_t few = 24;
  if (list.size() > few)
    return std::sort(list.begin(), list.end());
  for (std::size_t i = 1; i < list.size(); ++i) {
    const Half_of_edge moved = list[i];
    std::size_t k = i;
    for (; k > 0 && moved < list[k - 1]; --k)
      list[k] = list[k - 1];
    list[k] = moved;
  }
}

/// Pairs halfedges that run between the same two vertices in opposite directions, where there are exactly two
/// of them; all others keep what they have. `tail(h)` and `head(h)` give vertex numbers. Halfedges listed in
/// `candidates` take part. Linear in these and in the range of the numbers, but for vertices of very many
/// edges.
template <typename Tail, typename Head>
void pair_halfedges(const std::vector<Index>& candidates, Tail tail, Head head, std::vector<Index>& opposite)
{
  const auto lesser_end = [&](Index h) { return std::min<Index>(tail(h), head(h)); };
  Index least = no_index, most = 0;
  for (const Index h : candidates) {
    least = std::min(least, lesser_end(h));
    most = std::max(most, lesser_end(h));
  }
  const std::size_t range = candidates.empty() ? 0 : std::size_t(most) - least + 1;
  std::vector<std::size_t> end(range + 1, 0); // per vertex: where the edges end whose lesser end it is
  for (const Index h : candidates)
    ++end[lesser_end(h) - least + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Half_of_edge> edges(candidates.size());
  for (const Index h : candidates) // from now on, end[v] is where the next one of v goes
    edges[end[lesser_end(h) - least]++] = {std::max<Index>(tail(h), head(h)), h};
  for (std::size_t v = 0, i = 0; v < range; ++v) {
    sort_few(std::span(edges).subspan(i, end[v] - i));
    while (i < end[v]) {
      std::size_t j = i + 1;
      while (j < end[v] && edges[j].other_end == edges[i].other_end)
        ++j;
      const Index g = edges[i].halfedge;
      if (j - i == 2 && edges[i].other_end != v + least && tail(g) == head(edges[i + 1].halfedge)) {
        opposite[g] = edges[i + 1].halfedge;
        opposite[edges[i + 1].halfedge] = g;
      }
      i = j;
    }
  }
}

/// Per halfedge 3t+i of an indexed mesh: the halfedge on the other side, or `no_index` at the border and at
/// edges that are not shared by exactly two consistently oriented triangles.
inline std::vector<Index> opposite_halfedges(const std::vector<std::array<Index, 3>>& triangles)
{
  std::vector<Index> opposite(3 * triangles.size(), no_index), all(3 * triangles.size());
  for (Index h = 0; h < all.size(); ++h)
    all[h] = h;
  const auto tail = [&](Index h) { return triangles[h / 3][h % 3]; };
  pair_halfedges(
      all, tail, [&](Index h) { return tail(next_halfedge(h)); }, opposite);
  return opposite;
}

/// Calls `visit(h)` for each halfedge that leaves the vertex where `start` leaves it, in the fan of triangles
/// that hang together there across halfedges g with `is_glued(g)`: `start` first, on counterclockwise, and
/// then, if the fan is open, those clockwise of `start`. Returns whether the fan goes all around. Linear in
/// the fan.
template <typename IsGlued, typename Visit>
bool for_each_in_fan(const std::vector<Index>& opposite, Index start, IsGlued is_glued, Visit visit)
{
  for (Index h = start;;) {
    visit(h);
    const Index before = previous_halfedge(h);
    if (!is_glued(before))
      break;
    h = opposite[before];
    if (h == start)
      return true;
  }
  for (Index h = start; is_glued(h);) {
    h = next_halfedge(opposite[h]);
    visit(h);
  }
  return false;
}

/// The halfedge with which the fan of `start` begins, so that `for_each_in_fan()` from there goes
/// counterclockwise only: the last one clockwise, or `start` where the fan goes all around.
template <typename IsGlued>
Index first_in_fan(const std::vector<Index>& opposite, Index start, IsGlued is_glued)
{
  Index h = start;
  while (is_glued(h)) {
    h = next_halfedge(opposite[h]);
    if (h == start)
      break;
  }
  return h;
}

/// Enters triangles from `seed` on, across halfedges h with an opposite and `may_cross(h)`. `enter(t)` marks
/// the triangle; it returns `false` if t has been entered before or is not wanted. Linear in the triangles
/// entered.
template <typename MayCross, typename Enter>
void flood_fill(const std::vector<Index>& opposite, Index seed, MayCross may_cross, Enter enter)
{
  if (!enter(seed))
    return;
  std::vector<Index> stack{seed};
  while (!stack.empty()) {
    const Index t = stack.back();
    stack.pop_back();
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (const Index o = opposite[h]; o != no_index && may_cross(h) && enter(o / 3))
        stack.push_back(o / 3);
  }
}

/// Parts of a set of triangles that hang together.
struct Components
{
  std::vector<Index>
      of_triangle; ///< numbered in the order of their first triangles; `no_index` for those not in the set
  Index count = 0;
};

/// The parts of the triangles t with `is_in(t)` that hang together across halfedges h with `may_cross(h)`.
/// O(n).
template <typename IsIn, typename MayCross>
Components connected_components(const std::vector<Index>& opposite, IsIn is_in, MayCross may_cross)
{
  Components result{std::vector<Index>(opposite.size() / 3, no_index), 0};
  std::vector<Index>& number = result.of_triangle;
  for (Index seed = 0; seed < number.size(); ++seed) {
    if (number[seed] != no_index || !is_in(seed))
      continue;
    flood_fill(opposite, seed, may_cross, [&](Index t) {
      if (number[t] != no_index || !is_in(t))
        return false;
      number[t] = result.count;
      return true;
    });
    ++result.count;
  }
  return result;
}

/// The parts of all triangles that hang together over edges. O(n).
inline Components connected_components(const std::vector<Index>& opposite)
{
  const auto always = [](Index) { return true; };
  return connected_components(opposite, always, always);
}

/// The halfedge after `h` along the border of its chart: `is_seam(g)` tells the edges not to be turned
/// across.
template <typename IsSeam>
Index next_on_border(const std::vector<Index>& opposite, Index h, IsSeam is_seam)
{
  Index g = next_halfedge(h);
  while (!is_seam(g))
    g = next_halfedge(opposite[g]);
  return g;
}

/// The border halfedges of an indexed mesh as closed loops, each in the direction of its triangles (the
/// surface on the left). A vertex that the border passes twice is left along the same fan of triangles.
inline std::vector<std::vector<Index>> border_loops(const std::vector<Index>& opposite)
{
  std::vector<std::vector<Index>> loops;
  std::vector<bool> visited(opposite.size(), false);
  for (Index start = 0; start < opposite.size(); ++start) {
    if (opposite[start] != no_index || visited[start])
      continue;
    std::vector<Index> loop;
    Index h = start;
    do {
      visited[h] = true;
      loop.push_back(h);
      h = next_halfedge(h);
      while (opposite[h] != no_index)
        h = next_halfedge(opposite[h]);
    } while (h != start);
    loops.push_back(std::move(loop));
  }
  return loops;
}

} // namespace Atlas::internal

#endif
