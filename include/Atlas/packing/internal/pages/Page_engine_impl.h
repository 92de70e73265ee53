// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_PAGE_ENGINE_IMPL_H
#define ATLAS_PACKING_INTERNAL_PAGES_PAGE_ENGINE_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/pages/scale_search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace Atlas {

ATLAS_INLINE std::array<std::complex<double>, 2> Page_piece::box() const
{
  double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL, top = -HUGE_VAL;
  for (const std::complex<double>& p : points) {
    left = std::min(left, p.real());
    right = std::max(right, p.real());
    bottom = std::min(bottom, p.imag());
    top = std::max(top, p.imag());
  }
  return {std::complex(left, bottom), std::complex(right, top)};
}

ATLAS_INLINE double Page_task::largest_scale() const
{
  return std::min(most_scale, internal::scale_bound(pieces, width, height));
}

} // namespace Atlas

#endif
