// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_HORIZON_PACKER_H
#define ATLAS_PACKING_HORIZON_PACKER_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/packing/Page_packer.h>

#include <optional>
#include <span>

namespace Atlas {

/// \brief The packer of Lévy, Petitjean, Ray and Maillot (2002), section 4: charts fall on a horizon.
///
/// The largest diameter of each chart is stood upright, charts are sorted by it in decreasing order, and each
/// is put where the space lost between its bottom horizon and the horizon of the page is least. Horizons are
/// arrays with one entry a texel of width. The largest density that fits the page is searched to 0.1 %.
///
/// Guarantees no two charts nearer than the gutter and none nearer than half of it to the border of the page,
/// after rounding to single precision too: horizons are those of the charts grown by half the gutter, and
/// bound them over the whole width of a texel. Where a page has no room for that many charts and gutters,
/// the gutter shrinks.
///
/// About 10 layouts, each O(segments + charts x width of the page) and seldom more.
///
/// Models `PageEngine` and, by `Page_packer`, `ChartPacker`.
class Horizon_packer
{
public:
  /// Places the pieces of one page.
  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const;

  /// \throws Invalid_argument \see `Page_packer::pack()`
  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const;
};

static_assert(PageEngine<Horizon_packer> && ChartPacker<Horizon_packer>);

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
  /// Places the pieces of one page.
  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const;

  /// \throws Invalid_argument \see `Page_packer::pack()`
  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const;
};

static_assert(PageEngine<Rectangle_packer> && ChartPacker<Rectangle_packer>);

/// \brief Packs the bounding rectangles of least area of the charts in rows: the enclosing rectangle packing
/// of Sander et al. 2001 that the LSCM paper compares with.
///
/// The longer side of each rectangle is stood upright; rectangles are put side by side by decreasing height,
/// and a new row begins on top of the highest of the last where the page ends. The baseline of baselines.
/// Same guarantees as `Horizon_packer`.
///
/// Models `PageEngine` and, by `Page_packer`, `ChartPacker`.
class Row_packer
{
public:
  /// Places the pieces of one page.
  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const;

  /// \throws Invalid_argument \see `Page_packer::pack()`
  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const;
};

static_assert(PageEngine<Row_packer> && ChartPacker<Row_packer>);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/packing/internal/horizon/Horizon_packer_impl.h>
#include <Atlas/packing/internal/horizon/Rectangle_packer_impl.h>
#endif

#endif
