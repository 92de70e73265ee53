// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_CHART_CLEARANCE_H
#define ATLAS_PACKING_INTERNAL_SHAPES_CHART_CLEARANCE_H

#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/planar/internal/segments.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// A chart as it lies on a page, in texels.
struct Placed_outline
{
  const Outline* outline = nullptr;
  std::vector<Vec2> points; ///< as in the outline
};

/// Finds which charts are how near to each other, up to a limit, among charts on one page.
///
/// Segments go to the cells of a grid that they come near to, so that every pair within the limit meets in a
/// cell: near-linear for charts that keep apart.
class Chart_clearance
{
public:
  /// \param limit  distances from here on do not matter, in texels
  Chart_clearance(const std::vector<Placed_outline>& charts, double limit) : charts_(charts), limit_(limit)
  {
    cell_ = std::max(4.0, 2 * limit);
    for (Index i = 0; i < charts.size(); ++i)
      for (Index s = 0; s < charts[i].outline->segments.size(); ++s) {
        const auto [a, b] = charts[i].outline->segments[s];
        segments_.push_back(
            {charts[i].points[a], charts[i].points[b], i, s < charts[i].outline->number_of_border_segments});
      }
    for (Index s = 0; s < segments_.size(); ++s)
      enter(s);
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls `report(chart, chart, distance)` for pairs nearer than the limit, any number of times a pair, and
  /// with distance 0 where charts meet or one lies inside another, until it returns `false`.
  template <typename Report>
  void search(Report report) const
  {
    for (std::size_t begin = 0, end = 0; begin < entries_.size(); begin = end) {
      while (end < entries_.size() && entries_[end].first == entries_[begin].first)
        ++end;
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t j = i + 1; j < end; ++j) {
          const Segment &s = segments_[entries_[i].second], &t = segments_[entries_[j].second];
          if (s.chart == t.chart || boxes_apart(s, t))
            continue;
          const double d = squared_distance(s.a, s.b, t.a, t.b);
          if (d < limit_ * limit_ && !report(s.chart, t.chart, std::sqrt(d)))
            return;
        }
    }
    search_containment(report);
  }

private:
  struct Segment
  {
    Vec2 a, b;
    Index chart;
    bool is_border;
  };

  bool boxes_apart(const Segment& s, const Segment& t) const
  {
    return std::min(s.a.x, s.b.x) - std::max(t.a.x, t.b.x) > limit_ ||
           std::min(t.a.x, t.b.x) - std::max(s.a.x, s.b.x) > limit_ ||
           std::min(s.a.y, s.b.y) - std::max(t.a.y, t.b.y) > limit_ ||
           std::min(t.a.y, t.b.y) - std::max(s.a.y, s.b.y) > limit_;
  }

  std::int64_t cell_of(double x) const { return static_cast<std::int64_t>(std::floor(x / cell_)); }

  static std::uint64_t key(std::int64_t column, std::int64_t row)
  {
    return static_cast<std::uint64_t>(row + (std::int64_t(1) << 31)) << 32 |
           static_cast<std::uint64_t>(column + (std::int64_t(1) << 31));
  }

  /// Enters a segment into the cells within half of the limit, row by row.
  void enter(Index s)
  {
    Vec2 p = segments_[s].a, q = segments_[s].b;
    if (p.y > q.y)
      std::swap(p, q);
    const double reach = 0.5 * limit_ * (1 + 1e-9) + 1e-9 * cell_;
    const double slope = q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0;
    for (std::int64_t row = cell_of(p.y - reach); row <= cell_of(q.y + reach); ++row) {
      const double bottom = static_cast<double>(row) * cell_ - reach, top = bottom + cell_ + 2 * reach;
      double x0 = p.x, x1 = q.x;
      if (bottom > p.y)
        x0 = p.x + slope * (bottom - p.y);
      if (top < q.y)
        x1 = p.x + slope * (top - p.y);
      const double left = std::max(std::min(x0, x1), std::min(p.x, q.x)) - reach;
      const double right = std::min(std::max(x0, x1), std::max(p.x, q.x)) + reach;
      for (std::int64_t column = cell_of(left); column <= cell_of(right); ++column)
        entries_.emplace_back(key(column, row), s);
    }
  }

  /// Winding numbers of one point of each part of each chart, by the segments right of it in its row of
  /// cells.
  template <typename Report>
  void search_containment(Report report) const
  {
    std::vector<std::pair<Index, int>> crossings;
    for (Index i = 0; i < charts_.size(); ++i)
      for (const Index seed : charts_[i].outline->seeds) {
        const Vec2 p = charts_[i].points[seed];
        find_crossings(i, p, crossings);
        for (std::size_t k = 0; k < crossings.size();) {
          int winding = 0;
          const Index j = crossings[k].first;
          for (; k < crossings.size() && crossings[k].first == j; ++k)
            winding += crossings[k].second;
          const bool inside = charts_[j].outline->triangles.empty() ? winding != 0 : is_in_triangle(j, p);
          if (inside && !report(i, j, 0.0))
            return;
        }
      }
  }

  /// Segments of other charts that the ray from `p` to the right crosses, upwards or downwards, by chart.
  void find_crossings(Index chart, Vec2 p, std::vector<std::pair<Index, int>>& crossings) const
  {
    crossings.clear();
    visited_.clear();
    const std::int64_t row = cell_of(p.y);
    for (auto e = std::lower_bound(entries_.begin(), entries_.end(),
                                   std::pair<std::uint64_t, Index>(key(cell_of(p.x), row), 0));
         e != entries_.end() && e->first >> 32 == key(0, row) >> 32; ++e) {
      const Segment& s = segments_[e->second];
      if (s.chart == chart || !s.is_border || (s.a.y <= p.y) == (s.b.y <= p.y))
        continue;
      const bool up = s.a.y <= p.y;
      if ((cross(s.b - s.a, p - s.a) > 0) == up)
        visited_.push_back(e->second);
    }
    std::sort(visited_.begin(), visited_.end());
    visited_.erase(std::unique(visited_.begin(), visited_.end()), visited_.end());
    for (const Index s : visited_) // numbers of segments increase with those of charts
      crossings.emplace_back(segments_[s].chart, segments_[s].a.y <= p.y ? 1 : -1);
  }

  /// Whether a chart that is folded covers `p`. Its triangles are kept about its centre: undo the placement.
  bool is_in_triangle(Index j, Vec2 p) const
  {
    const Outline& outline = *charts_[j].outline;
    const Vec2 q = inverse_image(j, p);
    return std::any_of(outline.triangles.begin(), outline.triangles.end(), [&](const auto& t) {
      const double a = cross(t[1] - t[0], q - t[0]), b = cross(t[2] - t[1], q - t[1]),
                   c = cross(t[0] - t[2], q - t[2]);
      const bool has_area = cross(t[1] - t[0], t[2] - t[0]) != 0; // a point would contain everything
      return has_area && ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0));
    });
  }

  /// The point of the outline's plane that is placed at `p`, from the two points of the outline farthest
  /// along.
  Vec2 inverse_image(Index j, Vec2 p) const
  {
    const std::vector<Vec2>&from = charts_[j].outline->points, &to = charts_[j].points;
    std::size_t k = 0;
    for (std::size_t i = 1; i < from.size(); ++i)
      if (length(from[i] - from[0]) > length(from[k] - from[0]))
        k = i;
    const Vec2 d = from[k] - from[0], e = to[k] - to[0];
    const double l = dot(e, e);
    if (!(l > 0))
      return from[0];
    const Vec2 r = (1 / l) * Vec2{dot(e, d), cross(e, d)};
    return from[0] + rotated(r, p - to[0]);
  }

  const std::vector<Placed_outline>& charts_;
  double limit_, cell_;
  std::vector<Segment> segments_;
  std::vector<std::pair<std::uint64_t, Index>> entries_;
  mutable std::vector<Index> visited_;
};

} // namespace Atlas::internal

#endif
