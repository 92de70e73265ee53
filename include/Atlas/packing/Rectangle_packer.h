// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_RECTANGLE_PACKER_H
#define ATLAS_PACKING_RECTANGLE_PACKER_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/library.h>
#include <Atlas/packing/Page_engine.h>

#include <optional>
#include <span>

namespace Atlas {

/// \brief Packs the bounding rectangles of least area of the charts (Sander et al. 2001) on a skyline.
///
/// The longer side of each rectangle is stood upright, rectangles are sorted by it in decreasing order, and
/// each is put where the space lost below it is least. The simplest packer, for comparison. Same guarantees
/// as `Horizon_packer`.
///
/// Models `PageEngine` and, by `Page_packer`, `ChartPacker`.
class Rectangle_packer
{
public:
  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const;

  /// \throws Invalid_argument \see `Page_packer::pack()`
  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const;
};

static_assert(PageEngine<Rectangle_packer> && ChartPacker<Rectangle_packer>);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/packing/internal/horizon/Rectangle_packer_impl.h>
#endif

#endif
