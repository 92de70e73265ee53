// SPDX-License-Identifier: MIT
#ifndef ATLAS_TEST_SHORT_RASTER_PACKER_H
#define ATLAS_TEST_SHORT_RASTER_PACKER_H

#include <Atlas/packing/Raster_packer.h>

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
    const auto layout = [&](const auto& outlines, const auto& one, double most_scale, const auto& e) {
      return internal::raster_layout(outlines, one, budget, most_scale, e);
    };
    return internal::pack_pages(charts, page, layout, execution);
  }
};

} // namespace Atlas::test

#endif
