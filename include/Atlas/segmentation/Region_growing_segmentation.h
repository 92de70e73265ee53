// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_REGION_GROWING_SEGMENTATION_H
#define ATLAS_SEGMENTATION_REGION_GROWING_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

namespace Atlas {

/// \brief Faces grow together to charts while these stay planar and compact.
///
/// After Sander, Snyder, Gortler, Hoppe, *Texture Mapping Progressive Meshes*, SIGGRAPH 2001, section 3:
/// every face starts as a chart of its own, and the pair with the least cost merges; the cost grows with the
/// mean squared distance of the merged chart to its best plane, and with its perimeter. Two things differ:
/// the perimeter counts by the chart's own area, as in Garland, Willmott, Heckbert, *Hierarchical Face
/// Clustering*, I3D 2001, so that large planes may become one chart; and all pairs below a rising bound merge
/// at once, each chart with one other, so that the work is O(n log n). A baseline, and a base for merging. A
/// model of `ChartSegmentation`.
class Region_growing_segmentation
{
public:
  /// None is negative; costs are numbers without a unit.
  struct Options
  {
    /// Weight of (mean squared distance to the best plane) / (area of the chart).
    double planarity_weight = 400;
    /// Weight of (perimeter squared) / (4 pi area of the chart) - 1, which is 0 for a disc.
    double compactness_weight = 0.2;
    /// Pairs whose cost would be larger do not merge; finite.
    double max_cost = 1;
    /// Nor do pairs for which the mean of |n - N|^2 over the area would be larger, n the normal of a place
    /// and N that of the chart: from 0, flat, to 4. The two sides of a plate are coplanar, too.
    double max_spread = 0.5;
  };

  Region_growing_segmentation() = default;
  /// \throws Invalid_argument if an option is out of its range
  explicit Region_growing_segmentation(const Options& options);

  /// What is asked for.
  const Options& options() const { return options_; }

  /// Once cancelled, returns what has grown by then.
  Segmentation segment(const Surface& surface, const Execution& execution) const;

private:
  Options options_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/elements/Region_growing_segmentation_impl.h>
#endif

#endif
