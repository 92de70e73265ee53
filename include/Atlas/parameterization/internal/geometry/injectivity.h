// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_INJECTIVITY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_INJECTIVITY_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/parameterization/internal/geometry/chart_geometry.h>
#include <Atlas/planar/internal/border_tree.h>
#include <Atlas/planar/internal/segments.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

inline Point_2 to_point(const Complex& z)
{
  return Point_2(z.real(), z.imag());
}

/// Exact orientation of three points.
inline CGAL::Orientation turn(const Complex& p, const Complex& q, const Complex& r)
{
  return CGAL::orientation(to_point(p), to_point(q), to_point(r));
}

/// \brief Decides exactly whether a map of a disc into the plane is one-to-one.
///
/// It is if every triangle is counterclockwise and the border is a simple polygon: each point of the plane is
/// then covered as often as the border winds around it, that is once or not at all (Lipman 2014).
class Injectivity_checker
{
public:
  explicit Injectivity_checker(const Chart& chart)
      : Injectivity_checker(chart, opposite_halfedges(chart.triangles))
  {}

  Injectivity_checker(const Chart& chart, const std::vector<Index>& opposite)
      : Injectivity_checker(chart, border_vertex_loops(chart, opposite))
  {}

  Injectivity_checker(const Chart& chart, std::vector<std::vector<Index>> borders)
      : chart_(chart), borders_(std::move(borders)), tree_(borders_)
  {}

  /// The vertices of each border loop in order, the chart on the left.
  const std::vector<std::vector<Index>>& borders() const { return borders_; }

  /// The number of triangles that are not counterclockwise.
  std::size_t number_of_flips(std::span<const Complex> u) const
  {
    std::size_t count = 0;
    for (const auto& [a, b, c] : chart_.triangles)
      count += turn(u[a], u[b], u[c]) != CGAL::LEFT_TURN;
    return count;
  }

  bool has_flip(std::span<const Complex> u) const
  {
    return std::any_of(chart_.triangles.begin(), chart_.triangles.end(), [&](const auto& corner) {
      return turn(u[corner[0]], u[corner[1]], u[corner[2]]) != CGAL::LEFT_TURN;
    });
  }

  /// Whether no two border edges have a point in common besides the ends of consecutive ones.
  bool is_border_simple(std::span<const Complex> u)
  {
    tree_.fit(u);
    return !tree_.any_pair(
        [&](const Border_tree::Edge& e, const Border_tree::Edge& f) { return do_edges_meet(u, e, f); });
  }

  bool is_one_to_one(std::span<const Complex> u) { return !has_flip(u) && is_border_simple(u); }

  /// The tree over the border edges, fitted to the last border that was tested.
  const Border_tree& tree() const { return tree_; }

private:
  static std::vector<std::vector<Index>> border_vertex_loops(const Chart& chart,
                                                             const std::vector<Index>& opposite)
  {
    std::vector<std::vector<Index>> loops = border_loops(opposite);
    for (std::vector<Index>& loop : loops)
      for (Index& h : loop)
        h = chart.triangles[h / 3][h % 3];
    return loops;
  }

  static bool do_edges_meet(std::span<const Complex> u, Border_tree::Edge e, Border_tree::Edge f)
  {
    if (e.first == f.second)
      std::swap(e, f);
    if (e.second == f.first) { // consecutive: they meet if the second turns back onto the first
      const Complex &p = u[e.first], &q = u[e.second], &r = u[f.second];
      return e.first == f.second || (turn(p, q, r) == CGAL::COLLINEAR &&
                                     CGAL::angle(to_point(p), to_point(q), to_point(r)) == CGAL::ACUTE);
    }
    return do_segments_meet(to_vector(u[e.first]), to_vector(u[e.second]), to_vector(u[f.first]),
                            to_vector(u[f.second]));
  }

  const Chart& chart_;
  std::vector<std::vector<Index>> borders_;
  Border_tree tree_;
};

} // namespace Atlas::internal

#endif
