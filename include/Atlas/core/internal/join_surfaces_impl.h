// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_JOIN_SURFACES_IMPL_H
#define ATLAS_CORE_INTERNAL_JOIN_SURFACES_IMPL_H

#include <Atlas/core/build_surface.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Atlas {

ATLAS_INLINE Surface join_surfaces(std::span<const Surface> surfaces)
{
  Surface all;
  bool has_constraint = false, has_seam_cost = false, has_patch = false, has_weight = false;
  for (const Surface& surface : surfaces) {
    has_constraint = has_constraint || !surface.constraint.empty();
    has_seam_cost = has_seam_cost || !surface.seam_cost.empty();
    has_patch = has_patch || !surface.patch.empty();
    has_weight = has_weight || !surface.density_weight.empty();
  }
  Index next_patch = 0;
  for (const Surface& surface : surfaces) {
    const Index vertices = static_cast<Index>(all.points.size()),
                halfedges = static_cast<Index>(all.opposite.size()),
                faces = static_cast<Index>(all.number_of_faces),
                corners = static_cast<Index>(all.number_of_corners), patches = next_patch;
    const auto append = [](auto& list, const auto& more, auto change) {
      for (const auto& x : more)
        list.push_back(change(x));
    };
    // Lists that a surface does not have stand for their usual value.
    const auto append_or = [](auto& list, bool is_wanted, const auto& more, std::size_t size, auto usual) {
      if (is_wanted && more.empty())
        list.insert(list.end(), size, usual);
      list.insert(list.end(), more.begin(), more.end());
    };
    const std::size_t triangles = surface.number_of_triangles();
    all.points.insert(all.points.end(), surface.points.begin(), surface.points.end());
    append(all.triangles, surface.triangles, [&](auto t) {
      return std::array<Index, 3>{t[0] + vertices, t[1] + vertices, t[2] + vertices};
    });
    append(all.opposite, surface.opposite, [&](Index h) { return h == no_index ? h : h + halfedges; });
    append(all.face, surface.face, [&](Index f) { return f + faces; });
    append(all.corner, surface.corner, [&](Index c) { return c + corners; });
    append(all.rejected, surface.rejected, [&](auto r) {
      return Surface::Rejected_face{r.face + faces, r.reason};
    });
    append_or(all.constraint, has_constraint, surface.constraint, 3 * triangles, Edge_constraint::none);
    append_or(all.seam_cost, has_seam_cost, surface.seam_cost, 3 * triangles, 1.0);
    append_or(all.density_weight, has_weight, surface.density_weight, triangles, 1.0);
    if (has_patch)
      for (std::size_t t = 0; t < triangles; ++t) {
        all.patch.push_back(patches + (surface.patch.empty() ? 0 : surface.patch[t]));
        next_patch = std::max(next_patch, all.patch.back() + 1);
      }
    all.number_of_faces += surface.number_of_faces;
    all.number_of_corners += surface.number_of_corners;
  }
  return all;
}

} // namespace Atlas

#endif
