// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_LAYOUT_QUALITY_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_LAYOUT_QUALITY_H

#include <Atlas/core/Kernel.h>
#include <Atlas/planar/internal/convex_hull.h>
#include <Atlas/planar/internal/segments.h>

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
      const Vec2 a = to_vector(e.source), b = to_vector(e.target), c = to_vector(f->source),
                 d = to_vector(f->target);
      if (do_segments_cross(a, b, c, d) ||
          squared_distance_of_ends(a, b, c, d) < share * share * std::min(length(e), length(*f)))
        return false;
    }
    active.push_back(&e);
  }
  return true;
}

/// The area of the convex hull. O(n log n).
inline double hull_area(const std::vector<Point_2>& points)
{
  std::vector<Vec2> vectors;
  vectors.reserve(points.size());
  for (const Point_2& p : points)
    vectors.push_back(to_vector(p));
  return polygon_area(convex_hull(std::move(vectors)));
}

/// The best rotation and translation of a chain of points onto another, and how far they are apart then.
struct Chain_fit
{
  Vec2 turn{1, 0}, from, to; ///< q -> to + turn (q - from)
  double misfit = 0;         ///< root mean square distance

  Vec2 operator()(Vec2 q) const { return to + rotated(turn, q - from); }
};

/// Fits `q` to `p`. Points count by the lengths of the edges next to them.
inline Chain_fit chain_fit(std::span<const Point_2> p, std::span<const Point_2> q)
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
    return {};
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
  const double length = std::hypot(dot, cross);
  Chain_fit fit;
  if (length > 0)
    fit.turn = (1 / length) * Vec2{dot, cross};
  fit.from = {mean_q.x(), mean_q.y()};
  fit.to = {mean_p.x(), mean_p.y()};
  fit.misfit = std::sqrt(std::max(0.0, squares - 2 * length) / total);
  return fit;
}

} // namespace Atlas::internal

#endif
