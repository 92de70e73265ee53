// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MIRROR_MIRRORED_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_MIRROR_MIRRORED_SEGMENTATION_IMPL_H

#include <Atlas/core/extract_charts.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/merging/layout_limits.h>
#include <Atlas/segmentation/internal/merging/merge_across_forbidden_seams.h>
#include <Atlas/segmentation/internal/merging/merge_trial.h>
#include <Atlas/segmentation/internal/mirror/Doubling_parameterizer.h>
#include <Atlas/segmentation/internal/mirror/Half_surface.h>
#include <Atlas/segmentation/internal/mirror/Mirror_image.h>
#include <Atlas/segmentation/internal/mirror/find_mirror_plane.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// Per halfedge of the half, whether its chart goes on beyond the plane there: where the chart keeps the
/// bound together with its image.
inline std::vector<std::uint8_t> glued_at_plane(const Surface& surface, const Half_surface& half,
                                                const Segmentation& segmentation,
                                                const Merged_segmentation& merged, const Execution& execution)
{
  const std::vector<Chart> charts = extract_charts(half.part, segmentation);
  std::vector<std::uint8_t> is_glued(half.part.opposite.size(), 0);
  const Execution alone;
  execution.for_each(charts.size(), [&](std::size_t c) {
    const std::vector<Index> run = run_on_mirror_plane(charts[c]);
    if (run.empty())
      return;
    Chart coarse = coarse_copy(charts[c], triangles_of_coarse_copies(merged.options()));
    if (merged.parameterizer().parameterize(coarse, alone) != Chart_status::valid ||
        !is_within_bound(coarse, merged.options()))
      return;
    for (const Index h : run)
      if (const Index g = 3 * charts[c].source[h / 3] + h % 3; half.is_at_plane(surface, g))
        is_glued[g] = 1;
  });
  return is_glued;
}

/// The options for a half: wishes for few or large charts are about both halves together.
inline Merge_options options_of_half(Merge_options options)
{
  options.max_charts = (options.max_charts + 1) / 2;
  options.min_chart_area *= 2;
  return options;
}

} // namespace internal

ATLAS_INLINE Mirrored_segmentation::Mirrored_segmentation(Merged_segmentation merged, Symmetry symmetry)
    : merged_(std::move(merged)),
      half_(merged_.base(), internal::Doubling_parameterizer{merged_.parameterizer(), merged_.optimizer()},
            internal::No_further_optimizer(), internal::options_of_half(merged_.options())),
      symmetry_(symmetry)
{}

ATLAS_INLINE Segmentation Mirrored_segmentation::segment(const Surface& surface,
                                                         const Execution& execution) const
{
  std::optional<internal::Mirror_plane> plane;
  if (symmetry_ != Symmetry::off)
    plane = internal::Mirror_plane_finder(surface, execution)(symmetry_);
  if (!plane)
    return merged_.segment(surface, execution);
  const internal::Half_surface half(surface, *plane);
  if (half.global.empty() || half.global.size() == surface.number_of_triangles())
    return merged_.segment(surface, execution);
  Segmentation of_half = half_.segment(half.part, execution);
  if (!execution.is_cancelled())
    cut_to_discs(half.part, of_half, execution);
  const std::vector<std::uint8_t> is_glued =
      internal::glued_at_plane(surface, half, of_half, half_, execution);
  Segmentation result = internal::Mirror_image(surface, *plane, half, of_half, is_glued, execution)();
  internal::merge_across_forbidden_seams(surface, result);
  return result;
}

} // namespace Atlas

#endif
