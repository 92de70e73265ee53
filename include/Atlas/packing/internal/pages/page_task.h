// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PAGE_TASK_H
#define ATLAS_PACKING_INTERNAL_PAGES_PAGE_TASK_H

#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/planar/internal/vectors.h>

#include <optional>
#include <vector>

namespace Atlas::internal {

// Between what engines see and what the library's own engines work on.

inline Page_piece page_piece(const Outline& outline)
{
  Page_piece piece;
  piece.points.reserve(outline.points.size());
  for (const Vec2& p : outline.points)
    piece.points.push_back(to_complex(p));
  piece.segments = outline.segments;
  piece.number_of_border_segments = outline.number_of_border_segments;
  piece.orientation = outline.orientation;
  for (const auto& [a, b, c] : outline.triangles)
    piece.triangles.push_back({to_complex(a), to_complex(b), to_complex(c)});
  piece.area = outline.area;
  piece.radius = outline.radius;
  piece.rotation = outline.rotation;
  return piece;
}

inline Outline outline_of(const Page_piece& piece)
{
  Outline outline;
  outline.points.reserve(piece.points.size());
  for (const Complex& z : piece.points)
    outline.points.push_back(to_vector(z));
  outline.segments = piece.segments;
  outline.number_of_border_segments = piece.number_of_border_segments;
  outline.orientation = piece.orientation;
  for (const auto& [a, b, c] : piece.triangles)
    outline.triangles.push_back({to_vector(a), to_vector(b), to_vector(c)});
  outline.area = piece.area;
  outline.radius = piece.radius;
  outline.rotation = piece.rotation;
  find_seeds(outline);
  return outline;
}

/// The pieces of a task.
inline Outlines outlines_of(const Page_task& task)
{
  Outlines result;
  for (const Page_piece& piece : task.pieces) {
    result.charts.push_back(outline_of(piece));
    result.area += piece.area;
  }
  return result;
}

/// The obstacles of a task.
inline Obstacles obstacles_of(const Page_task& task)
{
  Obstacles result;
  for (const Page_obstacle& obstacle : task.obstacles) {
    result.outlines.push_back(outline_of(obstacle.outline));
    result.outlines.back().centre = to_vector(obstacle.centre);
  }
  return result;
}

inline std::optional<Page_layout> page_layout(const std::optional<Layout>& layout)
{
  if (!layout)
    return std::nullopt;
  Page_layout result{layout->scale, layout->margin, {}, {}};
  for (std::size_t i = 0; i < layout->turns.size(); ++i) {
    result.turns.push_back(to_complex(layout->turns[i]));
    result.positions.push_back(to_complex(layout->positions[i]));
  }
  return result;
}

inline Layout layout_of(const Page_layout& layout)
{
  Layout result{layout.scale, layout.margin, {}, {}};
  for (std::size_t i = 0; i < layout.turns.size(); ++i) {
    result.turns.push_back(to_vector(layout.turns[i]));
    result.positions.push_back(to_vector(layout.positions[i]));
  }
  return result;
}

} // namespace Atlas::internal

#endif
