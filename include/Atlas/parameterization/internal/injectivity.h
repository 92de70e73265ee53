// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_INJECTIVITY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_INJECTIVITY_H

#include <Atlas/Chart.h>
#include <Atlas/internal/connectivity.h>
#include <Atlas/parameterization/internal/chart_geometry.h>

#include <algorithm>
#include <cstddef>
#include <limits>
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

  Injectivity_checker(const Chart& chart, const std::vector<Index>& opposite) : chart_(chart)
  {
    for (const std::vector<Index>& loop : border_loops(opposite)) {
      std::vector<Index>& border = borders_.emplace_back();
      for (const Index h : loop)
        border.push_back(chart.triangles[h / 3][h % 3]);
    }
  }

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
  bool is_border_simple(std::span<const Complex> u) const
  {
    Boxes boxes;
    for (const std::vector<Index>& border : borders_)
      for (std::size_t i = 0; i < border.size(); ++i)
        boxes.edges.emplace_back(border[i], border[i + 1 == border.size() ? 0 : i + 1]);
    if (boxes.edges.empty())
      return true;
    boxes.nodes.resize(2 * boxes.edges.size());
    boxes.build(u, 0, 0, boxes.edges.size());
    return !boxes.meets_itself(u, 0, 0, boxes.edges.size());
  }

  bool is_one_to_one(std::span<const Complex> u) const { return !has_flip(u) && is_border_simple(u); }

private:
  struct Box
  {
    double low[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    double high[2] = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

    void add(const Complex& z)
    {
      low[0] = std::min(low[0], z.real()), high[0] = std::max(high[0], z.real());
      low[1] = std::min(low[1], z.imag()), high[1] = std::max(high[1], z.imag());
    }
    void add(const Box& box)
    {
      for (int i = 0; i < 2; ++i)
        low[i] = std::min(low[i], box.low[i]), high[i] = std::max(high[i], box.high[i]);
    }
    bool meets(const Box& other) const
    {
      return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
             other.low[1] <= high[1];
    }
  };

  /// A binary tree of boxes over the border edges in the order of the border, which keeps near edges
  /// together. The node of edges [begin, end) has its left child next to it and the right one after that.
  struct Boxes
  {
    std::vector<std::pair<Index, Index>> edges;
    std::vector<Box> nodes;

    static std::size_t middle(std::size_t begin, std::size_t end) { return begin + (end - begin) / 2; }
    static std::size_t right(std::size_t node, std::size_t begin, std::size_t end)
    {
      return node + 2 * (middle(begin, end) - begin);
    }

    void build(std::span<const Complex> u, std::size_t node, std::size_t begin, std::size_t end)
    {
      if (end - begin == 1) {
        nodes[node].add(u[edges[begin].first]);
        nodes[node].add(u[edges[begin].second]);
        return;
      }
      const std::size_t m = middle(begin, end), r = right(node, begin, end);
      build(u, node + 1, begin, m);
      build(u, r, m, end);
      nodes[node].add(nodes[node + 1]);
      nodes[node].add(nodes[r]);
    }

    bool meets_itself(std::span<const Complex> u, std::size_t node, std::size_t begin, std::size_t end) const
    {
      if (end - begin == 1)
        return false;
      const std::size_t m = middle(begin, end), r = right(node, begin, end);
      return meets_itself(u, node + 1, begin, m) || meets_itself(u, r, m, end) ||
             meet(u, node + 1, begin, m, r, m, end);
    }

    bool meet(std::span<const Complex> u, std::size_t node_a, std::size_t begin_a, std::size_t end_a,
              std::size_t node_b, std::size_t begin_b, std::size_t end_b) const
    {
      if (!nodes[node_a].meets(nodes[node_b]))
        return false;
      if (end_a - begin_a == 1 && end_b - begin_b == 1)
        return do_edges_meet(u, edges[begin_a], edges[begin_b]);
      if (end_a - begin_a >= end_b - begin_b) {
        const std::size_t m = middle(begin_a, end_a);
        return meet(u, node_a + 1, begin_a, m, node_b, begin_b, end_b) ||
               meet(u, right(node_a, begin_a, end_a), m, end_a, node_b, begin_b, end_b);
      }
      const std::size_t m = middle(begin_b, end_b);
      return meet(u, node_a, begin_a, end_a, node_b + 1, begin_b, m) ||
             meet(u, node_a, begin_a, end_a, right(node_b, begin_b, end_b), m, end_b);
    }
  };

  static bool do_edges_meet(std::span<const Complex> u, std::pair<Index, Index> e, std::pair<Index, Index> f)
  {
    if (e.first == f.second)
      std::swap(e, f);
    if (e.second == f.first) { // consecutive: they meet if the second turns back onto the first
      const Complex &p = u[e.first], &q = u[e.second], &r = u[f.second];
      return e.first == f.second || (turn(p, q, r) == CGAL::COLLINEAR &&
                                     CGAL::angle(to_point(p), to_point(q), to_point(r)) == CGAL::ACUTE);
    }
    const Complex &p = u[e.first], &q = u[e.second], &r = u[f.first], &s = u[f.second];
    const int pr = turn(p, q, r), ps = turn(p, q, s), rp = turn(r, s, p), rq = turn(r, s, q);
    // Collinear edges meet if their boxes do, and the boxes do.
    return pr * ps <= 0 && rp * rq <= 0;
  }

  const Chart& chart_;
  std::vector<std::vector<Index>> borders_;
};

} // namespace Atlas::internal

#endif
