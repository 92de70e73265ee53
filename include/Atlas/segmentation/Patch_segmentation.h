// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_PATCH_SEGMENTATION_H
#define ATLAS_SEGMENTATION_PATCH_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <utility>
#include <vector>

namespace Atlas {

/// \brief Takes charts as the user gives them.
///
/// Patch numbers are per input face, or those of `Surface::patch`; equal numbers make one chart. Without
/// either the whole surface is one chart. Cutting to discs, later, separates what is not connected and adds
/// the cuts that topology and constraints ask for. A model of `ChartSegmentation`. O(n log n).
class Patch_segmentation
{
public:
  /// Charts are the surface's patches.
  Patch_segmentation() = default;

  /// \param patch_of_face  per input face, any numbers; faces beyond the end of the list are in one more
  /// patch
  explicit Patch_segmentation(std::vector<Index> patch_of_face) : patch_of_face_(std::move(patch_of_face)) {}

  /// A chart for each patch, cut at edges that must be seams.
  Segmentation segment(const Surface& surface, const Execution& execution = Execution()) const;

private:
  Index patch(const Surface& surface, Index t) const;

  std::vector<Index> patch_of_face_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/elements/Patch_segmentation_impl.h>
#endif

#endif
