// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_SCALE_SEARCH_H
#define ATLAS_PACKING_INTERNAL_PAGES_SCALE_SEARCH_H

#include <Atlas/packing/internal/shapes/Outline.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace Atlas::internal {

/// What coordinates of a page of this size lose in single precision, in texels, with a safety factor of 4.
inline double rounding_margin(const Page_options& page)
{
  return std::max(page.width, page.height) * 0x1p-23;
}

/// The scale beyond which the charts cannot fit: they fill the page, or the largest sticks out.
inline double scale_bound(const Outlines& outlines, const Page_options& page)
{
  const double width = page.width, height = page.height;
  double bound = outlines.area > 0 ? std::sqrt(width * height / outlines.area) : HUGE_VAL;
  for (const Outline& outline : outlines.charts)
    if (outline.radius > 0)
      bound = std::min(bound, std::hypot(width, height) / outline.radius);
  return bound < HUGE_VAL ? bound : 1;
}

/// Searches the largest scale at which `layout(scale, margin)` finds a layout, to a relative `precision`.
///
/// `margin` is half the gutter, or less where the page has no room for all charts with the gutter even when
/// they shrink to points: then the widest gutter (in steps of a quarter) that leaves room. Scales above
/// `most` are not looked for.
template <typename Layout>
auto search_scale(const Outlines& outlines, const Page_options& page, double most, double precision,
                  Layout layout)
{
  double margin = page.gutter / 2 + rounding_margin(page), high = std::min(most, scale_bound(outlines, page));
  double low = high * 1e-7;
  auto best = layout(low, margin);
  while (!best && margin > 0x1p-40) {
    margin *= 0.75;
    best = layout(low, margin);
  }
  const auto attempt = [&](double scale) {
    auto found = layout(scale, margin);
    if (!found)
      return false;
    best = std::move(found);
    low = scale;
    return true;
  };
  if (most <= high && best && attempt(high))
    return best;
  for (double scale = high / 2; scale > low && !attempt(scale); scale /= 2)
    high = scale;
  while (best && high > low * (1 + precision))
    if (const double middle = std::sqrt(low * high); !attempt(middle))
      high = middle;
  return best;
}

} // namespace Atlas::internal

#endif
