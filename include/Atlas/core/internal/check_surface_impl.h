// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_CHECK_SURFACE_IMPL_H
#define ATLAS_CORE_INTERNAL_CHECK_SURFACE_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/check_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace Atlas::internal {

inline void check_opposites(const Surface& surface)
{
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    const Index o = surface.opposite[h];
    if (o == no_index)
      continue;
    require(o < surface.opposite.size() && o != h && surface.opposite[o] == h, "surface.opposite",
            "must lead back from every opposite halfedge");
  }
}

inline void check_wishes_of_edges(const Surface& surface)
{
  const std::size_t halfedges = surface.opposite.size();
  require(surface.constraint.empty() || surface.constraint.size() == halfedges, "surface.constraint",
          "must be empty or have an entry for each halfedge");
  require(surface.seam_cost.empty() || surface.seam_cost.size() == halfedges, "surface.seam_cost",
          "must be empty or have an entry for each halfedge");
  require(std::all_of(surface.seam_cost.begin(), surface.seam_cost.end(),
                      [](double cost) { return std::isfinite(cost) && cost > 0; }),
          "surface.seam_cost", "must be finite and positive everywhere");
}

inline void check_wishes_of_faces(const Surface& surface)
{
  const std::size_t triangles = surface.number_of_triangles();
  require(surface.patch.empty() || surface.patch.size() == triangles, "surface.patch",
          "must be empty or have an entry for each triangle");
  require(surface.density_weight.empty() || surface.density_weight.size() == triangles,
          "surface.density_weight", "must be empty or have an entry for each triangle");
  require(std::all_of(surface.density_weight.begin(), surface.density_weight.end(),
                      [](double weight) { return std::isfinite(weight) && weight > 0; }),
          "surface.density_weight", "must be finite and positive everywhere");
}

ATLAS_INLINE void check_surface(const Surface& surface)
{
  const std::size_t triangles = surface.number_of_triangles();
  require(surface.opposite.size() == 3 * triangles, "surface.opposite",
          "must have three entries for each triangle");
  require(surface.face.size() == triangles, "surface.face", "must have an entry for each triangle");
  require(surface.corner.size() == 3 * triangles, "surface.corner",
          "must have three entries for each triangle");
  for (const auto& triangle : surface.triangles)
    for (const Index v : triangle)
      require(v < surface.points.size(), "surface.triangles", "must name points that exist");
  for (const Index face : surface.face)
    require(face < surface.number_of_faces, "surface.face", "must be less than the number of faces");
  for (const Index corner : surface.corner)
    require(corner < surface.number_of_corners, "surface.corner", "must be less than the number of corners");
  check_opposites(surface);
  check_wishes_of_edges(surface);
  check_wishes_of_faces(surface);
}

} // namespace Atlas::internal

#endif
