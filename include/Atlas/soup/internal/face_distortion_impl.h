// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_FACE_DISTORTION_IMPL_H
#define ATLAS_SOUP_INTERNAL_FACE_DISTORTION_IMPL_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/soup/internal/face_distortion.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Atlas {

ATLAS_INLINE Soup_distortion measure_distortion(const Polygon_soup& soup)
{
  internal::require(soup.uv.size() == soup.number_of_corners(), "soup", "must have a coordinate per corner");
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  Soup_distortion result;
  double area_3d = 0, area_uv = 0;
  for (std::size_t t = 0; t < surface.number_of_triangles(); ++t) {
    std::array<Point_3, 3> p;
    std::array<Point_2, 3> q;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = surface.points[surface.triangles[t][i]];
      q[i] = soup.uv[surface.corner[3 * t + i]];
    }
    const Triangle_distortion d = triangle_distortion(p, q);
    if (!d.is_measurable() || !std::isfinite(d.area_3d))
      continue;
    area_3d += d.area_3d;
    area_uv += d.area_uv;
    result.face.push_back(surface.face[t]);
    result.weight.push_back(d.area_3d);
    result.largest.push_back(d.largest);
    result.smallest.push_back(d.smallest);
  }
  const double scale = std::sqrt(area_uv / area_3d);
  for (std::size_t i = 0; i < result.face.size(); ++i) {
    result.weight[i] /= area_3d;
    result.largest[i] *= scale;
    result.smallest[i] *= scale;
  }
  return result;
}

ATLAS_INLINE std::vector<double> face_stretch(const Soup_distortion& distortion, std::size_t number_of_faces)
{
  std::vector<double> result(number_of_faces, NAN);
  for (std::size_t i = 0; i < distortion.face.size(); ++i) {
    double& value = result[distortion.face[i]];
    value = std::fmax(value, std::max(distortion.largest[i], 1 / distortion.smallest[i]));
  }
  return result;
}

namespace internal {

/// Values outside of [low, high] count in the first or last bin.
inline Histogram make_histogram(const std::vector<double>& values, const std::vector<double>& weights,
                                double low, double high, std::size_t bins)
{
  Histogram result{low, high, std::vector<double>(bins, 0)};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = (values[i] - low) / (high - low) * static_cast<double>(bins);
    result.share[static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(bins) - 1))] += weights[i];
  }
  return result;
}

} // namespace internal

ATLAS_INLINE Histogram angle_histogram(const Soup_distortion& distortion)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < distortion.face.size(); ++i)
    values.push_back(2 * std::atan(distortion.largest[i] / distortion.smallest[i]) * 180 / CGAL_PI - 90);
  return internal::make_histogram(values, distortion.weight, 0, 45, 45);
}

ATLAS_INLINE Histogram area_histogram(const Soup_distortion& distortion)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < distortion.face.size(); ++i)
    values.push_back(-std::log2(distortion.largest[i] * distortion.smallest[i]));
  return internal::make_histogram(values, distortion.weight, -2, 2, 64);
}

} // namespace Atlas

#endif
