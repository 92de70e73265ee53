// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_LEAST_PAGE_H
#define ATLAS_PACKING_INTERNAL_PAGES_LEAST_PAGE_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace Atlas::internal {

/// Pages are tried whose sides are those that were asked for times and over 2^(k / steps_of_aspect), |k| up
/// to this many steps: so up to a ratio of 4 from a square.
inline constexpr int most_aspect_steps = 8, steps_of_aspect = 8;

/// The enclosing rectangle of least area for its charts, with about the texels of the page asked for: the
/// paper wants that rectangle, rescaled to the size of the texture. One packing for each of 17 ratios of its
/// sides.
inline Page_options least_page(std::span<const Chart> charts, const Page_options& page,
                               const Any_packer& packer, const Execution& execution)
{
  Page_options best = page;
  double most_coverage = 0;
  for (int k = -most_aspect_steps; k <= most_aspect_steps && !execution.is_cancelled(); ++k) {
    const double factor = std::exp2(double(k) / steps_of_aspect);
    Page_options candidate = page;
    const auto side = [](double length) {
      return static_cast<Index>(std::clamp(std::round(length), 1.0, double(max_page_side)));
    };
    candidate.width = side(page.width * factor);
    candidate.height = side(page.height / factor);
    if (!(2 * page.effective_gutter() < std::min(candidate.width, candidate.height)))
      continue;
    const Packing packing = packer.pack(charts, candidate, execution);
    if (packing.number_of_pages == 0)
      continue;
    const double coverage = packing.density * packing.density /
                            (double(candidate.width) * candidate.height * packing.number_of_pages);
    if (coverage > most_coverage) {
      most_coverage = coverage;
      best = candidate;
    }
  }
  return best;
}

} // namespace Atlas::internal

#endif
