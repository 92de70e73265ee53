// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_BUILD_SURFACE_H
#define ATLAS_CORE_BUILD_SURFACE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <cstddef>
#include <span>
#include <vector>

namespace Atlas {

/// \brief Builds the surface of a polygon soup.
///
/// \param points  positions of the vertices
/// \param first   per polygon, the place in `vertices` where its corners start; one more entry closes it
/// \param vertices  the vertices of all corners, polygon by polygon
///
/// Any soup will do: faces that cannot take part are listed in `rejected`. Triangles are adjacent where just
/// two run along an edge in opposite directions, by vertex number, else (open meshes with split seams) by
/// position. Sides of two-sided models, and copies of faces, are sheets of their own. O(n log n).
///
/// \throws Invalid_argument if `first` decreases or leads past the end of `vertices`
Surface build_surface(std::vector<Point_3> points, const std::vector<std::size_t>& first,
                      const std::vector<Index>& vertices);

/// \brief Builds the surface of a polygon soup as CGAL has it: for each polygon the vertices of its corners.
///
/// Faces and corners are counted polygon by polygon. The same as the other overload in all else.
Surface build_surface(std::vector<Point_3> points, const std::vector<std::vector<std::size_t>>& polygons);

/// \brief Several surfaces as one, so that they share an atlas and its density.
///
/// Vertices, faces and corners are counted on from one surface to the next: the coordinates of the first are
/// the first `number_of_corners` of the result's, and so on. Nothing is glued between surfaces, wherever they
/// lie, so no chart has faces of two. Patches of different surfaces differ. Linear.
Surface join_surfaces(std::span<const Surface> surfaces);

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
#include <Atlas/core/internal/build_surface_impl.h>
#include <Atlas/core/internal/constrain_edges_impl.h>
#include <Atlas/core/internal/join_surfaces_impl.h>
#endif

#endif
