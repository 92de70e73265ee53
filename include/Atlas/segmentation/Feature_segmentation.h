// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_FEATURE_SEGMENTATION_H
#define ATLAS_SEGMENTATION_FEATURE_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

/// \file
/// \brief The segmentation of the LSCM paper, and its three steps as functions of their own.

namespace Atlas {

/// \brief What counts as a feature curve. Defaults are those of the paper (section 3.1) where it has any.
struct Feature_options
{
  /// Share of the edges that are sharp enough to start a feature curve, in [0, 1].
  double sharp_edge_share = 0.05;
  /// Edges in the string that looks ahead, at least 1; so long are the gaps that a curve crosses.
  int max_string_length = 5;
  /// A curve needs more edges than that; not negative.
  int min_feature_length = 15;
  /// On small meshes so many times the square root of the number of triangles is enough: those of less than
  /// about 3600 triangles have not fifteen edges from one end to the other. Not in the paper; not negative;
  /// infinity turns it off.
  double min_feature_length_of_small_meshes = 0.25;
  /// So many rings of edges around a feature cannot become features themselves; not negative.
  int neighborhood_rings = 1;
  /// Sharp edges are at least so many times as sharp as the median edge. Not in the paper: where curvature is
  /// spread evenly, the sharpest five percent are no features. Not negative; 0 turns it off.
  double min_contrast = 3;
  /// If so many edges have about the angle of the threshold (the sides of a prism, steps of a machine part)
  /// that more than twice the share would be sharp, only those sharper by more than this part of the angle
  /// are, unless they are too few. Not in the paper; in [0, 1]; 0 turns it off.
  double plateau_tolerance = 0.01;
  /// Edges with a greater angle between the normals, in radians, are features whatever their length. Not in
  /// the paper; not negative; pi turns it off.
  double hard_angle = std::numbers::pi;
  /// Rounds of the bilateral filter of the normals that sharpness is measured on (against noise and stair
  /// steps). Not in the paper; not negative; 0 turns it off. Positions are never changed.
  int normal_filter_rounds = 0;

  /// The paper's own: no rule that it does not have. On small meshes, and where curvature is spread evenly,
  /// it finds few features or too many.
  static Feature_options paper();
};

/// \brief When charts that meet while they grow become one. Shares are of the largest distance to features
/// (the paper's maxdist), in [0, 1].
struct Growth_options
{
  /// Charts merge that both rise less than that above the place where they meet: the paper's epsilon =
  /// maxdist/4.
  double merge_depth = 0.25;
  /// So do charts of which one rises less than that. Not in the paper; it makes seeds that are mere noise
  /// harmless.
  double noise_depth = 0.01;
  /// Whether the largest distance is that on the whole surface, as in the paper. If not, it is that in the
  /// connected component, so that a small component is cut as it would be alone.
  bool is_depth_global = false;

  /// The paper's own: charts merge only if both rise less than epsilon, a share of the global maximum.
  static Growth_options paper();
};

/// \brief Finds the feature curves: chains of edges along which the normal turns sharply.
///
/// Algorithm 1 of B. Levy, S. Petitjean, N. Ray, J. Maillot, Least squares conformal maps for automatic
/// texture atlas generation, SIGGRAPH 2002. From each sharp edge, sharpest first, a curve grows to both sides
/// in the direction of the sharpest string of edges ahead. Diagonals of input polygons and edges that must
/// not be seams are never features. O(n log n) for n triangles.
///
/// \returns per halfedge of the surface, the same on both sides, whether the edge is a feature
/// \throws Invalid_argument if an option is out of its range
std::vector<std::uint8_t> detect_features(const Surface& surface, const Feature_options& options = {});

/// \brief The function that drives the growth of charts: how far each triangle is from the features.
///
/// The distance runs along the surface to the nearest border, patch border, wanted seam or feature. A
/// connected component without any of them is closed; it gets the function of the paper's diameter rule:
/// highest at the two ends of a diameter, falling with the distance to the nearer one. Section 3.2 of the
/// LSCM paper; distances by fast marching. O(n log n).
///
/// \param is_feature  per halfedge of the surface, as detect_features() returns it
/// \returns per triangle, in the unit of the model, not negative; all triangles of a face have one value
/// \throws Invalid_argument if `is_feature` has another size than the halfedges
std::vector<double> distance_to_features(const Surface& surface, const std::vector<std::uint8_t>& is_feature);

/// \brief Grows charts from the local maxima of a function on the triangles until they cover the surface.
///
/// Algorithm 2 of the LSCM paper. The highest triangles grow first, so that charts meet in the valleys, the
/// features. All edges are boundaries at first; those that a chart grows across are removed, and so are loose
/// ends, over and over: a chart that meets itself around a cylinder keeps a cut along which it borders
/// itself, and remains a disc. (Only a closed sphere that is one chart is left without boundary.) Charts are
/// numbered by their first triangles. O(n log n).
///
/// \param distance  per triangle, the same for all triangles of a face; see distance_to_features()
/// \throws Invalid_argument if `distance` has another size than the triangles, or an option is out of its
/// range
Segmentation expand_charts(const Surface& surface, const std::vector<double>& distance,
                           const Growth_options& options = {});

/// \brief What is looked at to find socks, capped cylinders that a cut makes easier to flatten.
enum class Sock_rule {
  parts, ///< the chart and its parts that lie far from its border, so that a finger is found if the chart
         ///< goes on beyond it; each is cut open from its tip. Not in the paper
  whole_chart ///< only the chart as a whole, which is cut open from its seed: as in the paper
};

/// A chart is a sock if area / perimeter^2 is greater than that of a hemisphere, 1 / (2 pi); flat charts have
/// at most half of it.
inline constexpr double default_sock_ratio = 0.5 / std::numbers::pi;

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
  Feature_options features; ///< section 3.1
  Growth_options growth;    ///< section 3.2
  /// Charts with a greater area / perimeter^2 are cut open; positive. The paper gives no number. (Its ratio
  /// is area / perimeter; the square makes it independent of the unit.)
  double sock_ratio = default_sock_ratio;
  /// What that ratio is measured on.
  Sock_rule sock_rule = Sock_rule::parts;
  /// Charts of fewer triangles merge with a neighbour, if they have one. Not in the paper.
  std::size_t min_chart_triangles = 10;
  /// So do charts with less than this share of the area of the whole surface, in [0, 1]. Not in the paper.
  double min_chart_area = 1e-4;
  /// More charts than that are merged, smallest first, as far as patches and components let them; 0: no
  /// limit. Not in the paper. Cutting to discs, later, can make more of them.
  std::size_t max_charts = 0;

  /// \brief Section 3 of the paper to the letter: `Feature_options::paper()`, `Growth_options::paper()`,
  /// socks as whole charts, and no chart is too small.
  ///
  /// Numbers of charts by the defaults and by the letter: bunny 20 and 38, horse 17 and 27, dinosaur 14 and
  /// 21, cow 5 and 11, skull 4 and 6.
  static Feature_segmentation paper();

  /// Once cancelled, may return one chart.
  /// \throws Invalid_argument if an option is out of its range
  Segmentation segment(const Surface& surface, const Execution& execution = Execution()) const;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/segmentation/internal/features/Feature_segmentation_impl.h>
#endif

#endif
