// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_PACKING_SHAPE_H
#define ATLAS_PACKING_INTERNAL_SHAPES_PACKING_SHAPE_H

#include <Atlas/packing/internal/shapes/Distance_field.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/simplify.h>
#include <Atlas/planar/internal/convex_hull.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// How fine shapes are made, in outline coordinates.
struct Shape_resolution
{
  double tolerance = 0;        ///< of simplification
  double spacing = 0;          ///< between samples
  double cell = 0;             ///< of distance fields, at most
  double gutter = 0;           ///< the distance at which charts meet
  double cells_per_chart = 20; ///< of distance fields, at least
};

/// A chart as the raster and the relaxation of contacts see it: simplified, about its centre of gravity, in
/// the frame of its bounding rectangle of least area.
struct Packing_shape
{
  /// A circle around consecutive samples. Nodes are in preorder.
  struct Node
  {
    Vec2 centre;
    double radius;
    Index begin, end; ///< samples
    Index skip;       ///< the node after all nodes below this one
  };

  Segment_set set;
  std::vector<Vec2> samples; ///< all corners, and points between them
  std::vector<Node> nodes;
  std::vector<Vec2> hull;
  Distance_field field;
  Vec2 frame{1, 0}; ///< the turn that brought the outline here
  double area = 0, mass = 0, inertia = 0, radius = 0;
  double width = 0, height = 0; ///< of the bounding rectangle
  Vec2 middle;                  ///< of that, from the centre of gravity
  double perimeter = 0;
  Chart_rotation rotation = Chart_rotation::any;

  bool may_turn() const { return rotation == Chart_rotation::any; }
};

/// Builds the nodes over samples [begin, end).
inline void build_nodes(Packing_shape& shape, Index begin, Index end)
{
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (Index i = begin; i < end; ++i) {
    const Vec2 p = shape.samples[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 centre = 0.5 * (low + high);
  double radius = 0;
  for (Index i = begin; i < end; ++i)
    radius = std::max(radius, length(shape.samples[i] - centre));
  const std::size_t self = shape.nodes.size();
  shape.nodes.push_back({centre, radius, begin, end, 0});
  if (end - begin > 4) {
    const Index middle = begin + (end - begin) / 2;
    build_nodes(shape, begin, middle);
    build_nodes(shape, middle, end);
  }
  shape.nodes[self].skip = static_cast<Index>(shape.nodes.size());
}

/// Samples a chain of points at most `spacing` apart.
inline void add_samples(Packing_shape& shape, const std::vector<Vec2>& points,
                        const std::vector<Index>& chain, double spacing)
{
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Vec2 a = points[chain[i]], b = points[chain[i + 1]];
    const double l = length(b - a);
    const int steps = static_cast<int>(std::clamp(std::ceil(l / spacing), 1.0, 1e4));
    for (int k = 0; k < steps; ++k)
      shape.samples.push_back(a + (double(k) / steps) * (b - a));
    shape.perimeter += l;
  }
  if (chain.size() < 2 || !(points[chain.front()] == points[chain.back()]))
    shape.samples.push_back(points[chain.back()]);
}

/// Turns the outline into its frame: sets the frame, the hull and the bounding rectangle. Gives the points.
inline std::vector<Vec2> set_frame(Packing_shape& shape, const Outline& outline)
{
  const std::vector<Vec2> hull = convex_hull(outline.points);
  if (shape.may_turn()) {
    const Vec2 e = least_rectangle_direction(hull);
    shape.frame = {e.x, -e.y};
  }
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Vec2& p : hull) {
    const Vec2 q = rotated(shape.frame, p);
    shape.hull.push_back(q);
    low = {std::min(low.x, q.x), std::min(low.y, q.y)};
    high = {std::max(high.x, q.x), std::max(high.y, q.y)};
  }
  shape.width = high.x - low.x;
  shape.height = high.y - low.y;
  shape.middle = 0.5 * (low + high);
  shape.radius = outline.radius;
  std::vector<Vec2> points;
  for (const Vec2& p : outline.points)
    points.push_back(rotated(shape.frame, p));
  return points;
}

/// Simplifies the segments and samples them, the border first as in the outline. Gives the number of border
/// segments.
inline std::size_t add_segments(Packing_shape& shape, const Outline& outline, const std::vector<Vec2>& points,
                                const Shape_resolution& resolution)
{
  std::size_t border = 0;
  std::vector<Index> local(points.size(), no_index);
  const auto point = [&](Index i) {
    if (local[i] == no_index) {
      local[i] = static_cast<Index>(shape.set.points.size());
      shape.set.points.push_back(points[i]);
    }
    return local[i];
  };
  Outline part;
  part.points = points;
  const auto split =
      outline.segments.begin() + static_cast<std::ptrdiff_t>(outline.number_of_border_segments);
  for (const bool is_border : {true, false}) {
    part.segments.assign(is_border ? outline.segments.begin() : split,
                         is_border ? split : outline.segments.end());
    for (const std::vector<Index>& chain : chains_of(part)) {
      const std::vector<Index> kept = simplified_chain(points, chain, resolution.tolerance);
      for (std::size_t i = 0; i + 1 < kept.size(); ++i)
        shape.set.segments.push_back({point(kept[i]), point(kept[i + 1])});
      add_samples(shape, points, kept, resolution.spacing);
    }
    if (is_border)
      border = shape.set.segments.size();
  }
  return border;
}

/// The shape of an outline that is not empty. Its frame differs from the outline's if it may turn freely.
inline Packing_shape packing_shape(const Outline& outline, const Shape_resolution& resolution)
{
  Packing_shape shape;
  shape.rotation = outline.rotation;
  const std::vector<Vec2> points = set_frame(shape, outline);
  const std::size_t border = add_segments(shape, outline, points, resolution);
  if (outline.orientation != 0 && border == shape.set.segments.size())
    shape.set.orient(outline.orientation);
  build_nodes(shape, 0, static_cast<Index>(shape.samples.size()));

  std::vector<std::array<Vec2, 3>> triangles;
  for (const auto& [a, b, c] : outline.triangles)
    triangles.push_back({rotated(shape.frame, a), rotated(shape.frame, b), rotated(shape.frame, c)});
  const double cell = std::max(std::min(resolution.cell, 2 * shape.radius / resolution.cells_per_chart),
                               resolution.gutter / 6);
  shape.field.build(shape.set, border, triangles, cell, 1.5 * resolution.gutter + 2 * cell);

  shape.area = outline.area;
  shape.mass = outline.area + (shape.perimeter / 2 + 2 * resolution.gutter) * resolution.gutter;
  shape.inertia =
      shape.mass * std::max(shape.radius * shape.radius / 3, resolution.gutter * resolution.gutter);
  return shape;
}

} // namespace Atlas::internal

#endif
