// SPDX-License-Identifier: MIT
#ifndef ATLAS_INTERNAL_BARRIERS_H
#define ATLAS_INTERNAL_BARRIERS_H

#include <Atlas/Surface.h>

namespace Atlas::internal {

/// Whether the halfedge lies on an edge that charts must not cross.
inline bool is_barrier(const Surface& surface, Index h)
{
  const Index o = surface.opposite[h];
  if (o == no_index)
    return true;
  if (!surface.patch.empty() && surface.patch[h / 3] != surface.patch[o / 3])
    return true;
  return !surface.constraint.empty() && surface.constraint[h] == Edge_constraint::seam &&
         !surface.is_diagonal(h);
}

} // namespace Atlas::internal

#endif
