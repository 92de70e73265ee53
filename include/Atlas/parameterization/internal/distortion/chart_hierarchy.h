// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_CHART_HIERARCHY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_CHART_HIERARCHY_H

#include <Atlas/core/internal/halfedges.h>
#include <Atlas/parameterization/internal/distortion/removed_vertex.h>
#include <Atlas/parameterization/internal/geometry/chart_geometry.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Coarser and coarser meshes of a chart over a part of its vertices, made by half-edge collapses that
/// keep a given map of it free of flips; and the way back, on which a map of a coarse mesh becomes one of the
/// finer mesh, again without flips.
///
/// Putting a vertex back is always possible: its ring was filled by a fan of triangles around one corner, and
/// close to that corner there are points that see the whole ring. As a rule the vertex goes where it was in
/// relation to the triangle that took its place.
class Chart_hierarchy
{
public:
  /// Level 0 is the chart itself.
  struct Level
  {
    std::vector<Index> vertices; ///< of the chart, in increasing order
    std::vector<std::array<Index, 3>> triangles;
    std::size_t number_removed = 0; ///< how many vertices had been removed when it was complete
  };

  /// \param u  a map without flips
  Chart_hierarchy(const Chart_geometry& geometry, std::span<const Complex> u)
      : geometry_(geometry), u_(u), is_border_(u.size(), false), depth_(u.size(), 0)
  {
    const auto& triangles = geometry.chart().triangles;
    Level level;
    for (Index v = 0; v < u.size(); ++v)
      level.vertices.push_back(v);
    level.triangles = triangles;
    levels_.push_back(std::move(level));
    number_of_border_edges_ = mark_border(triangles);
  }

  const std::vector<Level>& levels() const { return levels_; }

  /// Adds levels, each with about a quarter of the vertices, down to about `least` vertices. O(n).
  void coarsen(std::size_t least)
  {
    while (levels_.back().vertices.size() > least) {
      const std::size_t size = levels_.back().vertices.size(), goal = std::max(size / 4, least);
      Level next = levels_.back();
      const std::size_t border_edges = number_of_border_edges_;
      for (std::size_t before = size + 1; next.vertices.size() > goal && next.vertices.size() < before;) {
        before = next.vertices.size();
        thin_out(next, goal);
        if (next.vertices.size() > before - before / 16)
          break; // what is left resists
      }
      next.number_removed = removed_.size();
      if (next.vertices.size() > size - size / 4 || mark_border(next.triangles) != number_of_border_edges_) {
        number_of_border_edges_ = border_edges;
        return;
      }
      for (const Index v : next.vertices)
        depth_[v] = levels_.size();
      levels_.push_back(std::move(next));
    }
  }

  /// The mesh of a level as a chart. Vertex i is `levels()[level].vertices[i]` of the original.
  Chart chart(std::size_t level) const
  {
    const Level& from = levels_[level];
    std::vector<Index> number(u_.size(), no_index);
    Chart result;
    for (Index i = 0; i < from.vertices.size(); ++i) {
      number[from.vertices[i]] = i;
      result.points.push_back(geometry_.chart().points[from.vertices[i]]);
    }
    for (const auto& [a, b, c] : from.triangles)
      result.triangles.push_back({number[a], number[b], number[c]});
    return result;
  }

  /// Whether the vertex is there on the level.
  bool has(std::size_t level, Index v) const { return level <= depth_[v]; }

  /// Makes a map of level `level` + 1, given at its vertices in `u`, one of `level`.
  /// \param is_inside  puts border vertices back into the coarse mesh, so that a simple border remains simple
  /// \return `false` if double precision has no place for a vertex
  bool refine(std::size_t level, std::vector<Complex>& u, bool is_inside) const
  {
    for (std::size_t i = levels_[level + 1].number_removed; i-- > levels_[level].number_removed;)
      if (!put_back(geometry_, removed_[i], ring_of(removed_[i]), u, is_inside))
        return false;
    return true;
  }

private:
  static constexpr std::size_t largest_degree = 10;
  static constexpr double sufficient_quality = 0.1;    ///< of triangles that come in
  static constexpr double least_part_of_quality = 0.5; ///< or of the worst triangle that goes
  static constexpr double largest_bend = 0.35; ///< of the border: height over chord at a removed vertex

  std::span<const Index> ring_of(const Removed_vertex& removed) const
  {
    return {rings_.data() + removed.first_ring, removed.last_ring - removed.first_ring};
  }

  std::size_t mark_border(const std::vector<std::array<Index, 3>>& triangles)
  {
    std::size_t count = 0;
    const std::vector<Index> opposite = opposite_halfedges(triangles);
    for (Index h = 0; h < opposite.size(); ++h)
      if (opposite[h] == no_index) {
        is_border_[triangles[h / 3][h % 3]] = true;
        ++count;
      }
    return count;
  }

  /// Removes vertices of which no two are neighbours, as long as there are more than `goal`.
  void thin_out(Level& level, std::size_t goal)
  {
    const std::size_t n = u_.size();
    std::vector<std::size_t> first(n + 1, 0);
    for (const auto& corner : level.triangles)
      for (const Index v : corner)
        ++first[v + 1];
    for (std::size_t v = 0; v < n; ++v)
      first[v + 1] += first[v];
    std::vector<Index> incident(first.back());
    std::vector<std::size_t> place(first.begin(), first.end() - 1);
    for (Index t = 0; t < level.triangles.size(); ++t)
      for (const Index v : level.triangles[t])
        incident[place[v]++] = t;

    std::vector<bool> is_locked(n, false), is_gone(n, false);
    std::size_t left = level.vertices.size();
    for (const Index v : level.vertices) {
      if (left <= goal)
        break;
      const std::span<const Index> star(incident.data() + first[v], first[v + 1] - first[v]);
      if (is_locked[v] || !find_ring(v, star, level.triangles) || !find_target(v, star, level.triangles))
        continue;
      remove(v, star, level.triangles);
      is_gone[v] = true;
      for (const Index w : ring_)
        is_locked[w] = true;
      --left;
    }
    std::erase_if(level.vertices, [&](Index v) { return is_gone[v]; });
    std::erase_if(level.triangles, [](const auto& corner) { return corner[0] == no_index; });
  }

  /// The vertices around v in order; `false` if v is not a vertex that can be removed.
  bool find_ring(Index v, std::span<const Index> star, const std::vector<std::array<Index, 3>>& triangles)
  {
    if (star.size() < (is_border_[v] ? 2 : 3) || star.size() > largest_degree)
      return false;
    std::array<std::pair<Index, Index>, largest_degree> edge;
    for (std::size_t i = 0; i < star.size(); ++i) {
      const auto& corner = triangles[star[i]];
      const int k = corner[0] == v ? 0 : corner[1] == v ? 1 : 2;
      edge[i] = {corner[(k + 1) % 3], corner[(k + 2) % 3]};
    }
    const auto end = edge.begin() + static_cast<std::ptrdiff_t>(star.size());
    auto start = edge.begin();
    if (is_border_[v])
      start = std::find_if(edge.begin(), end, [&](const auto& e) {
        return std::none_of(edge.begin(), end, [&](const auto& f) { return f.second == e.first; });
      });
    ring_.clear();
    for (auto e = start; e != end && ring_.size() < star.size();) {
      ring_.push_back(e->first);
      const Index head = e->second;
      if (is_border_[v] && ring_.size() == star.size())
        ring_.push_back(head);
      e = std::find_if(edge.begin(), end, [&](const auto& f) { return f.first == head; });
      if (e == start)
        break;
    }
    return ring_.size() == star.size() + (is_border_[v] ? 1 : 0);
  }

  /// How good a triangle is: its shape in space (1 for an equilateral one) times how little the map shears
  /// it. Not positive if it is flipped.
  double quality(Index a, Index b, Index c) const
  {
    const Mapped_triangle triangle(geometry_.edge(a, b), geometry_.edge(a, c), u_[b] - u_[a], u_[c] - u_[a]);
    const double result = 4 * std::sqrt(3.) * triangle.space2 * triangle.plane /
                          (2 * (triangle.pp + triangle.qq - triangle.pq) * triangle.stretched);
    return std::isfinite(result) ? result : 0;
  }

  /// Calls visit(a, b) for the edges of the ring that a fan around the i-th vertex of the ring makes
  /// triangles with.
  template <typename Visit>
  void for_each_of_fan(std::size_t i, bool is_border, Visit visit) const
  {
    const std::size_t n = ring_.size();
    for (std::size_t k = 0; k + is_border < n; ++k)
      if (k != i && (k + 1) % n != i)
        visit(ring_[k], ring_[(k + 1) % n]);
  }

  bool find_target(Index v, std::span<const Index> star, const std::vector<std::array<Index, 3>>& triangles)
  {
    const bool is_border = is_border_[v];
    if (is_border && !is_straight(v))
      return false;
    double bound = sufficient_quality;
    for (const Index t : star)
      bound =
          std::min(bound, least_part_of_quality * quality(triangles[t][0], triangles[t][1], triangles[t][2]));
    double best = 0;
    for (std::size_t i = 0; i < ring_.size(); i += is_border ? ring_.size() - 1 : 1) {
      double worst = 1;
      for_each_of_fan(i, is_border, [&](Index a, Index b) {
        if (worst > best)
          worst = std::min(worst, quality(ring_[i], a, b));
      });
      if (worst > best) {
        best = worst;
        target_ = i;
      }
    }
    bool is_valid = best > 0 && best >= bound;
    for_each_of_fan(target_, is_border, [&](Index a, Index b) {
      is_valid = is_valid && turn(u_[ring_[target_]], u_[a], u_[b]) == CGAL::LEFT_TURN;
    });
    return is_valid;
  }

  /// Whether the border runs nearly straight through v.
  bool is_straight(Index v) const
  {
    const Complex chord = u_[ring_.front()] - u_[ring_.back()], to = u_[v] - u_[ring_.back()];
    const double cross = chord.real() * to.imag() - chord.imag() * to.real(),
                 dot = chord.real() * to.real() + chord.imag() * to.imag(), square = std::norm(chord);
    return std::abs(cross) <= largest_bend * square && dot > 0 && dot < square;
  }

  void remove(Index v, std::span<const Index> star, std::vector<std::array<Index, 3>>& triangles)
  {
    const bool is_border = is_border_[v];
    Removed_vertex removed{v, ring_[target_], {}, rings_.size(), rings_.size() + ring_.size(), is_border};
    rings_.insert(rings_.end(), ring_.begin(), ring_.end());
    number_of_border_edges_ -= is_border;
    std::size_t used = 0;
    for_each_of_fan(target_, is_border, [&](Index a, Index b) {
      const std::array<Index, 3> corner{removed.target, a, b};
      triangles[star[used++]] = corner;
      for (const bool is_plane : {false, true}) {
        const Barycentric_place place =
            is_plane ? place_in_plane(u_, v, corner) : place_in_space(geometry_, v, corner);
        if (place.least > removed.places[is_plane].least)
          removed.places[is_plane] = place;
      }
    });
    for (; used < star.size(); ++used)
      triangles[star[used]][0] = no_index;
    removed_.push_back(removed);
  }

  const Chart_geometry& geometry_;
  std::span<const Complex> u_;
  std::vector<bool> is_border_;
  std::vector<std::size_t> depth_; ///< the coarsest level of each vertex
  std::size_t number_of_border_edges_ = 0;
  std::vector<Level> levels_;
  std::vector<Removed_vertex> removed_;
  std::vector<Index> rings_; ///< of the removed vertices, one after another
  std::vector<Index> ring_;  ///< of the vertex at hand
  std::size_t target_ = 0;   ///< its place in the ring
};

} // namespace Atlas::internal

#endif
