// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_PLACE_OF_CHART_H
#define ATLAS_PACKING_PLACE_OF_CHART_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>

#include <optional>
#include <span>

namespace Atlas {

/// \brief Where other coordinates of a surface have a chart: the similarity that takes `chart.uv` to them.
///
/// For the entries of `Page_options::places_in_group` and, by `place_on_tile()`, of `Page_options::locked`:
/// charts that stay together or in place as in the coordinates of a file, whatever has been done to their
/// size and place since. Least squares over all corners. O(triangles).
///
/// \param uv  per corner of the input
///
/// Nothing if the chart has no extent, or another shape there: if a corner is off by more than 1e-6 of the
/// extent, or coordinates are missing (an empty `uv`) or not finite.
std::optional<Placement> place_of_chart(const Surface& surface, const Chart& chart,
                                        std::span<const Point_2> uv);

/// \brief A place in texture coordinates, where a page is a UDIM tile of side 1, as a placement in texels of
/// that page: the tile that has the middle of the chart's bounding box.
///
/// Nothing if that is none of the tiles 1001 to 9999.
///
/// \param side  of pages in texels; they are squares
std::optional<Placement> place_on_tile(const Placement& place, const Chart& chart, double side);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/packing/internal/pages/place_of_chart_impl.h>
#endif

#endif
