// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_PATCH_SEGMENTATION_H
#define ATLAS_SEGMENTATION_PATCH_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Takes charts as the user gives them.
///
/// Patch numbers are per input face, or those of `Surface::patch`; equal numbers make one chart. Without
/// either the whole surface is one chart. Cutting to discs, later, separates what is not connected and adds
/// the cuts that topology and constraints ask for. A model of `ChartSegmentation`. O(n log n).
class Patch_segmentation
{
public:
  /// Charts are the surface's patches.
  Patch_segmentation() = default;

  /// \param patch_of_face  per input face, any numbers; faces beyond the end of the list are in one more
  /// patch
  explicit Patch_segmentation(std::vector<Index> patch_of_face) : patch_of_face_(std::move(patch_of_face)) {}

  Segmentation segment(const Surface& surface, const Execution& = Execution()) const
  {
    Segmentation result;
    result.chart.resize(surface.number_of_triangles());
    result.cut.assign(3 * surface.number_of_triangles(), 0);
    std::vector<Index> numbers(result.chart.size());
    for (Index t = 0; t < numbers.size(); ++t)
      numbers[t] = patch(surface, t);
    std::vector<Index> distinct = numbers;
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    for (Index t = 0; t < numbers.size(); ++t)
      result.chart[t] = static_cast<Index>(std::lower_bound(distinct.begin(), distinct.end(), numbers[t]) -
                                           distinct.begin());
    result.number_of_charts = static_cast<Index>(distinct.size());
    return result;
  }

private:
  Index patch(const Surface& surface, Index t) const
  {
    if (!patch_of_face_.empty())
      return surface.face[t] < patch_of_face_.size() ? patch_of_face_[surface.face[t]] : no_index;
    return surface.patch.empty() ? 0 : surface.patch[t];
  }

  std::vector<Index> patch_of_face_;
};

} // namespace Atlas

#endif
