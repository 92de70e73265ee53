// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DISCS_CUT_TO_DISCS_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_DISCS_CUT_TO_DISCS_IMPL_H

#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/arguments.h>
#include <Atlas/segmentation/internal/discs/Chart_opener.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace Atlas {

ATLAS_INLINE void cut_to_discs(const Surface& surface, Segmentation& segmentation, const Execution& execution)
{
  internal::require_segmentation_of(surface, segmentation);
  std::vector<Index> triangles(surface.number_of_triangles());
  std::iota(triangles.begin(), triangles.end(), Index(0));
  const auto discs = internal::Chart_opener(surface, segmentation, execution).run(std::move(triangles));
  for (Index c = 0; c < discs.size(); ++c)
    for (const Index t : discs[c])
      segmentation.chart[t] = c;
  segmentation.number_of_charts = static_cast<Index>(discs.size());
}

namespace internal {

/// Gives discs the numbers of the charts they come from, each to the first one, and new numbers to the
/// others. Returns the numbers, in the order of the discs.
/// \param is_free  per chart: whether it is one of those whose triangles the discs have
inline std::vector<Index> number_discs(const std::vector<std::vector<Index>>& discs,
                                       std::vector<std::uint8_t> is_free, Segmentation& segmentation)
{
  std::vector<Index> numbers;
  for (const auto& disc : discs) {
    const Index c = segmentation.chart[disc.front()];
    numbers.push_back(is_free[c] ? c : no_index);
    is_free[c] = 0;
  }
  std::vector<Index> left;
  for (Index c = 0; c < is_free.size(); ++c)
    if (is_free[c])
      left.push_back(c);
  auto next = left.begin();
  for (Index& number : numbers)
    if (number == no_index)
      number = next != left.end() ? *next++ : segmentation.number_of_charts++;
  for (std::size_t i = 0; i < discs.size(); ++i)
    for (const Index t : discs[i])
      segmentation.chart[t] = numbers[i];
  // Numbers of charts without a triangle go to the last ones.
  for (auto c = left.end(); c != next;) {
    const Index last = --segmentation.number_of_charts;
    if (*--c == last)
      continue;
    std::replace(segmentation.chart.begin(), segmentation.chart.end(), last, *c);
    std::replace(numbers.begin(), numbers.end(), last, *c);
  }
  return numbers;
}

} // namespace internal

ATLAS_INLINE std::vector<Index> cut_to_discs(const Surface& surface, Segmentation& segmentation,
                                             std::span<const Index> charts, const Execution& execution)
{
  internal::require_numbered_segmentation_of(surface, segmentation);
  std::vector<std::uint8_t> is_free(segmentation.number_of_charts, 0);
  for (const Index c : charts) {
    if (c >= is_free.size())
      throw Invalid_argument("charts", "has the number " + std::to_string(c) + ", but there are " +
                                           std::to_string(is_free.size()) + " charts");
    is_free[c] = 1;
  }
  std::vector<Index> triangles;
  for (Index t = 0; t < segmentation.chart.size(); ++t)
    if (is_free[segmentation.chart[t]])
      triangles.push_back(t);
  const auto discs = internal::Chart_opener(surface, segmentation, execution).run(std::move(triangles));
  std::vector<Index> numbers = internal::number_discs(discs, std::move(is_free), segmentation);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

} // namespace Atlas

#endif
