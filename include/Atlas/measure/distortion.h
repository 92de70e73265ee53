// SPDX-License-Identifier: MIT
#ifndef ATLAS_MEASURE_DISTORTION_H
#define ATLAS_MEASURE_DISTORTION_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Distortion_bound.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief How the affine map from the plane to space stretches one triangle.
///
/// With S_s, S_t the partial derivatives of that map, `largest` and `smallest` are its singular values
/// (Gamma and gamma of Sander et al. 2001).
struct Triangle_distortion
{
  double area_3d = 0;  ///< in space
  double area_uv = 0;  ///< in the plane, without sign
  double largest = 0;  ///< Gamma
  double smallest = 0; ///< gamma

  /// Whether the triangle has area both in space and in the plane; only such triangles can be measured.
  bool is_measurable() const { return area_3d > 0 && area_uv > 0 && std::isfinite(largest) && smallest > 0; }
};

/// Measures a triangle with positions `p` and coordinates `q`.
inline Triangle_distortion triangle_distortion(const std::array<Point_3, 3>& p,
                                               const std::array<Point_2, 3>& q)
{
  Triangle_distortion result;
  const Vector_3 e1 = p[1] - p[0], e2 = p[2] - p[0];
  const Vector_2 d1 = q[1] - q[0], d2 = q[2] - q[0];
  const double determinant = d1.x() * d2.y() - d1.y() * d2.x();
  result.area_3d = std::sqrt(CGAL::cross_product(e1, e2).squared_length()) / 2;
  result.area_uv = std::abs(determinant) / 2;
  if (determinant == 0 || result.area_3d == 0)
    return result;
  const Vector_3 s = (d2.y() * e1 - d1.y() * e2) / determinant;
  const Vector_3 t = (d1.x() * e2 - d2.x() * e1) / determinant;
  const double a = s * s, b = s * t, c = t * t;
  result.largest = std::sqrt((a + c + std::hypot(a - c, 2 * b)) / 2);
  result.smallest = result.area_3d / result.area_uv / result.largest;
  return result;
}

/// \brief Distortion of a set of triangles, weighted by their area in space, up to one scale for all of them.
///
/// With g = sqrt(area in the plane / area in space), s1 = g Gamma and s2 = g gamma of each triangle.
/// Triangles without area in space or in the plane are left out.
struct Distortion
{
  std::size_t triangles = 0;       ///< measured
  double area_3d = 0;              ///< of the measured triangles
  double area_uv = 0;              ///< of the measured triangles
  double l2_stretch = 1;           ///< sqrt(mean (s1^2 + s2^2)/2), >= 1; Sander et al. 2001
  double linf_stretch = 1;         ///< max s1; Sander et al. 2001
  double quasi_conformal_mean = 1; ///< mean s1/s2; 1 is conformal
  double quasi_conformal_max = 1;
  double angle_mean = 0;               ///< mean 2 atan(s1/s2) - 90 degrees: the largest loss of a right angle
  double area_mean = 1;                ///< mean max(r, 1/r), r = 1/(s1 s2)
  double area_min = 1;                 ///< least r
  double area_max = 1;                 ///< largest r
  double area_p1 = 1;                  ///< 1 % quantile of r
  double area_p5 = 1;                  ///< 5 % quantile of r
  double area_p95 = 1;                 ///< 95 % quantile of r
  double area_p99 = 1;                 ///< 99 % quantile of r
  double symmetric_dirichlet_mean = 1; ///< mean (s1^2 + s2^2 + 1/s1^2 + 1/s2^2)/4; 1 is isometric
  double symmetric_dirichlet_max = 1;
};

/// Summarises measured triangles. O(n log n) for the quantiles.
inline Distortion summarize_distortion(std::span<const Triangle_distortion> measured)
{
  Distortion d;
  for (const Triangle_distortion& t : measured)
    if (t.is_measurable()) {
      ++d.triangles;
      d.area_3d += t.area_3d;
      d.area_uv += t.area_uv;
    }
  if (d.triangles == 0)
    return d;
  const double g2 = d.area_uv / d.area_3d, g = std::sqrt(g2);
  double l2 = 0, qc = 0, angle = 0, area = 0, dirichlet = 0;
  std::vector<std::pair<double, double>> ratios; // (r, weight)
  ratios.reserve(d.triangles);
  d.linf_stretch = 0;
  for (const Triangle_distortion& t : measured) {
    if (!t.is_measurable())
      continue;
    const double w = t.area_3d / d.area_3d, s1 = g * t.largest, s2 = g * t.smallest;
    const double r = t.area_uv / t.area_3d / g2,
                 energy = (s1 * s1 + s2 * s2 + 1 / (s1 * s1) + 1 / (s2 * s2)) / 4;
    l2 += w * (s1 * s1 + s2 * s2) / 2;
    qc += w * s1 / s2;
    angle += w * (2 * std::atan(s1 / s2) * 180 / CGAL_PI - 90);
    area += w * std::max(r, 1 / r);
    dirichlet += w * energy;
    d.linf_stretch = std::max(d.linf_stretch, s1);
    d.quasi_conformal_max = std::max(d.quasi_conformal_max, s1 / s2);
    d.symmetric_dirichlet_max = std::max(d.symmetric_dirichlet_max, energy);
    ratios.emplace_back(r, w);
  }
  d.l2_stretch = std::sqrt(l2);
  d.quasi_conformal_mean = qc;
  d.angle_mean = angle;
  d.area_mean = area;
  d.symmetric_dirichlet_mean = dirichlet;

  std::sort(ratios.begin(), ratios.end());
  d.area_min = ratios.front().first;
  d.area_max = ratios.back().first;
  const auto quantile = [&](double q) {
    double sum = 0;
    for (const auto& [r, w] : ratios)
      if ((sum += w) >= q)
        return r;
    return ratios.back().first;
  };
  d.area_p1 = quantile(0.01);
  d.area_p5 = quantile(0.05);
  d.area_p95 = quantile(0.95);
  d.area_p99 = quantile(0.99);
  return d;
}

/// Measures every triangle of a flattened chart.
inline std::vector<Triangle_distortion> triangle_distortions(const Chart& chart)
{
  std::vector<Triangle_distortion> result;
  result.reserve(chart.number_of_triangles());
  for (const auto& [a, b, c] : chart.triangles)
    result.push_back(triangle_distortion({chart.points[a], chart.points[b], chart.points[c]},
                                         {chart.uv[a], chart.uv[b], chart.uv[c]}));
  return result;
}

/// Distortion of one flattened chart, up to its own scale.
inline Distortion measure_distortion(const Chart& chart)
{
  return summarize_distortion(triangle_distortions(chart));
}

/// Distortion of several flattened charts, up to one scale for all of them: that of the atlas.
inline Distortion measure_distortion(std::span<const Chart> charts)
{
  std::vector<Triangle_distortion> all;
  for (const Chart& chart : charts) {
    const std::vector<Triangle_distortion> part = triangle_distortions(chart);
    all.insert(all.end(), part.begin(), part.end());
  }
  return summarize_distortion(all);
}

/// The named figure; infinite where nothing could be measured.
inline double value(const Distortion& d, Distortion_measure measure)
{
  if (d.triangles == 0)
    return std::numeric_limits<double>::infinity();
  switch (measure) {
  case Distortion_measure::symmetric_dirichlet:
    return d.symmetric_dirichlet_mean;
  case Distortion_measure::l2_stretch:
    return d.l2_stretch;
  case Distortion_measure::linf_stretch:
    return d.linf_stretch;
  case Distortion_measure::area_ratio:
    return d.area_max / d.area_min;
  case Distortion_measure::area_ratio_quantiles:
    return d.area_p99 / d.area_p1;
  case Distortion_measure::quasi_conformal:
    return d.quasi_conformal_mean;
  }
  return std::numeric_limits<double>::infinity();
}

} // namespace Atlas

#endif
