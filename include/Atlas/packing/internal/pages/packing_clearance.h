// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PACKING_CLEARANCE_H
#define ATLAS_PACKING_INTERNAL_PAGES_PACKING_CLEARANCE_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/internal/library.h>

#include <span>

namespace Atlas {

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
#include <Atlas/packing/internal/pages/packing_clearance_impl.h>
#endif

#endif
