// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_VARIATIONAL_SEGMENTATION_H
#define ATLAS_SEGMENTATION_VARIATIONAL_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

namespace Atlas {

/// \brief Variational shape approximation: clusters of triangles that planes fit best.
///
/// Cohen-Steiner, Alliez, Desbrun, *Variational Shape Approximation*, SIGGRAPH 2004, with the metric L2,1 and
/// a term that keeps charts compact. The clusters are found on groups of triangles first, whose number hardly
/// depends on the resolution and whose averaged normals filter noise, and settle on the triangles at the end.
/// Input faces stay whole, patches and seams the user asks for are not crossed, charts are connected.
/// Deterministic; O(n log n). A model of `ChartSegmentation`.
class Variational_segmentation
{
public:
  /// What can be asked for.
  struct Options
  {
    /// Number of charts; 0 lets `max_spread` decide. Every connected component has one chart at least.
    Index number_of_charts = 0;
    /// A chart gets divided while the mean of |n - N|^2 over it is larger; n is the normal of a place, N that
    /// of the chart. Positive; 4 and more never divides.
    double max_spread = 0.12;
    /// Charts below this share of their component's area are divided more reluctantly; in [0, 1].
    double small_share = 1.0 / 60;
    /// Weight of the squared distance to the chart's centre, in units of the mean squared radius of charts;
    /// not negative.
    double compactness = 0.1;
    /// Rounds of fitting planes and growing charts anew after the last chart has been added; at least 1.
    int iterations = 8;
    /// Of these, the rounds on the triangles themselves; in [1, iterations].
    int fine_iterations = 2;
  };

  Variational_segmentation() = default;
  /// \throws Invalid_argument if an option is out of its range
  explicit Variational_segmentation(const Options& options);

  /// What is asked for.
  const Options& options() const { return options_; }

  /// Once cancelled, returns one chart per connected component or better.
  Segmentation segment(const Surface& surface, const Execution& execution) const;

private:
  Options options_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/elements/Variational_segmentation_impl.h>
#endif

#endif
