// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_DOMINANT_DIRECTION_H
#define ATLAS_PACKING_INTERNAL_SHAPES_DOMINANT_DIRECTION_H

#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/planar/internal/alignment.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// The direction, up to quarter turns, that most of the border of an outline has, if there is one: segments
/// that are parallel or at right angles within half a degree make up a good part of its length, and not all
/// of them are one side of it. O(n log n).
inline std::optional<Vec2> dominant_direction(const Outline& outline)
{
  std::vector<Vec2> segments;
  for (std::size_t s = 0; s < outline.number_of_border_segments; ++s)
    segments.push_back(outline.points[outline.segments[s][1]] - outline.points[outline.segments[s][0]]);
  const Alignment border = alignment_of(segments);
  return border.is_dominant() ? std::optional(border.direction) : std::nullopt;
}

} // namespace Atlas::internal

#endif
