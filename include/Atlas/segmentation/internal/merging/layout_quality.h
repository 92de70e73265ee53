// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_LAYOUT_QUALITY_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_LAYOUT_QUALITY_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// An edge of a border, with the numbers of its vertices.
struct Border_edge
{
  Point_2 source, target;
  Index first, second;
};

/// The squared distance of two edges that do not cross.
inline double squared_gap(const Border_edge& a, const Border_edge& b)
{
  const auto gap = [](const Point_2& p, const Border_edge& e) {
    const Vector_2 d = e.target - e.source, v = p - e.source;
    const double length = d * d, t = length > 0 ? std::clamp(v * d / length, 0.0, 1.0) : 0;
    return (v - t * d).squared_length();
  };
  return std::min({gap(a.source, b), gap(a.target, b), gap(b.source, a), gap(b.target, a)});
}

/// Whether two edges cross in inner points of both.
inline bool do_cross(const Border_edge& a, const Border_edge& b)
{
  const auto side = [](const Border_edge& e, const Point_2& p) {
    return CGAL::orientation(e.source, e.target, p);
  };
  return side(a, b.source) * side(a, b.target) < 0 && side(b, a.source) * side(b, a.target) < 0;
}

/// Whether a border loop keeps its distance from itself: no two edges cross or come closer than `share` of
/// the shorter one, unless at most one edge is between them. A sweep over x: fast for the borders of charts,
/// quadratic for edges that all overlap in x.
inline bool is_clear(std::vector<Border_edge> edges, double share)
{
  std::vector<std::pair<Index, Index>> next;
  for (const Border_edge& e : edges)
    next.emplace_back(e.first, e.second);
  std::sort(next.begin(), next.end());
  const auto after = [&](Index v) { // border vertices of a disc have one edge that leaves
    return std::lower_bound(next.begin(), next.end(), std::pair<Index, Index>(v, 0))->second;
  };
  const auto leads_to = [&](const Border_edge& a, const Border_edge& b) {
    return a.second == b.first || after(a.second) == b.first;
  };
  const auto length = [](const Border_edge& e) { return CGAL::squared_distance(e.source, e.target); };
  const auto low = [](const Border_edge& e) { return std::min(e.source.x(), e.target.x()); };
  const auto high = [](const Border_edge& e) { return std::max(e.source.x(), e.target.x()); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return low(a) < low(b); });
  double margin = 0;
  for (const Border_edge& e : edges)
    margin = std::max(margin, share * std::sqrt(length(e)));

  std::vector<const Border_edge*> active;
  for (const Border_edge& e : edges) {
    const auto [bottom, top] = std::minmax(e.source.y(), e.target.y());
    std::erase_if(active, [&](const Border_edge* f) { return high(*f) + margin < low(e); });
    for (const Border_edge* f : active) {
      if (std::min(f->source.y(), f->target.y()) > top + margin ||
          std::max(f->source.y(), f->target.y()) + margin < bottom || leads_to(e, *f) || leads_to(*f, e))
        continue;
      if (do_cross(e, *f) || squared_gap(e, *f) < share * share * std::min(length(e), length(*f)))
        return false;
    }
    active.push_back(&e);
  }
  return true;
}

/// The area of the convex hull (Andrew's monotone chain). O(n log n).
inline double hull_area(std::vector<Point_2> points)
{
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  double twice = 0;
  std::vector<Point_2> chain;
  for (int half = 0; half < 2; ++half) {
    chain.clear();
    for (const Point_2& p : points) {
      while (chain.size() > 1 && !CGAL::left_turn(chain[chain.size() - 2], chain.back(), p))
        chain.pop_back();
      chain.push_back(p);
    }
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      twice += (chain[i].x() - points.front().x()) * (chain[i + 1].y() - points.front().y()) -
               (chain[i + 1].x() - points.front().x()) * (chain[i].y() - points.front().y());
    if (half == 0)
      std::reverse(points.begin(), points.end());
  }
  // The second chain was measured from its own first point, which is an end of both: no correction is due.
  return twice / 2;
}

/// The root mean square distance of two chains of points after the best rotation and translation of the
/// second. Points count by the lengths of the edges next to them.
inline double chain_misfit(std::span<const Point_2> p, std::span<const Point_2> q)
{
  const std::size_t n = p.size();
  std::vector<double> weight(n, 0);
  double total = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double l =
        std::sqrt(CGAL::squared_distance(p[i], p[i + 1])) + std::sqrt(CGAL::squared_distance(q[i], q[i + 1]));
    weight[i] += l;
    weight[i + 1] += l;
    total += 2 * l;
  }
  if (!(total > 0))
    return 0;
  Vector_2 mean_p(0, 0), mean_q(0, 0);
  for (std::size_t i = 0; i < n; ++i) {
    mean_p = mean_p + weight[i] / total * (p[i] - CGAL::ORIGIN);
    mean_q = mean_q + weight[i] / total * (q[i] - CGAL::ORIGIN);
  }
  double squares = 0, dot = 0, cross = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector_2 a = p[i] - CGAL::ORIGIN - mean_p, b = q[i] - CGAL::ORIGIN - mean_q;
    squares += weight[i] * (a * a + b * b);
    dot += weight[i] * (a * b);
    cross += weight[i] * (b.x() * a.y() - b.y() * a.x());
  }
  return std::sqrt(std::max(0.0, squares - 2 * std::hypot(dot, cross)) / total);
}

} // namespace Atlas::internal

#endif
