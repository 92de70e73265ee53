// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SURFACE_PART_OF_SURFACE_H
#define ATLAS_SEGMENTATION_INTERNAL_SURFACE_PART_OF_SURFACE_H

#include <Atlas/core/Surface.h>

#include <cstddef>
#include <vector>

namespace Atlas::internal {

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

} // namespace Atlas::internal

#endif
