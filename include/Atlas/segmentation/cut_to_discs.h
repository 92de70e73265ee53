// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_CUT_TO_DISCS_H
#define ATLAS_SEGMENTATION_CUT_TO_DISCS_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <span>
#include <vector>

namespace Atlas {

/// \brief Makes every chart a disc that can be flattened.
///
/// Afterwards every chart is connected over glued edges and has one border loop and Euler characteristic 1,
/// as `topology(extract_chart(...))` measures it; the triangles of an input face are in one chart, and no cut
/// runs on a diagonal; no chart crosses a patch border (`Surface::patch`), and edges that must be seams are
/// cut. Cuts that the segmentation brings along stay. Edges that must not be seams are cut only where there
/// is no other way.
///
/// Charts in several parts become several charts. Closed charts are opened: a sphere along the shortest path
/// between the ends of a diameter, handles along shortest loops that do not separate; several border loops
/// are joined by shortest cuts. Cuts are shortest in a measure that makes sharp edges up to four times
/// cheaper. Charts are numbered by their first triangles.
///
/// O(n log n log k) for n triangles and k cuts; parallel over charts.
///
/// \param segmentation  with a chart for each triangle and a cut or none for each halfedge of the surface
/// \throws Invalid_argument if the segmentation has other sizes than the surface
void cut_to_discs(const Surface& surface, Segmentation& segmentation,
                  const Execution& execution = Execution());

/// \brief The same for some charts only; all others keep their triangles, cuts and numbers.
///
/// The first part of each of these charts keeps its number; the other parts get new numbers, from
/// `number_of_charts` on in the order of their first triangles. (Should one of these charts lose all its
/// triangles because it had only parts of faces, its number goes to the next part without one, else to the
/// chart with the largest number.)
///
/// \param charts  numbers in [0, number_of_charts), in any order
/// \returns the numbers of all charts that came from the given ones, increasing
/// \throws Invalid_argument if the segmentation has other sizes than the surface, or there is no such chart
std::vector<Index> cut_to_discs(const Surface& surface, Segmentation& segmentation,
                                std::span<const Index> charts, const Execution& execution = Execution());

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/discs/cut_to_discs_impl.h>
#endif

#endif
