// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_SMOOTH_BORDERS_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_SMOOTH_BORDERS_IMPL_H

#include <Atlas/segmentation/internal/arguments.h>
#include <Atlas/segmentation/internal/smoothing/Segmentation_smoother.h>
#include <Atlas/segmentation/smooth_borders.h>

#include <cstddef>
#include <limits>

namespace Atlas {

namespace internal {

inline void require_valid(const Smoothing_options& options)
{
  require_in(options.rings, 0, std::numeric_limits<int>::max() / 2, "rings");
  require_in(options.rounds, 0, std::numeric_limits<int>::max(), "rounds");
  require_positive(options.sharp_angle, "sharp_angle");
  require_share(options.sharp_discount, "sharp_discount");
}

} // namespace internal

ATLAS_INLINE std::size_t smooth_borders(const Surface& surface, Segmentation& segmentation,
                                        const Smoothing_options& options, const Execution& execution,
                                        const Smoothing_filter& keep)
{
  internal::require_valid(options);
  internal::require_numbered_segmentation_of(surface, segmentation);
  const internal::Smoothing_limits limits = internal::smoothing_limits(surface, segmentation);
  internal::Segmentation_smoother smoother(surface, segmentation, limits, options);
  internal::Segmentation_smoother::Filter filter;
  if (keep)
    filter = [&](const std::array<Chart, 2>& charts, const auto&) { return keep(charts[0], charts[1]); };
  std::size_t moved = 0;
  for (int round = 0; round < options.rounds; ++round) {
    moved += smoother.run_round(options.rings, execution, filter);
    if (!execution.proceed(double(round + 1) / options.rounds))
      break;
  }
  return moved;
}

} // namespace Atlas

#endif
