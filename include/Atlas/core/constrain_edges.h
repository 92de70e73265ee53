// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_CONSTRAIN_EDGES_H
#define ATLAS_CORE_CONSTRAIN_EDGES_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/library.h>

#include <span>

namespace Atlas {

/// \brief Makes seams of all edges at which the normals of the two triangles turn by more than an angle.
///
/// \param degrees  in (0, 180]; a cube's edges have 90
///
/// Diagonals of polygons, edges that must not be seams, and edges of triangles without area are left alone.
/// Linear.
void constrain_hard_edges(Surface& surface, double degrees);

/// \brief Makes patches of the charts that coordinates have, and seams of the cuts inside of them.
///
/// \param uv  per corner of the input: its coordinates; not finite where there are none
///
/// Where a chart folds over, the two sides become patches of their own: each of them is one-to-one unless it
/// overlaps itself. With `Patch_segmentation` and `Existing_uv_parameterizer` this keeps what others have
/// flattened. Linear.
void constrain_to_uv(Surface& surface, std::span<const Point_2> uv);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/constrain_edges_impl.h>
#endif

#endif
