// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_DEVELOPABLE_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_DEVELOPABLE_SEGMENTATION_IMPL_H

#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/internal/developable/find_nets.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// The triangles of a surface for which `is_in`, as a surface of their own; their numbers in `global`.
template <typename IsIn>
Surface part_of_surface(const Surface& surface, IsIn is_in, std::vector<Index>& global)
{
  Surface part;
  std::vector<Index> local(surface.number_of_triangles(), no_index);
  for (Index t = 0; t < local.size(); ++t)
    if (is_in(t)) {
      local[t] = static_cast<Index>(global.size());
      global.push_back(t);
    }
  part.points = surface.points;
  part.number_of_faces = surface.number_of_faces;
  part.number_of_corners = surface.number_of_corners;
  const auto copy = [](const auto& from, auto& to, std::size_t i) {
    if (!from.empty())
      to.push_back(from[i]);
  };
  for (const Index t : global) {
    part.triangles.push_back(surface.triangles[t]);
    copy(surface.face, part.face, t);
    copy(surface.patch, part.patch, t);
    copy(surface.density_weight, part.density_weight, t);
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      const Index o = surface.opposite[h];
      part.opposite.push_back(o == no_index || local[o / 3] == no_index ? no_index
                                                                        : 3 * local[o / 3] + o % 3);
      copy(surface.corner, part.corner, h);
      copy(surface.constraint, part.constraint, h);
      copy(surface.seam_cost, part.seam_cost, h);
    }
  }
  return part;
}

} // namespace internal

ATLAS_INLINE Developable_segmentation::Developable_segmentation(Any_segmentation rest, Any_packer packer,
                                                                std::size_t max_charts)
    : rest_(std::move(rest)), packer_(std::move(packer)), max_charts_(max_charts)
{}

ATLAS_INLINE Segmentation Developable_segmentation::segment(const Surface& surface,
                                                            const Execution& execution) const
{
  internal::Nets nets = internal::Net_finder(surface, packer_, execution)();
  if (nets.count == 0)
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
