// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_CHECK_SURFACE_H
#define ATLAS_CORE_INTERNAL_CHECK_SURFACE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

namespace Atlas::internal {

/// Whether the arrays of a surface fit together: their sizes, and every number in them. Linear.
/// \throws Invalid_argument that names the array
void check_surface(const Surface& surface);

} // namespace Atlas::internal

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/check_surface_impl.h>
#endif

#endif
