// SPDX-License-Identifier: MIT
#ifndef ATLAS_PLANAR_INTERNAL_ALIGNMENT_H
#define ATLAS_PLANAR_INTERNAL_ALIGNMENT_H

#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// \brief How much of a border has one direction up to quarter turns.
struct Alignment
{
  Vec2 direction{1, 0};           ///< of length 1
  double aligned = 0, border = 0; ///< lengths: of what has the direction within half a degree, and of all
  double chord = 0;               ///< of the aligned segments put end to end

  /// Whether the direction is that of a border which goes round something: most of what is aligned is not one
  /// side.
  bool is_dominant() const
  {
    constexpr double least_share = 0.45;
    return aligned >= least_share * border && aligned > 0 && chord <= 0.95 * aligned;
  }
};

/// Where many of the aligned segments are still nearer to each other, theirs is the direction, so that what
/// is straight and rectangular gives its direction to the last digits. O(n log n).
inline Alignment alignment_of(const std::vector<Vec2>& border)
{
  constexpr double degree = M_PI / 180;
  std::vector<Folded_segment> segments;
  for (const Vec2 d : border) {
    const Vec2 square{d.x * d.x - d.y * d.y, 2 * d.x * d.y};
    if (square.x != 0 || square.y != 0)
      segments.push_back({std::atan2(2 * square.x * square.y, square.x * square.x - square.y * square.y), d});
  }
  std::stable_sort(segments.begin(), segments.end(),
                   [](const auto& a, const auto& b) { return a.angle < b.angle; });
  Alignment result;
  result.border = total_length(segments);
  segments = longest_window(segments, 4 * 0.5 * degree);
  result.aligned = total_length(segments);
  Vec2 chord;
  for (const Folded_segment& s : segments)
    chord = chord + s.segment;
  result.chord = length(chord);
  for (const double width : {4e-3, 4e-5, 4e-7})
    if (std::vector<Folded_segment> narrow = longest_window(segments, width);
        total_length(narrow) >= 0.5 * result.aligned)
      segments = std::move(narrow);
  double weight = 0, moment = 0;
  for (const Folded_segment& s : segments) {
    weight += dot(s.segment, s.segment);
    moment += dot(s.segment, s.segment) * (s.angle - segments.front().angle);
  }
  if (weight > 0) {
    const double angle = (segments.front().angle + moment / weight) / 4;
    result.direction = {std::cos(angle), std::sin(angle)};
  } else
    result.aligned = 0;
  return result;
}

} // namespace Atlas::internal

#endif
