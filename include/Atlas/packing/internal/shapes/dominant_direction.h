// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_DOMINANT_DIRECTION_H
#define ATLAS_PACKING_INTERNAL_SHAPES_DOMINANT_DIRECTION_H

#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// A segment of a border as its direction up to quarter turns sees it.
struct Folded_segment
{
  double angle; ///< four times that of the segment, in (-pi, pi]
  Vec2 segment;
};

inline double total_length(const std::vector<Folded_segment>& segments)
{
  double sum = 0;
  for (const Folded_segment& s : segments)
    sum += length(s.segment);
  return sum;
}

/// Those of the segments, sorted by angle, within the window of angles that has most of their length.
inline std::vector<Folded_segment> longest_window(const std::vector<Folded_segment>& segments, double width)
{
  const std::size_t n = segments.size();
  const auto angle = [&](std::size_t i) { return segments[i % n].angle + (i < n ? 0 : 2 * M_PI); };
  double sum = 0, most = 0;
  std::size_t begin = 0, end = 0;
  for (std::size_t i = 0, j = 0; i < n; ++i) {
    for (; j < i + n && angle(j) - angle(i) <= width; ++j)
      sum += length(segments[j % n].segment);
    if (sum > most) {
      most = sum;
      begin = i;
      end = j;
    }
    sum -= length(segments[i].segment);
  }
  std::vector<Folded_segment> result;
  for (std::size_t i = begin; i < end; ++i)
    result.push_back({angle(i), segments[i % n].segment});
  return result;
}

/// The direction, up to quarter turns, that most of the border of an outline has, if there is one: segments
/// that are parallel or at right angles within half a degree make up at least `least_share` of its length,
/// and not all of them are one side of it. Where many are still nearer to each other, theirs is the
/// direction, so that what is straight and rectangular gives its direction to the last digits. O(n log n).
inline std::optional<Vec2> dominant_direction(const Outline& outline)
{
  constexpr double least_share = 0.45, degree = M_PI / 180;
  std::vector<Folded_segment> segments;
  for (std::size_t s = 0; s < outline.number_of_border_segments; ++s) {
    const Vec2 d = outline.points[outline.segments[s][1]] - outline.points[outline.segments[s][0]];
    const Vec2 square{d.x * d.x - d.y * d.y, 2 * d.x * d.y};
    if (square.x != 0 || square.y != 0)
      segments.push_back({std::atan2(2 * square.x * square.y, square.x * square.x - square.y * square.y), d});
  }
  std::stable_sort(segments.begin(), segments.end(),
                   [](const auto& a, const auto& b) { return a.angle < b.angle; });
  const double perimeter = total_length(segments);
  segments = longest_window(segments, 4 * 0.5 * degree);
  const double aligned = total_length(segments);
  Vec2 chord;
  for (const Folded_segment& s : segments)
    chord = chord + s.segment;
  if (!(aligned >= least_share * perimeter) || !(aligned > 0) || length(chord) > 0.95 * aligned)
    return std::nullopt;
  for (const double width : {4e-3, 4e-5, 4e-7})
    if (std::vector<Folded_segment> narrow = longest_window(segments, width);
        total_length(narrow) >= 0.5 * aligned)
      segments = std::move(narrow);
  double weight = 0, moment = 0;
  for (const Folded_segment& s : segments) {
    weight += dot(s.segment, s.segment);
    moment += dot(s.segment, s.segment) * (s.angle - segments.front().angle);
  }
  if (!(weight > 0))
    return std::nullopt;
  const double angle = (segments.front().angle + moment / weight) / 4;
  return Vec2{std::cos(angle), std::sin(angle)};
}

} // namespace Atlas::internal

#endif
