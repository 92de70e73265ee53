// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_JOIN_SURFACES_H
#define ATLAS_CORE_JOIN_SURFACES_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/library.h>

#include <span>

namespace Atlas {

/// \brief Several surfaces as one, so that they share an atlas and its density.
///
/// Vertices, faces and corners are counted on from one surface to the next: the coordinates of the first are
/// the first `number_of_corners` of the result's, and so on. Nothing is glued between surfaces, wherever they
/// lie, so no chart has faces of two. Patches of different surfaces differ. Linear.
Surface join_surfaces(std::span<const Surface> surfaces);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/join_surfaces_impl.h>
#endif

#endif
