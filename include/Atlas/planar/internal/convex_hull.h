// SPDX-License-Identifier: MIT
#ifndef ATLAS_PLANAR_INTERNAL_CONVEX_HULL_H
#define ATLAS_PLANAR_INTERNAL_CONVEX_HULL_H

#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// Sorts points by x, then by y. Those of a few convex polygons one after the other are a few runs, up or
/// down, that have to be merged only.
inline void sort_along_x(std::vector<Vec2>& points)
{
  const auto is_less = [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  constexpr std::size_t most_runs = 8;
  std::array<std::size_t, most_runs + 1> ends{0};
  std::size_t runs = 0;
  for (std::size_t i = 0; i < points.size(); i = ends[++runs]) {
    if (runs == most_runs)
      return std::sort(points.begin(), points.end(), is_less);
    std::size_t j = i + 1;
    if (j < points.size() && is_less(points[j], points[i])) {
      for (; j < points.size() && is_less(points[j], points[j - 1]);)
        ++j;
      std::reverse(points.data() + i, points.data() + j);
    } else
      for (; j < points.size() && !is_less(points[j], points[j - 1]);)
        ++j;
    ends[runs + 1] = j;
  }
  std::vector<Vec2> merged(runs > 1 ? points.size() : 0);
  for (; runs > 1; runs = (runs + 1) / 2) {
    for (std::size_t r = 0; r < runs; r += 2) {
      const std::size_t middle = ends[r + 1], end = ends[std::min(r + 2, runs)];
      std::merge(points.data() + ends[r], points.data() + middle, points.data() + middle, points.data() + end,
                 merged.data() + ends[r], is_less);
      ends[r / 2 + 1] = end;
    }
    std::swap(points, merged);
  }
}

/// The convex hull, counterclockwise (monotone chain). One or two points for degenerate sets. O(n log n).
/// Rounding may lose points by rounding distance: hulls only orient and measure charts.
inline std::vector<Vec2> convex_hull(std::vector<Vec2> points)
{
  sort_along_x(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3)
    return points;
  std::vector<Vec2> hull;
  hull.reserve(points.size() + 1);
  const auto chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

/// Width and height of the bounding rectangle with a side in the direction `e`.
inline Vec2 size_along(const std::vector<Vec2>& points, Vec2 e)
{
  const Vec2 up{-e.y, e.x};
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Vec2 p : points) {
    low = {std::min(low.x, dot(e, p)), std::min(low.y, dot(up, p))};
    high = {std::max(high.x, dot(e, p)), std::max(high.y, dot(up, p))};
  }
  return high - low;
}

/// The area of a polygon, counterclockwise, in double precision.
inline double polygon_area(const std::vector<Vec2>& polygon)
{
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return twice / 2;
}

/// The direction of the largest distance between two points of a convex polygon, as a vector; zero for a
/// point. Rotating calipers, O(n).
inline Vec2 diameter(const std::vector<Vec2>& hull)
{
  const std::size_t n = hull.size();
  Vec2 best;
  const auto take = [&](Vec2 d) {
    if (dot(d, d) > dot(best, best))
      best = d;
  };
  std::size_t j = n > 1 ? 1 : 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 edge = hull[(i + 1) % n] - hull[i];
    for (std::size_t steps = 0; steps < n && cross(edge, hull[(j + 1) % n] - hull[j]) > 0; ++steps) {
      take(hull[j] - hull[i]);
      j = (j + 1) % n;
    }
    take(hull[j] - hull[i]);
    take(hull[j] - hull[(i + 1) % n]);
  }
  return best;
}

/// The unit direction of one side of the bounding rectangle of least area, which lies along an edge of the
/// hull; (1, 0) for a point. Rotating calipers, O(n).
inline Vec2 least_rectangle_direction(const std::vector<Vec2>& hull)
{
  const std::size_t n = hull.size();
  Vec2 best{1, 0};
  double best_area = HUGE_VAL;
  std::size_t right = 0, top = 0, left = 0;
  const auto after = [&](std::size_t k) { return k + 1 < n ? k + 1 : 0; };
  const auto advance = [&](std::size_t& k, Vec2 direction) {
    for (std::size_t steps = 0; steps < n && dot(direction, hull[after(k)] - hull[k]) >= 0; ++steps)
      k = after(k);
  };
  for (std::size_t i = 0; i < n && n > 1; ++i) {
    Vec2 e = hull[after(i)] - hull[i];
    const double l = length(e);
    if (!(l > 0))
      continue;
    e = (1 / l) * e;
    const Vec2 up{-e.y, e.x};
    advance(right, e);
    advance(top, up);
    if (i == 0)
      left = top;
    advance(left, {-e.x, -e.y});
    const double area = dot(e, hull[right] - hull[left]) * dot(up, hull[top] - hull[i]);
    if (area < best_area) {
      best_area = area;
      best = e;
    }
  }
  return best;
}

} // namespace Atlas::internal

#endif
