// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_OVERLAPS_H
#define ATLAS_VALIDATION_OVERLAPS_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Kernel.h>
#include <Atlas/core/internal/library.h>

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace Atlas {

/// A triangle in the plane by its corners, of either orientation.
using Triangle_uv = std::array<Point_2, 3>;

/// How many overlapping pairs are looked for at most, unless said otherwise.
inline constexpr std::size_t default_max_overlaps = 1'000'000;

/// The pairs of triangles whose interiors intersect.
struct Overlaps
{
  std::vector<std::pair<Index, Index>> pairs; ///< smaller index first; sorted, each pair once
  bool is_complete = true; ///< `false` if the search was stopped: there may be more pairs than listed
};

/// The triangles that occur in pairs, each once, sorted.
std::vector<Index> triangles_of(const Overlaps& overlaps);

/// \brief Whether the interiors of two counterclockwise triangles intersect. Exact.
///
/// Two convex sets with interiors have disjoint interiors if and only if a line separates them, and for
/// triangles the line of one of the six edges does.
bool do_interiors_intersect(const Triangle_uv& s, const Triangle_uv& t);

/// \brief Finds the pairs of triangles whose interiors intersect. Contact is no overlap. Exact.
///
/// Flat triangles have no interior and overlap nothing. The search stops, and says so, at `max_pairs` pairs
/// and when it has looked at several thousand boxes per triangle; so it takes O(n log n) whatever the
/// input. The result does not depend on the number of threads.
///
/// \pre coordinates are finite
Overlaps find_overlaps(std::span<const Triangle_uv> triangles, const Execution& execution = Execution(),
                       std::size_t max_pairs = default_max_overlaps);

/// \brief Whether no two of the triangles overlap. Exact, O(n log n) with no exception.
///
/// Decided from the edges that are not shared by two triangles of the same orientation, see
/// `internal::Coverage_sweep`: the fewer there are, the faster.
///
/// \param opposite  halfedge 3i+j runs from corner j of triangle i to the next; `opposite[h]`, a symmetric
/// relation, is a halfedge with the same end points in reverse, or `no_index`. An edge whose sides differ
/// in the plane may be listed too, it counts as border.
/// \pre coordinates are finite
bool is_overlap_free(std::span<const Triangle_uv> triangles, std::span<const Index> opposite);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/validation/internal/overlaps_impl.h>
#endif

#endif
