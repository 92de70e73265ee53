// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_DETECT_FEATURES_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_DETECT_FEATURES_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/internal/features/Feature_tracer.h>
#include <Atlas/segmentation/internal/features/filter_normals.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// The angle between the normals on either side, in radians, per halfedge: second order differences. Zero
/// where there can be no feature. `normals` are per triangle.
inline std::vector<float> edge_sharpness(const Surface& surface, const Submesh& submesh,
                                         const std::vector<Vector_3>& normals)
{
  std::vector<float> sharpness(submesh.opposite.size(), 0);
  for (Index h = 0; h < sharpness.size(); ++h) {
    const Index o = submesh.opposite[h];
    if (o != no_index && h < o && !must_not_be_seam(surface, h))
      sharpness[h] = sharpness[o] = static_cast<float>(angle_between(normals[h / 3], normals[o / 3]));
  }
  return sharpness;
}

/// The threshold, or a little more where it is the angle of so many edges that more than twice the given
/// share of all would be sharp (the sides of a prism, steps of a machine part). But if hardly any edge is
/// sharper, less than a tenth of that share, these are the sharp ones after all.
inline float step_over_plateau(const std::vector<float>& values, float threshold, double share,
                               float tolerance)
{
  const auto count_from = [&](float least) {
    return static_cast<double>(
        std::count_if(values.begin(), values.end(), [&](float v) { return v >= least; }));
  };
  const double wanted = share * static_cast<double>(values.size());
  const float above = threshold * (1 + tolerance);
  constexpr double too_many = 2, too_few = 10; // times and parts of what is wanted
  const bool is_plateau = tolerance > 0 && count_from(threshold * (1 - tolerance)) > too_many * wanted &&
                          count_from(above) > wanted / too_few;
  return is_plateau ? above : threshold;
}

/// The least angle of a sharp edge: the quantile of the given share, but above the median by the contrast,
/// and above rounding.
inline float sharpness_threshold(const Surface& surface, const Submesh& submesh,
                                 const std::vector<float>& sharpness, const Feature_options& options)
{
  constexpr float rounding = 1e-5f; // radians that coplanar triangles in single precision may show
  std::vector<float> values;
  for (Index h = 0; h < sharpness.size(); ++h)
    if (submesh.opposite[h] != no_index && h < submesh.opposite[h] && !surface.is_diagonal(h))
      values.push_back(sharpness[h]);
  if (values.empty())
    return rounding;
  const auto quantile = [&](double q) {
    const auto k = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), k, values.end());
    return *k;
  };
  const double share = options.sharp_edge_share;
  return std::max(
      {step_over_plateau(values, quantile(1 - share), share, static_cast<float>(options.plateau_tolerance)),
       static_cast<float>(options.min_contrast) * quantile(0.5), rounding});
}

/// The feature curves, per halfedge of the surface: see Atlas::detect_features().
inline std::vector<std::uint8_t> detect_features(const Surface& surface, const Submesh& submesh,
                                                 const Feature_options& options)
{
  std::vector<Vector_3> normals = face_normals(surface);
  filter_normals(surface, submesh, options.normal_filter_rounds, normals);
  const std::vector<float> sharpness = edge_sharpness(surface, submesh, normals);
  const float threshold = sharpness_threshold(surface, submesh, sharpness, options);
  const double enough = options.min_feature_length_of_small_meshes *
                        std::sqrt(static_cast<double>(surface.number_of_triangles()));
  const int min_length = static_cast<int>(std::min<double>(options.min_feature_length, enough));
  Feature_tracer tracer(surface, submesh, sharpness, threshold, options.max_string_length, min_length,
                        options.neighborhood_rings);
  return tracer.run(options.hard_angle);
}

} // namespace Atlas::internal

#endif
