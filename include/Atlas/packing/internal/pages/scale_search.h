// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_SCALE_SEARCH_H
#define ATLAS_PACKING_INTERNAL_PAGES_SCALE_SEARCH_H

#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/shapes/Outline.h>

#include <algorithm>
#include <cmath>

namespace Atlas::internal {

/// What coordinates of a page of this size lose in single precision, in texels, with a safety factor of 4.
inline double rounding_margin(Index width, Index height)
{
  return std::max(width, height) * 0x1p-23;
}

/// The scale beyond which pieces, each with an area and a radius, cannot fit: they fill the page, or the
/// largest sticks out.
template <typename Pieces>
double scale_bound(const Pieces& pieces, double width, double height)
{
  double area = 0;
  for (const auto& piece : pieces)
    area += piece.area;
  double bound = area > 0 ? std::sqrt(width * height / area) : HUGE_VAL;
  for (const auto& piece : pieces)
    if (piece.radius > 0)
      bound = std::min(bound, std::hypot(width, height) / piece.radius);
  return bound < HUGE_VAL ? bound : 1;
}

/// Searches the largest scale at which `layout(scale, margin)` finds a layout, to a relative `precision`.
///
/// `margin` is that of the task, or less where the page has no room for all charts with the gutter even when
/// they shrink to points: then the widest (in steps of a quarter) that leaves room. Scales above the most
/// that is wanted are not looked for.
template <typename Layout>
auto search_scale(const Outlines& outlines, const Page_task& task, double precision, Layout layout)
{
  double margin = task.margin,
         high = std::min(task.most_scale, scale_bound(outlines.charts, task.width, task.height));
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
  if (task.most_scale <= high && best && attempt(high))
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
