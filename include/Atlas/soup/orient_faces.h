// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_ORIENT_FACES_H
#define ATLAS_SOUP_ORIENT_FACES_H

#include <Atlas/core/Surface.h>
#include <Atlas/soup/Polygon_soup.h>

#include <cstddef>
#include <vector>

namespace Atlas {

/// \brief Turns faces around so that neighbours agree which side is outside.
///
/// Neighbours are faces at an edge of these two alone, by position; they agree if they run through it in
/// opposite directions. In each connected part the orientation that most of its faces have wins. Where a part
/// has no orientation, as a Moebius strip, some neighbours go on to disagree. Charts never run over edges of
/// neighbours that disagree: a model with faces of random orientation has many more charts.
///
/// \return the faces that were turned, ascending. O(n log n) for n corners.
std::vector<Index> orient_faces(Polygon_soup& soup);

/// The number of edges at which two faces, and no others, disagree which side is outside. O(n log n).
std::size_t disagreeing_edges(const Polygon_soup& soup);

/// \brief Turns the corners of each polygon so that it starts where the surface's fan of triangles does.
///
/// Readers see a polygon as the fan from its first corner. A concave or bent polygon has one-to-one
/// coordinates on the fan that `build_surface()` chose for it, and need not have them on another one. Most
/// polygons stay as they are. Linear.
///
/// \param surface  what `build_surface()` made of the soup
/// \throw Invalid_argument the surface has another number of faces or corners
void start_polygons_at_fans(const Surface& surface, Polygon_soup& soup);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/soup/internal/orient_faces_impl.h>
#endif

#endif
