// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_SCHNYDER_REALIZER_H
#define ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_SCHNYDER_REALIZER_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Draws a triangulated sphere with straight edges on an integer grid: W. Schnyder, Embedding planar
/// graphs on the grid, 1990.
///
/// Vertices leave the outer contour one by one; the contour neighbours of a leaving vertex become its parents
/// in two trees, and it becomes the parent, in the third, of those it uncovers. Every inner vertex sees three
/// paths, to the three outer vertices, which part the triangulation into three regions: the numbers of
/// triangles in them are its barycentric coordinates. All linear in the number of triangles.
class Schnyder_realizer
{
public:
  /// \param triangles  a triangulated sphere without multiple edges, counterclockwise
  /// \param outer      the triangle that becomes the outer face
  Schnyder_realizer(const std::vector<std::array<Index, 3>>& triangles, std::size_t number_of_vertices,
                    Index outer)
      : triangles_(triangles), opposite_(opposite_halfedges(triangles)), n_(number_of_vertices),
        outgoing_(n_, no_index), state_(n_, State::inside), left_(n_), right_(n_), chords_(n_, 0)
  {
    for (Index h = 0; h < opposite_.size(); ++h)
      outgoing_[tail(h)] = h;
    // Seen from the other faces the outer cycle runs the other way.
    root_ = {triangles[outer][1], triangles[outer][0], triangles[outer][2]};
    for (auto& parent : parent_)
      parent.assign(n_, no_index);
  }

  /// Fills `u` with a drawing in which every triangle but the outer one is counterclockwise, in integers of
  /// at most 2 n - 5; `false` if the input is not what it has to be.
  bool draw(std::vector<Complex>& u)
  {
    for (const Index o : opposite_)
      if (o == no_index)
        return false;
    if (!peel())
      return false;
    const std::size_t inner = n_ - 3;
    for (int i = 0; i < 3; ++i)
      count_descendants(i);
    std::array<std::vector<std::int64_t>, 3> depth;
    for (int j = 0; j < 3; ++j)
      depth[j] = sum_to_root(j, std::vector<std::int64_t>(n_, 1));
    const std::int64_t faces = static_cast<std::int64_t>(2 * inner) + 1;
    u.assign(n_, Complex(0));
    u[root_[1]] = Complex(static_cast<double>(faces), 0);
    u[root_[2]] = Complex(0, static_cast<double>(faces));
    std::array<std::vector<std::int64_t>, 2> region; // triangles opposite to the roots 1 and 2
    for (const int i : {1, 2}) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      std::vector<std::int64_t> sum = sum_to_root(j, descendants_[i]);
      const std::vector<std::int64_t> other = sum_to_root(k, descendants_[i]);
      for (const Index v : order_) {
        const std::int64_t vertices = sum[v] + other[v] - descendants_[i][v];
        sum[v] = 2 * vertices - (depth[j][v] + depth[k][v] - 1) - 2;
      }
      region[i - 1] = std::move(sum);
    }
    for (const Index v : order_)
      u[v] = Complex(static_cast<double>(region[0][v]), static_cast<double>(region[1][v]));
    return true;
  }

private:
  enum class State : std::uint8_t { inside, contour, removed };

  Index tail(Index h) const { return triangles_[h / 3][h % 3]; }
  Index head(Index h) const { return tail(next_halfedge(h)); }
  Index turn_left(Index h) const { return opposite_[previous_halfedge(h)]; }

  /// Calls `visit` with the neighbours of v counterclockwise, from any one on.
  template <typename Visit>
  void for_each_neighbor(Index v, Visit visit) const
  {
    for_each_in_fan(
        opposite_, outgoing_[v], [](Index) { return true; }, [&](Index h) { visit(head(h)); });
  }

  bool are_contour_neighbors(Index v, Index w) const
  {
    return right_[v] == w || left_[v] == w || (v == root_[0] && w == root_[1]) ||
           (v == root_[1] && w == root_[0]);
  }

  bool may_leave(Index v) const
  {
    return state_[v] == State::contour && chords_[v] == 0 && v != root_[0] && v != root_[1];
  }

  /// Takes all vertices but the first two roots off the contour. What can leave waits on a stack.
  bool peel()
  {
    const auto [first, second, top] = root_;
    for (const Index v : root_)
      state_[v] = State::contour;
    left_[first] = right_[second] = no_index;
    right_[first] = left_[second] = top;
    left_[top] = first;
    right_[top] = second;
    std::vector<Index> ready{top}, uncovered;
    std::size_t removed = 0;
    while (!ready.empty()) {
      const Index v = ready.back();
      ready.pop_back();
      if (!may_leave(v))
        continue;
      if (!uncover(v, uncovered))
        return false;
      ++removed;
      if (v != top)
        order_.push_back(v);
      update_chords(v, uncovered, ready);
    }
    return removed + 2 == n_;
  }

  /// Removes v and puts the vertices that it covered on the contour.
  bool uncover(Index v, std::vector<Index>& uncovered)
  {
    const Index l = left_[v], r = right_[v];
    uncovered.clear();
    Index h = outgoing_[v];
    for (; head(h) != l; h = turn_left(h))
      if (turn_left(h) == outgoing_[v])
        return false;
    for (h = turn_left(h); head(h) != r; h = turn_left(h)) {
      if (state_[head(h)] != State::inside)
        return false;
      uncovered.push_back(head(h));
    }
    state_[v] = State::removed;
    parent_[0][v] = l;
    parent_[1][v] = r;
    Index last = l;
    for (const Index w : uncovered) {
      parent_[2][w] = v;
      state_[w] = State::contour;
      right_[last] = w;
      left_[w] = last;
      last = w;
    }
    right_[last] = r;
    left_[r] = last;
    return true;
  }

  void update_chords(Index v, const std::vector<Index>& uncovered, std::vector<Index>& ready)
  {
    const Index l = left_of_removed(v), r = right_of_removed(v);
    if (uncovered.empty() && !(l == root_[0] && r == root_[1])) { // a chord became a contour edge
      --chords_[l];
      --chords_[r];
    }
    for (const Index w : uncovered)
      for_each_neighbor(w, [&](Index x) {
        if (state_[x] != State::contour || are_contour_neighbors(w, x))
          return;
        ++chords_[w]; // from here w counts all its chords, also to others that are new
        if (parent_[2][x] != v)
          ++chords_[x];
      });
    for (const Index w : uncovered)
      if (may_leave(w))
        ready.push_back(w);
    for (const Index w : {l, r})
      if (may_leave(w))
        ready.push_back(w);
  }

  Index left_of_removed(Index v) const { return parent_[0][v]; }
  Index right_of_removed(Index v) const { return parent_[1][v]; }

  /// Calls `visit` with the inner vertices, parents of tree i before children.
  template <typename Visit>
  void from_root(int i, Visit visit) const
  {
    if (i == 2)
      for (auto it = order_.begin(); it != order_.end(); ++it)
        visit(*it);
    else
      for (auto it = order_.rbegin(); it != order_.rend(); ++it)
        visit(*it);
  }

  void count_descendants(int i)
  {
    descendants_[i].assign(n_, 1);
    std::vector<Index> order;
    from_root(i, [&](Index v) { order.push_back(v); });
    for (auto it = order.rbegin(); it != order.rend(); ++it)
      descendants_[i][parent_[i][*it]] += descendants_[i][*it];
    for (int j = 0; j < 3; ++j)
      if (j != i)
        descendants_[i][root_[j]] = 1;
  }

  /// Per inner vertex, the sum of `value` over the vertices of its path to root j, both ends included.
  std::vector<std::int64_t> sum_to_root(int j, std::vector<std::int64_t> value) const
  {
    from_root(j, [&](Index v) { value[v] += value[parent_[j][v]]; });
    return value;
  }

  const std::vector<std::array<Index, 3>>& triangles_;
  std::vector<Index> opposite_;
  std::size_t n_;
  std::vector<Index> outgoing_;
  std::vector<State> state_;
  std::vector<Index> left_, right_;
  std::vector<std::int32_t> chords_;
  std::array<Index, 3> root_;
  std::array<std::vector<Index>, 3> parent_;
  std::array<std::vector<std::int64_t>, 3> descendants_;
  std::vector<Index> order_; ///< inner vertices in the order in which they left
};

} // namespace Atlas::internal

#endif
