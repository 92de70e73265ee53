// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PAGE_ENGINE_IMPL_H
#define ATLAS_PACKING_INTERNAL_PAGES_PAGE_ENGINE_IMPL_H

#include <Atlas/core/library.h>
#include <Atlas/packing/Page_engine.h>
#include <Atlas/packing/internal/pages/scale_search.h>

#include <algorithm>

namespace Atlas {

ATLAS_INLINE double Page_task::largest_scale() const
{
  return std::min(most_scale, internal::scale_bound(pieces, width, height));
}

} // namespace Atlas

#endif
