// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_RASTER_PACKER_H
#define ATLAS_PACKING_RASTER_PACKER_H

#include <Atlas/core/concepts.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/packing/Page_packer.h>

#include <cstddef>
#include <optional>
#include <span>

namespace Atlas {

/// How hard a packer tries. The times are for 50 charts on two cores.
enum class Packing_effort {
  fast,   ///< a short search, that ends as soon as it gains little
  normal, ///< about 1 s
  best    ///< about 10 s
};

/// With more charts than this `Packing_effort::fast` keeps the horizon layout.
inline constexpr std::size_t max_charts_of_fast_search = 5000;

/// \brief The default packer: built on a raster with many rotations, then refined continuously.
///
/// 1. Charts are placed one by one on a bitmap where they touch most of what is there, in any of several
///    rotations, also in holes and concavities; several orders are tried, in parallel.
/// 2. All charts grow together, and push and turn each other apart by their distance fields.
/// 3. With more effort, charts are taken out again and put elsewhere, at a slightly larger scale.
///
/// Every layout that is kept passes an exact test: no two charts nearer than the gutter, none nearer than
/// half of it to the border, with what rounding to single precision may cost. The result is never below that
/// of `Horizon_packer`, which is also what is left when a page is too small for its charts.
///
/// Deterministic: the effort is counted in operations, not in seconds, and does not depend on the number of
/// threads.
///
/// Locked charts take part in all steps as obstacles that do not move.
///
/// Models `ObstaclePageEngine` and, by `Page_packer`, `ChartPacker`.
class Raster_packer
{
public:
  static constexpr bool heeds_obstacles = true; ///< pieces keep off locked charts

  /// A packer of that effort.
  explicit Raster_packer(Packing_effort effort = Packing_effort::fast) : effort_(effort) {}

  /// Places the pieces of one page.
  std::optional<Page_layout> lay_out(const Page_task& task, const Execution& execution) const;

  /// \throws Invalid_argument \see `Page_packer::pack()`
  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const;

private:
  Packing_effort effort_;
};

static_assert(ObstaclePageEngine<Raster_packer> && ChartPacker<Raster_packer>);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/packing/internal/raster/Raster_packer_impl.h>
#endif

#endif
