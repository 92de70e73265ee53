// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_LAYOUT_SHAPE_H
#define ATLAS_SEGMENTATION_INTERNAL_LAYOUT_SHAPE_H

#include <Atlas/Kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

using Edge_2 = std::pair<Point_2, Point_2>;

/// Whether two edges cross in inner points of both.
inline bool do_cross(const Edge_2& a, const Edge_2& b)
{
  const auto side = [](const Edge_2& e, const Point_2& p) { return CGAL::orientation(e.first, e.second, p); };
  return side(a, b.first) * side(a, b.second) < 0 && side(b, a.first) * side(b, a.second) < 0;
}

/// Whether any two of the edges cross. A sweep over x: fast for the borders of charts, quadratic for edges
/// that all overlap in x.
inline bool has_crossing(std::vector<Edge_2> edges)
{
  const auto low = [](const Edge_2& e) { return std::min(e.first.x(), e.second.x()); };
  const auto high = [](const Edge_2& e) { return std::max(e.first.x(), e.second.x()); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return low(a) < low(b); });
  std::vector<const Edge_2*> active;
  for (const Edge_2& e : edges) {
    const auto [bottom, top] = std::minmax(e.first.y(), e.second.y());
    std::erase_if(active, [&](const Edge_2* f) { return high(*f) < low(e); });
    for (const Edge_2* f : active)
      if (std::min(f->first.y(), f->second.y()) <= top && std::max(f->first.y(), f->second.y()) >= bottom &&
          do_cross(e, *f))
        return true;
    active.push_back(&e);
  }
  return false;
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
    const double l = std::sqrt(CGAL::squared_distance(p[i], p[i + 1])) +
                     std::sqrt(CGAL::squared_distance(q[i], q[i + 1]));
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
