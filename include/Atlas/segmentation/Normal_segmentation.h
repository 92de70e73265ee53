// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_NORMAL_SEGMENTATION_H
#define ATLAS_SEGMENTATION_NORMAL_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

namespace Atlas {

/// \brief Connected faces whose normals fall into the same cell of the sphere of directions.
///
/// After Maillot, Yahia, Verroust, *Interactive Texture Mapping*, SIGGRAPH 1993: normals are put into the
/// cells of a grid on the sphere, here that of a cube whose sides have cells_per_side^2 cells; faces of one
/// cell that hang together make a chart; small charts join the neighbour they share the longest border with.
/// A baseline: simple and fast, and the seams of smooth shapes run anywhere. O(n log n). A model of
/// `ChartSegmentation`.
class Normal_segmentation
{
public:
  /// What can be asked for.
  struct Options
  {
    /// 1 groups by the six sides of a cube, 2 by 24 cells, n by 6 n^2; in [1, 1000].
    int cells_per_side = 1;
    /// Charts with a smaller share of the surface's area join a neighbour; in [0, 1].
    double min_share = 1.0 / 400;
  };

  Normal_segmentation() = default;
  /// \throws Invalid_argument if an option is out of its range
  explicit Normal_segmentation(const Options& options);

  /// What is asked for.
  const Options& options() const { return options_; }

  /// Once cancelled, leaves small charts as they are.
  Segmentation segment(const Surface& surface, const Execution& execution) const;

private:
  Options options_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/elements/Normal_segmentation_impl.h>
#endif

#endif
