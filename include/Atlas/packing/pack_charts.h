// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_PACK_CHARTS_H
#define ATLAS_PACKING_PACK_CHARTS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/packing/Raster_packer.h>

#include <optional>
#include <span>
#include <vector>

namespace Atlas {

/// \brief Coordinates that have been packed anew.
struct Repacked_charts
{
  std::vector<Point_2> uv;   ///< per input corner: in [0, 1]^2 of its page; as it was where it was not finite
  std::vector<Index> page;   ///< per input corner
  std::vector<Chart> charts; ///< in the coordinates that came in
  Segmentation segmentation; ///< which triangle is in which chart; those without coordinates in none
  Packing packing;           ///< where the charts go
};

/// \brief Packs texture coordinates that came from elsewhere; the shapes of charts stay as they are.
///
/// \param uv  per corner of the input: its coordinates; not finite where there are none
///
/// Charts keep their relative sizes, but for `page.weights`, or else the weights of the surface; overlapping
/// or folded charts are packed as they are. Charts are numbered in the order of their first triangles. Where
/// there is no room at all, the packing has no page and coordinates are left alone.
///
/// \throws Invalid_argument if there is not one coordinate for each corner, or `options` is no page. \see
/// `check()`
/// \throws Policy_error if the packer returns what is no packing
Repacked_charts pack_charts(const Surface& surface, std::span<const Point_2> uv,
                            const Page_options& options = {}, const Any_packer& packer = Raster_packer(),
                            const Execution& execution = Execution());

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
/// Nothing if that is none of the tiles 1001 to 9999, or the chart goes beyond it.
///
/// \param side  of pages in texels; they are squares
std::optional<Placement> place_on_tile(const Placement& place, const Chart& chart, double side);

/// \brief How far apart the charts of a packing are.
struct Packing_clearance
{
  double charts = 0; ///< least distance of two charts of a page in texels, 0 if they meet; at most `limit`
  double border = 0; ///< least distance of a chart from the border of its page, in texels; negative outside
};

/// \brief Measures the distance between charts on the coordinates as they are stored: placed, divided by the
/// size of the page, and rounded to single precision.
///
/// Distances are those between the segments that bound the charts; that two charts meet is decided by exact
/// predicates. A chart inside the hole of another is apart from it, one inside its interior is not.
/// Near-linear in the segments.
///
/// \param limit larger distances between charts are not looked for, in texels
Packing_clearance packing_clearance(std::span<const Chart> charts, const Packing& packing,
                                    const Page_options& page, double limit);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/packing/internal/pages/pack_charts_impl.h>
#include <Atlas/packing/internal/pages/packing_clearance_impl.h>
#include <Atlas/packing/internal/pages/place_of_chart_impl.h>
#endif

#endif
