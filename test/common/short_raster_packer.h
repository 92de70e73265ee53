// SPDX-License-Identifier: MIT
#ifndef ATLAS_TEST_SHORT_RASTER_PACKER_H
#define ATLAS_TEST_SHORT_RASTER_PACKER_H

#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/raster/raster_layout.h>

#include <span>

namespace Atlas::test {

/// The search of `Raster_packer` with little time.
struct Short_raster_packer
{
  unsigned rounds = 1;

  Packing pack(std::span<const Chart> charts, const Page_options& page, const Execution& execution) const
  {
    internal::Search_budget budget;
    budget.searches = 2;
    budget.round = 400'000;
    budget.rounds = rounds;
    return Page_packer(internal::Raster_engine{budget}).pack(charts, page, execution);
  }
};

} // namespace Atlas::test

#endif
