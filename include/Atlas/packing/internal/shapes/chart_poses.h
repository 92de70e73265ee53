// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_CHART_POSES_H
#define ATLAS_PACKING_INTERNAL_SHAPES_CHART_POSES_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/dominant_direction.h>
#include <Atlas/packing/internal/shapes/up_direction.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace Atlas::internal {

/// Turns an outline about its centre for good.
inline void take_pose(Outline& outline, Vec2 turn, Chart_rotation rotation)
{
  outline.rotation = rotation;
  outline.pose = rotated(turn, outline.pose);
  for (Vec2& p : outline.points)
    p = rotated(turn, p);
  for (auto& triangle : outline.triangles)
    for (Vec2& p : triangle)
      p = rotated(turn, p);
}

/// Of the four turns that make a direction of length 1 parallel to an axis, the one that leaves `reference`
/// nearest to the first axis.
inline Vec2 turn_to_axis(Vec2 direction, Vec2 reference)
{
  Vec2 best = direction;
  for (int i = 0; i < 3; ++i) {
    direction = {-direction.y, direction.x};
    if (dot(direction, reference) > dot(best, reference))
      best = direction;
  }
  return {best.x, -best.y};
}

/// The turn that puts `up` upright; if the chart is aligned about that way, exactly aligned.
inline Vec2 turn_upright(Vec2 up, const std::optional<Vec2>& dominant)
{
  constexpr double least_cosine = 0.9998; // one degree
  Vec2 turn{up.x, -up.y};
  if (dominant)
    if (const Vec2 aligned = turn_to_axis(*dominant, up); rotated(aligned, up).x >= least_cosine)
      turn = aligned;
  return rotated({0, 1}, turn);
}

/// Brings the outlines of charts to the poses in which they are packed, with the rule for how they may turn
/// from there. Tells whether any of them is aligned, though it might be turned freely.
inline bool take_poses(Outlines& outlines, std::span<const Chart> charts, const Page_options& page,
                       const Execution& execution)
{
  const Vector_3 up(page.up[0], page.up[1], page.up[2]);
  const double l = std::sqrt(up.squared_length());
  const bool is_free =
      page.rotation != Chart_rotation::quarter_turns && page.rotation != Chart_rotation::none;
  std::vector<std::uint8_t> is_aligned(outlines.size(), 0);
  execution.for_each(outlines.size(), [&](std::size_t i) {
    Outline& outline = outlines.charts[i];
    outline.rotation = is_free ? Chart_rotation::any : page.rotation;
    const std::optional<Vec2> mean = l > 0 ? mean_direction(charts[i], up / l) : std::nullopt;
    if (!mean && (!is_free || page.rotation == Chart_rotation::free))
      return;
    const std::optional<Vec2> dominant = dominant_direction(outline);
    if (mean)
      take_pose(outline, turn_upright(*mean, dominant), Chart_rotation::none);
    else if (dominant) {
      take_pose(outline, turn_to_axis(*dominant, {1, 0}), Chart_rotation::quarter_turns);
      is_aligned[i] = 1;
    }
  });
  return std::find(is_aligned.begin(), is_aligned.end(), 1) != is_aligned.end();
}

/// The outlines in their poses, but those as they were that were aligned to the page by choice.
inline Outlines free_again(Outlines plain, const Outlines& posed)
{
  for (std::size_t i = 0; i < plain.size(); ++i)
    if (posed.charts[i].rotation == Chart_rotation::none)
      plain.charts[i] = posed.charts[i];
  return plain;
}

} // namespace Atlas::internal

#endif
