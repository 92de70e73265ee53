// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_OUTLINE_H
#define ATLAS_PACKING_INTERNAL_SHAPES_OUTLINE_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace Atlas::internal {

/// What a packer needs of a chart: the segments that bound its image, about a centre, in a unit in which the
/// largest chart measures 1.
struct Outline
{
  std::vector<Vec2> points;                   ///< ends of the segments
  std::vector<Index> vertices;                ///< per point: the vertex of the chart
  std::vector<std::array<Index, 2>> segments; ///< those of the border first, the inside on their left
  std::size_t number_of_border_segments = 0;
  int orientation = 0; ///< 1: the triangles are counterclockwise, -1: clockwise, 0: both or degenerate
  std::vector<std::array<Vec2, 3>> triangles;    ///< only of folded charts, whose border alone does not tell
                                                 ///< what is inside
  std::vector<Index> seeds;                      ///< one point of each connected part of the segments
  Vec2 centre;                                   ///< of gravity, in the chart's own coordinates
  double area = 0;                               ///< sum of the areas of the triangles
  double radius = 0;                             ///< largest distance of a point from the centre
  Vec2 pose{1, 0};                               ///< the turn of the chart in which this is its outline
  Chart_rotation rotation = Chart_rotation::any; ///< how it may turn from there

  bool is_empty() const { return points.empty(); }
};

/// The outlines of a set of charts in a common unit.
struct Outlines
{
  std::vector<Outline> charts;
  double unit = 1; ///< chart coordinates x unit = outline coordinates
  double area = 0; ///< of all charts, in outline coordinates

  std::size_t size() const { return charts.size(); }

  /// The placement that takes chart `i` to its pose, scales its outline by `scale`, turns it by the unit
  /// complex number `turn`, and moves its centre to `position`.
  Placement placement(std::size_t i, double scale, Vec2 turn, Vec2 position, Index page = 0) const
  {
    const Vec2 r = (scale * unit) * rotated(turn, charts[i].pose);
    const Vec2 t = position - rotated(r, charts[i].centre);
    return {r.x, r.y, t.x, t.y, page};
  }
};

/// The centre of gravity of a chart, and half of the larger side of the box of its corners.
struct Chart_extent
{
  Vec2 centre;
  double extent = 0;
};

inline Chart_extent extent_of(const Chart& chart)
{
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  const auto at = [&](Index v) { return Vec2{chart.uv[v].x(), chart.uv[v].y()}; };
  for (const auto& triangle : chart.triangles)
    for (const Index v : triangle) {
      low = {std::min(low.x, at(v).x), std::min(low.y, at(v).y)};
      high = {std::max(high.x, at(v).x), std::max(high.y, at(v).y)};
    }
  if (chart.triangles.empty())
    return {};
  const Vec2 middle = 0.5 * low + 0.5 * high;
  const double extent = std::max(high.x / 2 - low.x / 2, high.y / 2 - low.y / 2);
  if (!(extent > 0))
    return {middle, 0};
  Vec2 moment;
  double area = 0;
  for (const auto& [i, j, k] : chart.triangles) {
    const Vec2 a = (1 / extent) * (at(i) - middle), b = (1 / extent) * (at(j) - middle),
               c = (1 / extent) * (at(k) - middle);
    const double weight = std::abs(cross(b - a, c - a));
    area += weight;
    moment = moment + (weight / 3) * (a + b + c);
  }
  return {area > 0 ? middle + (extent / area) * moment : middle, extent};
}

/// One point of each connected part of the segments: the first.
inline void find_seeds(Outline& outline)
{
  Union_find parts(outline.points.size());
  for (const auto& [i, j] : outline.segments)
    parts.unite(i, j);
  for (Index i = 0; i < outline.points.size(); ++i)
    if (parts.find(i) == i)
      outline.seeds.push_back(i);
}

/// Builds the outline of one chart about `outline.centre`. An edge bounds the image unless two triangles lie
/// on its two sides: so the border, and where a chart is not one-to-one also its folds.
inline void build_outline(const Chart& chart, double unit, Outline& outline)
{
  const auto at = [&](Index v) { return unit * (Vec2{chart.uv[v].x(), chart.uv[v].y()} - outline.centre); };
  const std::vector<Index> opposite = opposite_halfedges(chart.triangles);
  std::vector<int> side(chart.triangles.size());
  bool is_folded = false;
  int majority = 0;
  for (std::size_t t = 0; t < side.size(); ++t) {
    const auto& [a, b, c] = chart.triangles[t];
    const double doubled = cross(at(b) - at(a), at(c) - at(a));
    outline.area += std::abs(doubled) / 2;
    side[t] = (doubled > 0) - (doubled < 0);
    if (side[t] != 0) {
      is_folded = is_folded || (majority != 0 && side[t] != majority);
      majority = side[t];
    }
  }
  std::vector<Index> local(chart.uv.size(), no_index);
  const auto point = [&](Index v) {
    if (local[v] == no_index) {
      local[v] = static_cast<Index>(outline.points.size());
      outline.points.push_back(at(v));
      outline.vertices.push_back(v);
      outline.radius = std::max(outline.radius, length(at(v)));
    }
    return local[v];
  };
  outline.orientation = is_folded ? 0 : majority;
  const auto add_segment = [&](Index h) {
    const Index n = next_halfedge(h);
    outline.segments.push_back({point(chart.triangles[h / 3][h % 3]), point(chart.triangles[n / 3][n % 3])});
  };
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] == no_index)
      add_segment(h);
  outline.number_of_border_segments = outline.segments.size();
  for (Index h = 0; h < opposite.size(); ++h)
    if (const Index o = opposite[h];
        o != no_index && h < o && (side[h / 3] != side[o / 3] || side[h / 3] == 0))
      add_segment(h);
  find_seeds(outline);
  if (is_folded)
    for (const auto& [a, b, c] : chart.triangles)
      outline.triangles.push_back({at(a), at(b), at(c)});
}

/// The outlines of all charts. The coordinates have to be finite. O(n log n).
inline Outlines outlines_of(std::span<const Chart> charts, const Execution& execution)
{
  Outlines result;
  result.charts.resize(charts.size());
  double extent = 0;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Chart_extent e = extent_of(charts[i]);
    result.charts[i].centre = e.centre;
    extent = std::max(extent, e.extent);
  }
  if (extent > 0)
    result.unit = 0.5 / extent;
  execution.for_each(charts.size(),
                     [&](std::size_t i) { build_outline(charts[i], result.unit, result.charts[i]); });
  for (const Outline& outline : result.charts)
    result.area += outline.area;
  return result;
}

} // namespace Atlas::internal

#endif
