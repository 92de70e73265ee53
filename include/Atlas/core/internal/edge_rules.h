// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_EDGE_RULES_H
#define ATLAS_CORE_INTERNAL_EDGE_RULES_H

#include <Atlas/core/Surface.h>

namespace Atlas::internal {

/// Whether the halfedge lies on an edge that charts must not cross: a border, a border of patches, a seam
/// that the user wants.
inline bool must_be_seam(const Surface& surface, Index h)
{
  const Index o = surface.opposite[h];
  if (o == no_index)
    return true;
  if (!surface.patch.empty() && surface.patch[h / 3] != surface.patch[o / 3])
    return true;
  return !surface.constraint.empty() && surface.constraint[h] == Edge_constraint::seam &&
         !surface.is_diagonal(h);
}

/// Whether the triangles on both sides of the halfedge have to be in one chart: those of one polygon, and
/// where the user wants no seam. What must be a seam goes before.
inline bool must_not_be_seam(const Surface& surface, Index h)
{
  return !must_be_seam(surface, h) &&
         (surface.is_diagonal(h) ||
          (!surface.constraint.empty() && surface.constraint[h] == Edge_constraint::no_seam));
}

/// Whether a chart may go on across the halfedge, into another triangle.
inline bool may_cross(const Surface& surface, Index h)
{
  return !must_be_seam(surface, h) && surface.opposite[h] / 3 != h / 3;
}

} // namespace Atlas::internal

#endif
