// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_COARSE_SURFACE_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_COARSE_SURFACE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief A surface with few triangles that has the same charts and the same arcs as the given one.
struct Coarse_surface
{
  std::vector<Point_3> points;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> opposite;        ///< per halfedge
  std::vector<Index> side;            ///< per halfedge: the side of an arc, or `no_index`
  std::vector<Index> chart;           ///< per triangle
  std::vector<Index> source;          ///< per triangle: the one of the surface that it was
  std::vector<std::uint8_t> is_fixed; ///< per vertex: whether arcs end there

  const Point_3& point(Index h) const { return points[triangles[h / 3][h % 3]]; }
};

/// \brief Makes the coarse surface by collapsing edges onto one of their ends.
///
/// Vertices inside charts go anywhere, vertices of arcs along their arc, fixed vertices nowhere. An edge
/// collapses when that changes neither the topology of the surface (the link condition; T. Dey et al., 1999)
/// nor that of the arcs, and turns no triangle far. Edges below a rising length go first, by vertex number,
/// so that no queue is needed: O(n log(edge length of the result / that of the surface)).
class Surface_simplifier
{
public:
  /// \param triangles_per_chart  about how many triangles a chart shall keep
  Surface_simplifier(const Surface& surface, const Segmentation& segmentation, const Chart_arcs& arcs,
                     double triangles_per_chart)
      : opposite_(surface.opposite), side_(arcs.side), vertex_(arcs.vertex), chart_(segmentation.chart)
  {
    take_vertices(surface, arcs);
    set_lengths(segmentation.number_of_charts, triangles_per_chart);
  }

  /// Keeps the vertices of a triangle, and so the triangle, as they are.
  void keep_triangle(Index t)
  {
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      kind_[vertex_[h]] = Kind::fixed;
  }

  /// Whether the triangle stays as it is because its vertices do.
  bool is_kept(Index t) const
  {
    return kind_[vertex_[3 * t]] == Kind::fixed && kind_[vertex_[3 * t + 1]] == Kind::fixed &&
           kind_[vertex_[3 * t + 2]] == Kind::fixed;
  }

  Coarse_surface run()
  {
    std::vector<Index> remaining;
    for (Index v = 0; v < kind_.size(); ++v)
      if (kind_[v] != Kind::fixed)
        remaining.push_back(v);
    double tried = 0;
    for (double share = first_share; share < 1.01; share *= std::sqrt(2.0)) {
      for (const Index v : remaining)
        try_collapse(v, share * length_[v], tried * length_[v]);
      tried = share;
      std::erase_if(remaining, [&](Index v) { return halfedge_[v] == no_index; });
    }
    for (const Index v : remaining)
      try_collapse(v, length_[v], tried * length_[v]);
    return compact();
  }

private:
  enum class Kind : std::uint8_t { inside, arc, fixed };
  /// Vertices of a higher degree neither go nor take part in a collapse: a check costs no more than this.
  static constexpr std::size_t maximal_degree = 32;
  /// The length up to which edges collapse rises from this share of its final value on: long edges go last,
  /// or triangles would get long and thin.
  static constexpr double first_share = 1.0 / 32;
  /// The squared cosine of the largest angle by which a triangle may turn, about 57 degrees.
  static constexpr double least_squared_cosine = 0.3;
  /// The square of twice the least area of a triangle of longest edge 1.
  static constexpr double least_squared_area = 0.02;

  void take_vertices(const Surface& surface, const Chart_arcs& arcs)
  {
    const Index n = arcs.number_of_vertices();
    points_.resize(n, Point_3(0, 0, 0));
    halfedge_.assign(n, no_index);
    degree_.assign(n, 0);
    changed_.assign(n, 0);
    tried_.assign(n, 0);
    kind_.assign(n, Kind::inside);
    for (Index h = 0; h < vertex_.size(); ++h) {
      const Index v = vertex_[h];
      points_[v] = surface.point(h);
      if (halfedge_[v] == no_index || opposite_[h] == no_index)
        halfedge_[v] = h;
      ++degree_[v];
      if (side_[h] != no_index)
        for (const Index u : {v, vertex_[next_halfedge(h)]})
          kind_[u] = Kind::arc;
      if (v == vertex_[next_halfedge(h)] || v == vertex_[previous_halfedge(h)])
        degree_[v] = no_index / 2; // a triangle folded onto itself stays as it is
    }
    for (Index v = 0; v < n; ++v)
      if (arcs.is_fixed[v])
        kind_[v] = Kind::fixed;
  }

  /// The length of the edges of equilateral triangles of the right number, per vertex the least of its
  /// charts.
  void set_lengths(Index charts, double triangles_per_chart)
  {
    std::vector<double> area(charts, 0);
    for (Index t = 0; t < chart_.size(); ++t)
      area[chart_[t]] += std::sqrt(CGAL::squared_area(points_[vertex_[3 * t]], points_[vertex_[3 * t + 1]],
                                                      points_[vertex_[3 * t + 2]]));
    length_.assign(points_.size(), std::numeric_limits<double>::infinity());
    for (Index h = 0; h < vertex_.size(); ++h)
      length_[vertex_[h]] = std::min(
          length_[vertex_[h]], std::sqrt(area[chart_[h / 3]] / triangles_per_chart * 4 / std::sqrt(3.0)));
  }

  /// The halfedges that leave v, counterclockwise; at the border the first one is a border halfedge.
  void find_star(Index v, std::vector<Index>& star) const
  {
    const auto is_inside = [&](Index h) { return opposite_[h] != no_index; };
    star.clear();
    for_each_in_fan(opposite_, first_in_fan(opposite_, halfedge_[v], is_inside), is_inside,
                    [&](Index h) { star.push_back(h); });
  }

  double length(Index h) const
  {
    return std::sqrt(CGAL::squared_distance(points_[vertex_[h]], points_[vertex_[next_halfedge(h)]]));
  }

  /// Moves v onto its nearest neighbour that allows it, if one is nearer than `limit`.
  /// \param tried  neighbours nearer than this have been tried before: what has not changed since is refused
  ///               again
  void try_collapse(Index v, double limit, double tried)
  {
    if (halfedge_[v] == no_index || degree_[v] > maximal_degree)
      return;
    find_star(v, star_);
    candidates_.clear();
    for (const Index h : star_) {
      if (kind_[v] == Kind::inside || side_[h] != no_index)
        if (const double l = length(h); l < limit)
          candidates_.emplace_back(l, h);
      // The edge that arrives along the border has no halfedge that leaves.
      if (const Index p = previous_halfedge(h); opposite_[p] == no_index && kind_[v] == Kind::arc)
        if (const double l = length(p); l < limit)
          candidates_.emplace_back(l, p);
    }
    std::sort(candidates_.begin(), candidates_.end());
    const auto is_same = [&](Index u) { return changed_[u] <= tried_[v]; };
    for (const auto& [l, h] : candidates_)
      if (!(l < tried && is_same(v) && is_same(other_end(v, h))) && is_allowed(v, h)) {
        collapse(v, h);
        return;
      }
    tried_[v] = clock_;
  }

  Index other_end(Index v, Index h) const { return vertex_[h] == v ? vertex_[next_halfedge(h)] : vertex_[h]; }

  /// \param h  an edge of v, as a halfedge that leaves v or, at the border only, arrives at it
  bool is_allowed(Index v, Index h)
  {
    const Index w = other_end(v, h);
    if (w == v || degree_[w] > maximal_degree)
      return false;
    find_star(w, other_star_);
    // The link condition: v and w have but the opposite corners as common neighbours.
    near_w_.clear();
    for (const Index g : other_star_)
      for (const Index u : {vertex_[next_halfedge(g)], vertex_[previous_halfedge(g)]})
        near_w_.push_back(u);
    near_v_.clear();
    for (const Index g : star_)
      for (const Index u : {vertex_[next_halfedge(g)], vertex_[previous_halfedge(g)]})
        if (std::find(near_v_.begin(), near_v_.end(), u) == near_v_.end())
          near_v_.push_back(u);
    const std::size_t common =
        static_cast<std::size_t>(std::count_if(near_v_.begin(), near_v_.end(), [&](Index u) {
          return std::find(near_w_.begin(), near_w_.end(), u) != near_w_.end() && u != v && u != w;
        }));
    if (common != (opposite_[h] == no_index ? 1u : 2u) || !keeps_arcs(h) ||
        (opposite_[h] != no_index && !keeps_arcs(opposite_[h])))
      return false;
    return keeps_shape(v, w);
  }

  /// Whether the triangle of h may vanish: not if all its edges, or both others, are on arcs.
  bool keeps_arcs(Index h) const
  {
    return side_[next_halfedge(h)] == no_index || side_[previous_halfedge(h)] == no_index;
  }

  bool keeps_shape(Index v, Index w) const
  {
    for (const Index g : star_) {
      const Index a = vertex_[next_halfedge(g)], b = vertex_[previous_halfedge(g)];
      if (a == w || b == w)
        continue;
      const Vector_3 edge = points_[b] - points_[a];
      const Vector_3 before = CGAL::cross_product(points_[a] - points_[v], edge);
      const Vector_3 after = CGAL::cross_product(points_[a] - points_[w], edge);
      const double product = before * after;
      const double squares = before.squared_length() * after.squared_length();
      if (squares > 0 && (!(product > 0) || product * product < least_squared_cosine * squares))
        return false;
      // No slivers, unless it was one: height over longest edge.
      const double longest = std::max({edge.squared_length(), CGAL::squared_distance(points_[a], points_[w]),
                                       CGAL::squared_distance(points_[b], points_[w])});
      if (after.squared_length() < least_squared_area * longest * longest &&
          after.squared_length() < before.squared_length())
        return false;
    }
    return true;
  }

  void glue(Index g, Index h)
  {
    if (g != no_index)
      opposite_[g] = h;
    if (h != no_index)
      opposite_[h] = g;
  }

  /// Takes the triangle of h out: its other two edges become one.
  void remove_triangle(Index h)
  {
    const Index n = next_halfedge(h), p = previous_halfedge(h), on = opposite_[n], op = opposite_[p];
    const Index apex = vertex_[p];
    if (on != no_index && op != no_index) {
      // At most one of the two edges is on an arc, or none is.
      side_[op] = side_[n] != no_index ? side_[n] : side_[op];
      side_[on] = side_[p] != no_index ? side_[p] : side_[on];
    } else if (on != no_index)
      side_[on] = side_[p];
    else if (op != no_index)
      side_[op] = side_[n];
    glue(on, op);
    --degree_[apex];
    chart_[h / 3] = no_index;
    halfedge_[apex] = on != no_index ? on : next_halfedge(op);
  }

  void collapse(Index v, Index h)
  {
    const Index w = other_end(v, h), o = opposite_[h];
    ++clock_;
    for (const auto* star : {&star_, &other_star_})
      for (const Index g : *star)
        for (Index k = 3 * (g / 3); k < 3 * (g / 3) + 3; ++k)
          changed_[vertex_[k]] = clock_;
    for (const Index g : star_)
      vertex_[g] = w;
    remove_triangle(h);
    if (o != no_index)
      remove_triangle(o);
    halfedge_[v] = no_index;
    // A halfedge that leaves w, from what is left of both stars.
    degree_[w] = 0;
    for (const auto* star : {&star_, &other_star_})
      for (const Index g : *star)
        if (chart_[g / 3] != no_index) {
          halfedge_[w] = g;
          ++degree_[w];
        }
  }

  Coarse_surface compact() const
  {
    Coarse_surface result;
    std::vector<Index> new_vertex(points_.size(), no_index), new_triangle(chart_.size(), no_index);
    for (Index t = 0; t < chart_.size(); ++t) {
      if (chart_[t] == no_index)
        continue;
      new_triangle[t] = static_cast<Index>(result.triangles.size());
      result.chart.push_back(chart_[t]);
      result.source.push_back(t);
      result.triangles.emplace_back();
      for (Index i = 0; i < 3; ++i) {
        Index& v = new_vertex[vertex_[3 * t + i]];
        if (v == no_index) {
          v = static_cast<Index>(result.points.size());
          result.points.push_back(points_[vertex_[3 * t + i]]);
          result.is_fixed.push_back(kind_[vertex_[3 * t + i]] == Kind::fixed);
        }
        result.triangles.back()[i] = v;
      }
    }
    for (Index t = 0; t < chart_.size(); ++t)
      if (chart_[t] != no_index)
        for (Index h = 3 * t; h < 3 * t + 3; ++h) {
          const Index o = opposite_[h];
          result.opposite.push_back(o == no_index ? no_index : 3 * new_triangle[o / 3] + o % 3);
          result.side.push_back(side_[h]);
        }
    return result;
  }

  std::vector<Index> opposite_, side_, vertex_; ///< per halfedge
  std::vector<Index> chart_;                    ///< per triangle; `no_index`: gone
  std::vector<Point_3> points_;                 ///< per vertex, and so are the following
  std::vector<Index> halfedge_;                 ///< one that leaves the vertex; `no_index`: gone
  std::vector<Index> degree_;                   ///< triangles around it
  std::vector<Kind> kind_;
  std::vector<double> length_;
  std::vector<Index> changed_; ///< the number of the last collapse next to it
  std::vector<Index> tried_;   ///< how many collapses there had been when it was tried in vain
  Index clock_ = 0;            ///< the number of collapses
  std::vector<Index> star_, other_star_, near_v_, near_w_;
  std::vector<std::pair<double, Index>> candidates_;
};

} // namespace Atlas::internal

#endif
