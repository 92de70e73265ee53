// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_PATCH_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_PATCH_SEGMENTATION_IMPL_H

#include <Atlas/segmentation/Patch_segmentation.h>

#include <algorithm>
#include <vector>

namespace Atlas {

ATLAS_INLINE Segmentation Patch_segmentation::segment(const Surface& surface, const Execution&) const
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
    result.chart[t] =
        static_cast<Index>(std::lower_bound(distinct.begin(), distinct.end(), numbers[t]) - distinct.begin());
  result.number_of_charts = static_cast<Index>(distinct.size());
  return result;
}

ATLAS_INLINE Index Patch_segmentation::patch(const Surface& surface, Index t) const
{
  if (!patch_of_face_.empty())
    return surface.face[t] < patch_of_face_.size() ? patch_of_face_[surface.face[t]] : no_index;
  return surface.patch.empty() ? 0 : surface.patch[t];
}

} // namespace Atlas

#endif
