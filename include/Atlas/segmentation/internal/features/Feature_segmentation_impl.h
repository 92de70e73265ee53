// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_FEATURE_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_FEATURE_SEGMENTATION_IMPL_H

#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/internal/arguments.h>
#include <Atlas/segmentation/internal/features/Chart_growth.h>
#include <Atlas/segmentation/internal/features/Feature_distance.h>
#include <Atlas/segmentation/internal/features/Small_chart_absorber.h>
#include <Atlas/segmentation/internal/features/Sock_finder.h>
#include <Atlas/segmentation/internal/features/detect_features.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace Atlas {

namespace internal {

inline void require_valid(const Feature_options& options)
{
  constexpr int most = std::numeric_limits<int>::max();
  require_share(options.sharp_edge_share, "sharp_edge_share");
  require_in(options.max_string_length, 1, most, "max_string_length");
  require_in(options.min_feature_length, 0, most, "min_feature_length");
  require_not_negative(options.min_feature_length_of_small_meshes, "min_feature_length_of_small_meshes");
  require_in(options.neighborhood_rings, 0, most, "neighborhood_rings");
  require_not_negative(options.min_contrast, "min_contrast");
  require_share(options.plateau_tolerance, "plateau_tolerance");
  require_not_negative(options.hard_angle, "hard_angle");
  require_in(options.normal_filter_rounds, 0, most, "normal_filter_rounds");
}

inline void require_valid(const Growth_options& options)
{
  require_share(options.merge_depth, "merge_depth");
  require_share(options.noise_depth, "noise_depth");
}

inline void require_valid(const Feature_segmentation& segmentation)
{
  require_valid(segmentation.features);
  require_valid(segmentation.growth);
  require_positive(segmentation.sock_ratio, "sock_ratio");
  require_share(segmentation.min_chart_area, "min_chart_area");
}

/// All in one chart.
inline Segmentation one_chart_of(const Surface& surface)
{
  return {std::vector<Index>(surface.number_of_triangles(), 0),
          std::vector<std::uint8_t>(3 * surface.number_of_triangles(), 0), 1};
}

inline double area_of_triangles(const Surface& surface)
{
  double area = 0;
  for (Index t = 0; t < surface.number_of_triangles(); ++t)
    area += triangle_area(surface, t);
  return area;
}

/// Per triangle, the paper's maxdist.
inline std::vector<double> largest_distances(const Submesh& submesh, const std::vector<double>& distance,
                                             const Growth_options& options)
{
  if (!options.is_depth_global || distance.empty())
    return largest_of_component(submesh, distance);
  return std::vector<double>(distance.size(), *std::max_element(distance.begin(), distance.end()));
}

} // namespace internal

ATLAS_INLINE Feature_options Feature_options::paper()
{
  Feature_options options;
  options.min_feature_length_of_small_meshes = std::numeric_limits<double>::infinity();
  options.min_contrast = 0;
  options.plateau_tolerance = 0;
  return options;
}

ATLAS_INLINE Growth_options Growth_options::paper()
{
  Growth_options options;
  options.noise_depth = 0;
  options.is_depth_global = true;
  return options;
}

ATLAS_INLINE Feature_segmentation Feature_segmentation::paper()
{
  Feature_segmentation segmentation;
  segmentation.features = Feature_options::paper();
  segmentation.growth = Growth_options::paper();
  segmentation.sock_rule = Sock_rule::whole_chart;
  segmentation.min_chart_triangles = 0;
  segmentation.min_chart_area = 0;
  return segmentation;
}

ATLAS_INLINE std::vector<std::uint8_t> detect_features(const Surface& surface, const Feature_options& options)
{
  internal::require_valid(options);
  return internal::detect_features(surface, internal::surface_connectivity(surface), options);
}

ATLAS_INLINE std::vector<double> distance_to_features(const Surface& surface,
                                                      const std::vector<std::uint8_t>& is_feature)
{
  internal::require_size(is_feature.size(), surface.opposite.size(), "is_feature", "halfedges");
  return internal::distance_to_features(surface, internal::surface_connectivity(surface), is_feature)
      .triangle;
}

ATLAS_INLINE Segmentation expand_charts(const Surface& surface, const std::vector<double>& distance,
                                        const Growth_options& options)
{
  internal::require_size(distance.size(), surface.number_of_triangles(), "distance", "triangles");
  internal::require_valid(options);
  const internal::Submesh submesh = internal::surface_connectivity(surface);
  return internal::Chart_growth(surface, submesh, distance,
                                internal::largest_distances(submesh, distance, options), options)
      .run()
      .segmentation();
}

ATLAS_INLINE Segmentation Feature_segmentation::segment(const Surface& surface,
                                                        const Execution& execution) const
{
  internal::require_valid(*this);
  const internal::Submesh submesh = internal::surface_connectivity(surface);
  const std::vector<std::uint8_t> is_feature = internal::detect_features(surface, submesh, features);
  if (!execution.proceed(0.4))
    return internal::one_chart_of(surface);
  const internal::Feature_distance field = internal::distance_to_features(surface, submesh, is_feature);
  if (!execution.proceed(0.7))
    return internal::one_chart_of(surface);
  const std::vector<double> largest = internal::largest_distances(submesh, field.triangle, growth);
  internal::Chart_boundaries boundaries =
      internal::Chart_growth(surface, submesh, field.triangle, largest, growth).run();
  const double least_area = min_chart_area * internal::area_of_triangles(surface);
  internal::Small_chart_absorber(surface, submesh, boundaries)
      .run({min_chart_triangles, least_area, max_charts});
  Segmentation segmentation = boundaries.segmentation();
  if (sock_rule == Sock_rule::parts)
    internal::cut_socks(surface, sock_ratio, segmentation, execution);
  else
    internal::cut_socks_from_seeds(surface, sock_ratio, field.triangle, segmentation, execution);
  execution.proceed(1);
  return segmentation;
}

} // namespace Atlas

#endif
