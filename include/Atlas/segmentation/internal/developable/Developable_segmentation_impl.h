// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_DEVELOPABLE_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_DEVELOPABLE_SEGMENTATION_IMPL_H

#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/internal/developable/find_nets.h>
#include <Atlas/segmentation/internal/surface/part_of_surface.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

ATLAS_INLINE Developable_segmentation::Developable_segmentation(Any_segmentation rest, Any_packer packer,
                                                                std::size_t max_charts)
    : rest_(std::move(rest)), packer_(std::move(packer)), max_charts_(max_charts)
{}

ATLAS_INLINE Segmentation Developable_segmentation::segment(const Surface& surface,
                                                            const Execution& execution) const
{
  internal::Nets nets = internal::Net_finder(surface, packer_, execution)();
  if (nets.count == 0 || (max_charts_ > 0 && nets.count > max_charts_))
    return rest_.segment(surface, execution);
  Segmentation result{std::move(nets.of_triangle), std::move(nets.cut), nets.count};
  std::vector<Index> global;
  const Surface part = internal::part_of_surface(
      surface, [&](Index t) { return result.chart[t] == no_index; }, global);
  if (!global.empty()) {
    const Segmentation others = rest_.segment(part, execution);
    for (Index t = 0; t < global.size(); ++t) {
      result.chart[global[t]] = result.number_of_charts + others.chart[t];
      for (Index i = 0; i < 3; ++i)
        result.cut[3 * global[t] + i] = part.opposite[3 * t + i] != no_index && others.cut[3 * t + i];
    }
    result.number_of_charts += others.number_of_charts;
  }
  const bool are_too_many = max_charts_ > 0 && result.number_of_charts > max_charts_;
  return are_too_many ? rest_.segment(surface, execution) : result;
}

} // namespace Atlas

#endif
