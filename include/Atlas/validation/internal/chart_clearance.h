// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_CHART_CLEARANCE_H
#define ATLAS_VALIDATION_INTERNAL_CHART_CLEARANCE_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Kernel.h>
#include <Atlas/planar/internal/box_tree.h>
#include <Atlas/planar/internal/segments.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// Squared distance of two segments in double precision; zero exactly when they have a point in common.
inline double squared_distance(const Border_segment& s, const Border_segment& t)
{
  return squared_distance(to_vector(s.a), to_vector(s.b), to_vector(t.a), to_vector(t.b));
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

/// \brief Looks for borders of different charts near each other, in a tree of boxes.
class Border_search
{
public:
  Border_search(const std::vector<Border_segment>& segments, const Execution& execution)
      : segments_(segments), boxes_(boxes(segments)), tree_(boxes_, 4, execution),
        same_until_(segments.size())
  {
    for (std::size_t i = segments.size(); i-- > 0;) {
      const bool is_last = i + 1 == segments.size() || at(i).chart != at(i + 1).chart;
      same_until_[i] = is_last ? static_cast<Index>(i + 1) : same_until_[i + 1];
    }
  }

  /// The smallest distance. O(n log n) where borders run apart.
  Chart_distance nearest(const Execution& execution) const
  {
    Chart_distance guess;
    for (std::size_t i = 0; i + 1 < segments_.size(); ++i)
      if (at(i).chart != at(i + 1).chart)
        measure(i, i + 1, guess);
    std::vector<Chart_distance> found(number_of_blocks(), guess);
    in_blocks(execution, [&](std::size_t block, std::size_t i) {
      Chart_distance& best = found[block];
      const Box_2& box = boxes_[tree_.order()[i]];
      tree_.visit(
          [&](const Box_2& node, std::size_t first, std::size_t last) {
            return last > i + 1 && !is_same_chart(i, first, last) &&
                   node.squared_distance(box) < best.squared;
          },
          [&](std::size_t first, std::size_t last) {
            for (std::size_t j = std::max(first, i + 1); j < last; ++j)
              if (at(j).chart != at(i).chart && boxes_[tree_.order()[j]].squared_distance(box) < best.squared)
                measure(i, j, best);
          });
    });
    return found.empty() ? guess : *std::min_element(found.begin(), found.end());
  }

  /// The triangles whose border is nearer to that of another chart than the bound, squared; with repetitions.
  std::vector<Index> crowded(double squared, const Execution& execution) const
  {
    std::vector<std::uint8_t> is_crowded(segments_.size(), false);
    in_blocks(execution, [&](std::size_t, std::size_t i) {
      const Box_2& box = boxes_[tree_.order()[i]];
      Chart_distance best{squared};
      tree_.visit(
          [&](const Box_2& node, std::size_t first, std::size_t last) {
            return best.first == no_index && !is_same_chart(i, first, last) &&
                   node.squared_distance(box) < squared;
          },
          [&](std::size_t first, std::size_t last) {
            for (std::size_t j = first; j < last; ++j)
              if (at(j).chart != at(i).chart)
                measure(i, j, best);
          });
      is_crowded[i] = best.first != no_index;
    });
    std::vector<Index> result;
    for (std::size_t i = 0; i < is_crowded.size(); ++i)
      if (is_crowded[i])
        result.push_back(at(i).triangle);
    return result;
  }

private:
  static constexpr std::size_t block_size = 256;

  static std::vector<Box_2> boxes(const std::vector<Border_segment>& segments)
  {
    std::vector<Box_2> result(segments.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i].add(segments[i].a.x(), segments[i].a.y());
      result[i].add(segments[i].b.x(), segments[i].b.y());
    }
    return result;
  }

  std::size_t number_of_blocks() const { return (segments_.size() + block_size - 1) / block_size; }

  template <typename Body>
  void in_blocks(const Execution& execution, Body body) const
  {
    execution.for_each(number_of_blocks(), [&](std::size_t block) {
      for (std::size_t i = block * block_size; i < std::min(segments_.size(), (block + 1) * block_size); ++i)
        body(block, i);
    });
  }

  const Border_segment& at(std::size_t i) const { return segments_[tree_.order()[i]]; }

  /// Whether the places [first, last) are all of the chart of place i.
  bool is_same_chart(std::size_t i, std::size_t first, std::size_t last) const
  {
    return at(first).chart == at(i).chart && same_until_[first] >= last;
  }

  void measure(std::size_t i, std::size_t j, Chart_distance& best) const
  {
    const double d = squared_distance(at(i), at(j));
    if (d < best.squared)
      best = {d, std::min(at(i).triangle, at(j).triangle), std::max(at(i).triangle, at(j).triangle)};
  }

  const std::vector<Border_segment>& segments_;
  std::vector<Box_2> boxes_;
  Box_tree tree_;
  std::vector<Index> same_until_; ///< per place of the tree, up to where the chart stays the same
};

} // namespace Atlas::internal

#endif
