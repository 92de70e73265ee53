// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_FEATURE_SEGMENTATION_H
#define ATLAS_SEGMENTATION_FEATURE_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/distance_to_features.h>
#include <Atlas/segmentation/expand_charts.h>
#include <Atlas/segmentation/feature_detection.h>
#include <Atlas/segmentation/internal/features/absorb_small_charts.h>
#include <Atlas/segmentation/internal/features/cut_socks.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

/// A chart is a sock if area / perimeter^2 is greater than that of a hemisphere, 1 / (2 pi); flat charts have
/// at most half of it.
inline constexpr double default_sock_ratio = 0.5 / CGAL_PI;

/// \brief Cuts the surface where it is sharp: the paper's own segmentation.
///
/// Section 3 of B. Levy, S. Petitjean, N. Ray, J. Maillot, Least squares conformal maps for automatic texture
/// atlas generation, SIGGRAPH 2002. Feature curves are found, charts grow from the places farthest from them
/// and meet at the features; see detect_features(), distance_to_features(), expand_charts(). Socks, charts
/// that are capped cylinders, get a cut from the seed to the border. The members are the parameters; those
/// that the paper does not have say so. Near-linear: O(n log n). A model of `ChartSegmentation`.
class Feature_segmentation
{
public:
  Feature_options features;               ///< section 3.1
  Growth_options growth;                  ///< section 3.2
  double sock_ratio = default_sock_ratio; ///< the paper gives no number
  /// Charts of fewer triangles merge with a neighbour, if they have one. Not in the paper.
  std::size_t min_chart_triangles = 10;
  /// So do charts with less than this share of the area of the whole surface, in [0, 1]. Not in the paper.
  double min_chart_area = 1e-4;
  /// More charts than that are merged, smallest first, as far as patches and components let them; 0: no
  /// limit. Not in the paper. Cutting to discs, later, can make more of them.
  std::size_t max_charts = 0;

  Segmentation segment(const Surface& surface, const Execution& execution = Execution()) const
  {
    const internal::Submesh piece = internal::surface_connectivity(surface);
    const std::vector<std::uint8_t> is_feature = internal::detect_features(surface, piece, features);
    if (!execution.proceed(0.4))
      return unfinished(surface);
    const internal::Feature_distance field = internal::distance_to_features(surface, piece, is_feature);
    if (!execution.proceed(0.7))
      return unfinished(surface);
    internal::Chart_boundaries boundaries =
        internal::Chart_growth(surface, piece, field.triangle,
                               internal::largest_of_component(piece, field.triangle), growth)
            .run();
    absorb(surface, piece, boundaries);
    Segmentation segmentation = boundaries.segmentation();
    internal::cut_socks(surface, sock_ratio, segmentation, execution);
    execution.proceed(1);
    return segmentation;
  }

private:
  void absorb(const Surface& surface, const internal::Submesh& piece,
              internal::Chart_boundaries& boundaries) const
  {
    double area = 0;
    for (Index t = 0; t < surface.number_of_triangles(); ++t)
      area += internal::triangle_area(surface, t);
    internal::Small_chart_absorber(surface, piece, boundaries)
        .run({min_chart_triangles, min_chart_area * area, max_charts});
  }

  static Segmentation unfinished(const Surface& surface)
  {
    return {std::vector<Index>(surface.number_of_triangles(), 0),
            std::vector<std::uint8_t>(3 * surface.number_of_triangles(), 0), 1};
  }
};

} // namespace Atlas

#endif
