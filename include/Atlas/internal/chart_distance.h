// SPDX-License-Identifier: MIT
#ifndef ATLAS_INTERNAL_CHART_DISTANCE_H
#define ATLAS_INTERNAL_CHART_DISTANCE_H

#include <Atlas/Execution.h>
#include <Atlas/Kernel.h>
#include <Atlas/internal/box_tree.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

namespace Atlas::internal {

/// A piece of the border of a chart.
struct Border_segment
{
  Point_2 a, b;
  Index chart;
  Index triangle;
};

/// Squared distance of a point from a segment, in double precision.
inline double squared_distance(const Point_2& p, const Point_2& a, const Point_2& b)
{
  const Vector_2 d = b - a, v = p - a;
  const double length = d.squared_length();
  const double t = length > 0 ? std::clamp((v * d) / length, 0.0, 1.0) : 0.0;
  return (v - t * d).squared_length();
}

/// Squared distance of two segments in double precision; zero exactly when they have a point in common.
inline double squared_distance(const Border_segment& s, const Border_segment& t)
{
  const CGAL::Orientation a = CGAL::orientation(s.a, s.b, t.a), b = CGAL::orientation(s.a, s.b, t.b),
                          c = CGAL::orientation(t.a, t.b, s.a), d = CGAL::orientation(t.a, t.b, s.b);
  const auto is_in_box = [](const Point_2& p, const Border_segment& of) {
    const auto [x0, x1] = std::minmax(of.a.x(), of.b.x());
    const auto [y0, y1] = std::minmax(of.a.y(), of.b.y());
    return x0 <= p.x() && p.x() <= x1 && y0 <= p.y() && p.y() <= y1;
  };
  if ((a * b < 0 && c * d < 0) || (a == 0 && is_in_box(t.a, s)) || (b == 0 && is_in_box(t.b, s)) ||
      (c == 0 && is_in_box(s.a, t)) || (d == 0 && is_in_box(s.b, t)))
    return 0;
  return std::min({squared_distance(s.a, t.a, t.b), squared_distance(s.b, t.a, t.b),
                   squared_distance(t.a, s.a, s.b), squared_distance(t.b, s.a, s.b)});
}

/// The smallest distance between segments of different charts, squared, and the triangles that have it.
struct Chart_distance
{
  double squared = std::numeric_limits<double>::infinity();
  Index first = no_index, second = no_index; ///< triangles

  bool operator<(const Chart_distance& other) const
  {
    return std::tie(squared, first, second) < std::tie(other.squared, other.first, other.second);
  }
};

/// Finds the smallest distance of the borders of different charts. O(n log n) where borders run apart.
inline Chart_distance find_chart_distance(const std::vector<Border_segment>& segments,
                                          const Execution& execution)
{
  constexpr std::size_t block_size = 256;
  std::vector<Box_2> boxes(segments.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].add(segments[i].a.x(), segments[i].a.y());
    boxes[i].add(segments[i].b.x(), segments[i].b.y());
  }
  const Box_tree tree(boxes, 4, execution);
  const auto at = [&](std::size_t i) -> const Border_segment& { return segments[tree.order()[i]]; };
  const auto measure = [&](std::size_t i, std::size_t j, Chart_distance& best) {
    const double d = squared_distance(at(i), at(j));
    if (d < best.squared)
      best = {d, std::min(at(i).triangle, at(j).triangle), std::max(at(i).triangle, at(j).triangle)};
  };

  // Places up to which the chart stays the same: subtrees of one chart are passed by. And a first guess.
  std::vector<Index> same_until(segments.size());
  Chart_distance guess;
  for (std::size_t i = segments.size(); i-- > 0;) {
    const bool is_last = i + 1 == segments.size() || at(i).chart != at(i + 1).chart;
    same_until[i] = is_last ? static_cast<Index>(i + 1) : same_until[i + 1];
    if (is_last && i + 1 < segments.size())
      measure(i, i + 1, guess);
  }

  std::vector<Chart_distance> found((segments.size() + block_size - 1) / block_size, guess);
  execution.for_each(found.size(), [&](std::size_t block) {
    Chart_distance& best = found[block];
    for (std::size_t i = block * block_size; i < std::min(segments.size(), (block + 1) * block_size); ++i) {
      const Box_2& box = boxes[tree.order()[i]];
      tree.visit(
          [&](const Box_2& node, std::size_t first, std::size_t last) {
            return last > i + 1 && !(at(first).chart == at(i).chart && same_until[first] >= last) &&
                   node.squared_distance(box) < best.squared;
          },
          [&](std::size_t first, std::size_t last) {
            for (std::size_t j = std::max(first, i + 1); j < last; ++j)
              if (at(j).chart != at(i).chart && boxes[tree.order()[j]].squared_distance(box) < best.squared)
                measure(i, j, best);
          });
    }
  });
  return found.empty() ? guess : *std::min_element(found.begin(), found.end());
}

} // namespace Atlas::internal

#endif
