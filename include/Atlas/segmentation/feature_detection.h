// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_FEATURE_DETECTION_H
#define ATLAS_SEGMENTATION_FEATURE_DETECTION_H

#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/features/Feature_tracer.h>
#include <Atlas/segmentation/internal/features/filter_normals.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Atlas {

/// \brief What counts as a feature curve. Defaults are those of the paper (section 3.1) where it has any.
struct Feature_options
{
  /// Share of the edges that are sharp enough to start a feature curve, in [0, 1].
  double sharp_edge_share = 0.05;
  /// Edges in the string that looks ahead; so long are the gaps that a curve crosses.
  int max_string_length = 5;
  /// A curve needs more edges than that.
  int min_feature_length = 15;
  /// On small meshes so many times the square root of the number of triangles is enough: those of less than
  /// about 3600 triangles have not fifteen edges from one end to the other. Not in the paper; infinity turns
  /// it off.
  double min_feature_length_of_small_meshes = 0.25;
  /// So many rings of edges around a feature cannot become features themselves.
  int neighborhood_rings = 1;
  /// Sharp edges are at least so many times as sharp as the median edge. Not in the paper: where curvature is
  /// spread evenly, the sharpest five percent are no features.
  double min_contrast = 3;
  /// If so many edges have about the angle of the threshold (the sides of a prism, steps of a machine part)
  /// that more than twice the share would be sharp, only those sharper by more than this part of the angle
  /// are, unless they are too few. Not in the paper; 0 turns it off.
  double plateau_tolerance = 0.01;
  /// Edges with a greater angle between the normals, in radians, are features whatever their length. Not in
  /// the paper; pi turns it off.
  double hard_angle = CGAL_PI;
  /// Rounds of the bilateral filter of the normals that sharpness is measured on (against noise and stair
  /// steps). Not in the paper; 0 turns it off. Positions are never changed.
  int normal_filter_rounds = 0;
};

namespace internal {

/// The angle between the normals on either side, in radians, per halfedge: second order differences. Zero
/// where there can be no feature. `normals` are per triangle.
inline std::vector<float> edge_sharpness(const Surface& surface, const Submesh& piece,
                                         const std::vector<Vector_3>& normals)
{
  std::vector<float> sharpness(piece.opposite.size(), 0);
  for (Index h = 0; h < sharpness.size(); ++h) {
    const Index o = piece.opposite[h];
    if (o != no_index && h < o && !must_not_be_seam(surface, h))
      sharpness[h] = sharpness[o] = static_cast<float>(angle_between(normals[h / 3], normals[o / 3]));
  }
  return sharpness;
}

/// Edges of a threshold that many edges share (the sides of a prism, steps of a machine part) are sharp if
/// they are about the sharpest there are; if the given share of all edges, divided by ten, is sharper, they
/// are not.
inline float step_over_plateau(const std::vector<float>& values, float threshold, double share,
                               float tolerance)
{
  const auto count_from = [&](float least) {
    return static_cast<double>(
        std::count_if(values.begin(), values.end(), [&](float v) { return v >= least; }));
  };
  const double wanted = share * static_cast<double>(values.size());
  const float above = threshold * (1 + tolerance);
  const bool is_plateau = tolerance > 0 && count_from(threshold * (1 - tolerance)) > 2 * wanted &&
                          count_from(above) > wanted / 10;
  return is_plateau ? above : threshold;
}

/// The least angle of a sharp edge: the quantile of the given share, but above the median by the contrast,
/// and above rounding.
inline float sharpness_threshold(const Surface& surface, const Submesh& piece,
                                 const std::vector<float>& sharpness, const Feature_options& options)
{
  constexpr float rounding = 1e-5f;
  std::vector<float> values;
  for (Index h = 0; h < sharpness.size(); ++h)
    if (piece.opposite[h] != no_index && h < piece.opposite[h] && !surface.is_diagonal(h))
      values.push_back(sharpness[h]);
  if (values.empty())
    return rounding;
  const auto quantile = [&](double q) {
    const auto k = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), k, values.end());
    return *k;
  };
  const double share = std::clamp(options.sharp_edge_share, 0., 1.);
  return std::max(
      {step_over_plateau(values, quantile(1 - share), share, static_cast<float>(options.plateau_tolerance)),
       static_cast<float>(options.min_contrast) * quantile(0.5), rounding});
}

inline std::vector<std::uint8_t> detect_features(const Surface& surface, const Submesh& piece,
                                                 const Feature_options& options)
{
  std::vector<Vector_3> normals = face_normals(surface);
  filter_normals(surface, piece, options.normal_filter_rounds, normals);
  const std::vector<float> sharpness = edge_sharpness(surface, piece, normals);
  const float threshold = sharpness_threshold(surface, piece, sharpness, options);
  const double enough = options.min_feature_length_of_small_meshes *
                        std::sqrt(static_cast<double>(surface.number_of_triangles()));
  const int min_length = static_cast<int>(std::min<double>(options.min_feature_length, enough));
  Feature_tracer tracer(surface, piece, sharpness, threshold, options.max_string_length, min_length,
                        options.neighborhood_rings);
  return tracer.run(options.hard_angle);
}

} // namespace internal

/// \brief Finds the feature curves: chains of edges along which the normal turns sharply.
///
/// Algorithm 1 of B. Levy, S. Petitjean, N. Ray, J. Maillot, Least squares conformal maps for automatic
/// texture atlas generation, SIGGRAPH 2002. From each sharp edge, sharpest first, a curve grows to both sides
/// in the direction of the sharpest string of edges ahead. Returns, per halfedge and the same on both sides,
/// whether the edge is a feature. Diagonals and edges that must not be seams never are. O(n log n).
inline std::vector<std::uint8_t> detect_features(const Surface& surface, const Feature_options& options = {})
{
  return internal::detect_features(surface, internal::surface_connectivity(surface), options);
}

} // namespace Atlas

#endif
