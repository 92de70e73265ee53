// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_ISOMETRIC_UNROLL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_ISOMETRIC_UNROLL_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/planar/internal/convex_hull.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Rolls a chart out onto the plane, triangle by triangle, without changing a length.
///
/// Each triangle is laid beside one that lies already, along the longest edge there is: so directions never
/// hang on short edges, and slivers do no harm. A vertex stays where its first triangle put it. On a
/// developable chart later triangles find their corners in the right places; elsewhere they are deformed.
/// O(n log n).
class Chart_unroller
{
public:
  /// \pre the chart is connected and not empty
  explicit Chart_unroller(const Chart& chart)
      : chart_(chart), opposite_(opposite_halfedges(chart.triangles)), corner_(3 * chart.triangles.size()),
        place_(chart.points.size()), is_placed_(chart.points.size(), false)
  {}

  /// Per vertex its place; empty if some triangle could not be reached.
  std::vector<Vec2> operator()()
  {
    std::vector<bool> is_laid(chart_.triangles.size(), false);
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, Earlier> queue;
    std::size_t laid = 0;
    const auto lay = [&](Index t) {
      is_laid[t] = true;
      ++laid;
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        settle(h);
        if (const Index o = opposite_[h]; o != no_index && !is_laid[o / 3])
          queue.emplace(edge(h), h);
      }
    };
    const Index start = longest_edge();
    corner_[start] = {0, 0};
    corner_[next_halfedge(start)] = {edge(start), 0};
    lay_apex(start);
    lay(start / 3);
    while (!queue.empty()) {
      const Index h = queue.top().second, o = opposite_[h];
      queue.pop();
      if (is_laid[o / 3])
        continue;
      corner_[o] = corner_[next_halfedge(h)];
      corner_[next_halfedge(o)] = corner_[h];
      lay_apex(o);
      lay(o / 3);
    }
    return laid == chart_.triangles.size() ? std::move(place_) : std::vector<Vec2>();
  }

private:
  struct Earlier // the longest first, among equals that of the least number
  {
    bool operator()(const std::pair<double, Index>& a, const std::pair<double, Index>& b) const
    {
      return std::tie(a.first, b.second) < std::tie(b.first, a.second);
    }
  };

  Index vertex(Index h) const { return chart_.triangles[h / 3][h % 3]; }
  const Point_3& point(Index h) const { return chart_.points[vertex(h)]; }
  double edge(Index h) const { return std::sqrt(CGAL::squared_distance(point(h), point(next_halfedge(h)))); }

  Index longest_edge() const
  {
    Index best = 0;
    for (Index h = 1; h < corner_.size(); ++h)
      if (edge(h) > edge(best))
        best = h;
    return best;
  }

  /// Places the third corner to the left of edge h, whose ends have their places.
  void lay_apex(Index h)
  {
    const Vector_3 e = point(next_halfedge(h)) - point(h), d = point(previous_halfedge(h)) - point(h);
    const Vec2 a = corner_[h], u = corner_[next_halfedge(h)] - a;
    const double l = std::sqrt(e * e);
    if (!(l > 0)) {
      corner_[previous_halfedge(h)] = a;
      return;
    }
    const double along = (d * e) / l, up = std::sqrt(CGAL::cross_product(e, d).squared_length()) / l;
    const Vec2 x = (1 / length(u)) * u;
    corner_[previous_halfedge(h)] = a + along * x + up * Vec2{-x.y, x.x};
  }

  void settle(Index h)
  {
    if (!is_placed_[vertex(h)])
      place_[vertex(h)] = corner_[h];
    is_placed_[vertex(h)] = true;
  }

  const Chart& chart_;
  std::vector<Index> opposite_;
  std::vector<Vec2> corner_; ///< per halfedge: where its triangle begins it
  std::vector<Vec2> place_;  ///< per vertex
  std::vector<bool> is_placed_;
};

/// The direction, as a unit vector, to which most of the border is parallel or perpendicular; if no direction
/// has a good part of it, that of the bounding rectangle of least area. O(n log n).
inline Vec2 dominant_direction(const Chart& chart, const std::vector<Vec2>& place)
{
  constexpr double same_direction = 1e-4, good_part = 0.2;
  const double quarter = CGAL_PI / 2;
  const std::vector<Index> opposite = opposite_halfedges(chart.triangles);
  std::vector<std::pair<double, double>> edges; // direction in [0, pi / 2), length
  double total = 0;
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] == no_index) {
      const Index n = next_halfedge(h);
      const Vec2 d = place[chart.triangles[n / 3][n % 3]] - place[chart.triangles[h / 3][h % 3]];
      const double a = std::fmod(std::atan2(d.y, d.x) + 4 * quarter + same_direction, quarter);
      edges.emplace_back(a, length(d));
      total += length(d);
    }
  std::sort(edges.begin(), edges.end());
  double best = 0, sum = 0, angle = 0;
  for (std::size_t first = 0, last = 0; last < edges.size(); ++last) {
    sum += edges[last].second;
    while (edges[last].first - edges[first].first > 2 * same_direction)
      sum -= edges[first++].second;
    if (sum > best * (1 + 1e-9)) {
      best = sum;
      double weighted = 0; // the longest of them tells best
      for (std::size_t k = first; k <= last; ++k)
        if (edges[k].second > weighted) {
          weighted = edges[k].second;
          angle = edges[k].first - same_direction;
        }
    }
  }
  if (best >= good_part * total)
    return {std::cos(angle), std::sin(angle)};
  return least_rectangle_direction(convex_hull(place));
}

} // namespace Atlas::internal

#endif
