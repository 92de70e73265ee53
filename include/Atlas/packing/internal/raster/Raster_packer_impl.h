// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_RASTER_RASTER_PACKER_IMPL_H
#define ATLAS_PACKING_INTERNAL_RASTER_RASTER_PACKER_IMPL_H

#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/Raster_packer.h>
#include <Atlas/packing/internal/raster/raster_layout.h>

namespace Atlas {

namespace internal {

inline Search_budget search_budget(Packing_effort effort)
{
  Search_budget result;
  switch (effort) {
  case Packing_effort::fast:
    result = racing_budget();
    result.max_charts = max_charts_of_fast_search;
    break;
  case Packing_effort::normal:
    result.rounds = 5;
    break;
  case Packing_effort::best:
    result.rounds = 48;
    break;
  }
  return result;
}

} // namespace internal

ATLAS_INLINE std::optional<Page_layout> Raster_packer::lay_out(const Page_task& task,
                                                               const Execution& execution) const
{
  return internal::Raster_engine{internal::search_budget(effort_)}.lay_out(task, execution);
}

ATLAS_INLINE Packing Raster_packer::pack(std::span<const Chart> charts, const Page_options& page,
                                         const Execution& execution) const
{
  return Page_packer(*this).pack(charts, page, execution);
}

} // namespace Atlas

#endif
