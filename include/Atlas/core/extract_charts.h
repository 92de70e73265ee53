// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_EXTRACT_CHARTS_H
#define ATLAS_CORE_EXTRACT_CHARTS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <span>
#include <vector>

namespace Atlas {

/// \brief Copies triangles of one chart out of the surface.
///
/// Corners are one vertex of the chart when they are connected around a vertex of the surface by triangles
/// glued along edges; so cuts open, and vertices where sheets only touch come apart. Linear in `triangles`.
///
/// \param triangles  all triangles of one chart of `segmentation`
/// \param local      scratch: per triangle of the surface; need not be initialised, only be large enough
Chart extract_chart(const Surface& surface, const Segmentation& segmentation,
                    std::span<const Index> triangles, std::vector<Index>& local);

/// Per chart, its triangles in increasing order.
std::vector<std::vector<Index>> triangles_of_charts(const Segmentation& segmentation);

/// Copies all charts out of the surface, in the order of their numbers.
std::vector<Chart> extract_charts(const Surface& surface, const Segmentation& segmentation);

/// What decides whether a chart is a disc.
struct Chart_topology
{
  Index components = 0;   ///< connected over edges
  Index border_loops = 0; ///< how many loops its border has
  long long euler = 0;    ///< vertices - edges + triangles

  /// Whether it is homeomorphic to a disc.
  bool is_disc() const { return components == 1 && border_loops == 1 && euler == 1; }
};

/// Counts components, border loops and the Euler characteristic. O(n log n).
Chart_topology topology(const Chart& chart);

/// The charts that coordinates at corners make of a surface: triangles are glued along edges at both ends of
/// which their coordinates are equal. Triangles without finite coordinates get the chart `no_index`. Linear.
Segmentation charts_of_uv(const Surface& surface, std::span<const Point_2> uv);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/core/internal/charts_of_uv_impl.h>
#include <Atlas/core/internal/extract_charts_impl.h>
#endif

#endif
