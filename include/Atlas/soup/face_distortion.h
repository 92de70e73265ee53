// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_FACE_DISTORTION_H
#define ATLAS_SOUP_FACE_DISTORTION_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas {

/// \brief Distortion of every triangle of a mesh with coordinates, up to one scale for all of them.
struct Soup_distortion
{
  std::vector<Index> face;      ///< per triangle that can be measured: its face
  std::vector<double> weight;   ///< per triangle: its share of the area in space
  std::vector<double> largest;  ///< per triangle: s1, the largest singular value from plane to space
  std::vector<double> smallest; ///< per triangle: s2
};

/// Measures the coordinates of a soup; triangles without area in space or in the plane are left out.
inline Soup_distortion measure_distortion(const Polygon_soup& soup)
{
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

/// \brief Per face of a soup how far it is from its true shape and size: the largest of s1 and 1/s2 over its
/// triangles; 1 is isometric, NaN unknown.
inline std::vector<double> face_stretch(const Soup_distortion& distortion, std::size_t number_of_faces)
{
  std::vector<double> result(number_of_faces, NAN);
  for (std::size_t i = 0; i < distortion.face.size(); ++i) {
    double& value = result[distortion.face[i]];
    value = std::fmax(value, std::max(distortion.largest[i], 1 / distortion.smallest[i]));
  }
  return result;
}

/// \brief Shares of the area of the surface in bins of equal width; values outside count in the first or last
/// bin.
struct Histogram
{
  double low = 0, high = 1;
  std::vector<double> share; ///< per bin, sums up to 1
};

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

/// By how many degrees right angles of the surface are off on the page at worst, 2 atan(s1/s2) - 90, in [0,
/// 45].
inline Histogram angle_histogram(const Soup_distortion& d)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < d.face.size(); ++i)
    values.push_back(2 * std::atan(d.largest[i] / d.smallest[i]) * 180 / CGAL_PI - 90);
  return make_histogram(values, d.weight, 0, 45, 45);
}

/// The binary logarithm of the area on the page over its fair share, in [-2, 2].
inline Histogram area_histogram(const Soup_distortion& d)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < d.face.size(); ++i)
    values.push_back(-std::log2(d.largest[i] * d.smallest[i]));
  return make_histogram(values, d.weight, -2, 2, 64);
}

} // namespace Atlas

#endif
