// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_RECTANGLE_PACKER_H
#define ATLAS_PACKING_RECTANGLE_PACKER_H

#include <Atlas/core/concepts.h>
#include <Atlas/packing/internal/horizon/horizon_layout.h>
#include <Atlas/packing/internal/pages/pack_pages.h>

#include <span>

namespace Atlas {

/// \brief Packs the bounding rectangles of least area of the charts (Sander et al. 2001) on a skyline.
///
/// The longer side of each rectangle is stood upright, rectangles are sorted by it in decreasing order, and
/// each is put where the space lost below it is least. The simplest packer, for comparison. Same guarantees
/// as `Horizon_packer`.
///
/// Models `ChartPacker`.
class Rectangle_packer
{
public:
  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const
  {
    const auto layout = [](const internal::Outlines& outlines, const Page_options& one, double most_scale,
                           const Execution& e) {
      return internal::horizon_layout(outlines, one, internal::Horizon_source::rectangle, most_scale, e);
    };
    return internal::pack_pages(charts, page, layout, execution);
  }
};

static_assert(ChartPacker<Rectangle_packer>);

} // namespace Atlas

#endif
