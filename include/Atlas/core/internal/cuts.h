// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_CUTS_H
#define ATLAS_CORE_INTERNAL_CUTS_H

#include <Atlas/core/Surface.h>

namespace Atlas::internal {

/// Makes the edge of the halfedge a cut, or none, on both sides. It must have two sides.
inline void set_cut(const Surface& surface, Segmentation& segmentation, Index h, bool is_cut)
{
  segmentation.cut[h] = segmentation.cut[surface.opposite[h]] = is_cut;
}

} // namespace Atlas::internal

#endif
