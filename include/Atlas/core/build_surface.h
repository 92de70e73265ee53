// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_BUILD_SURFACE_H
#define ATLAS_CORE_BUILD_SURFACE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/library.h>

#include <cstddef>
#include <vector>

namespace Atlas {

/// \brief Builds the surface of a polygon soup.
///
/// \param points  positions of the vertices
/// \param first   per polygon, the place in `vertices` where its corners start; one more entry closes it
/// \param vertices  the vertices of all corners, polygon by polygon
///
/// Any soup will do: faces that cannot take part are listed in `rejected`. Triangles are adjacent where
/// exactly two of them run along an edge in opposite directions, by vertex number, else (open meshes whose
/// seams were split) by equal position. O(n log n).
Surface build_surface(std::vector<Point_3> points, const std::vector<std::size_t>& first,
                      const std::vector<Index>& vertices);

/// \brief Builds the surface of a polygon soup as CGAL has it: for each polygon the vertices of its corners.
///
/// Faces and corners are counted polygon by polygon. The same as the other overload in all else.
Surface build_surface(std::vector<Point_3> points, const std::vector<std::vector<std::size_t>>& polygons);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/build_surface_impl.h>
#endif

#endif
