// SPDX-License-Identifier: MIT
#ifndef ATLAS_MEASURE_DISTORTION_H
#define ATLAS_MEASURE_DISTORTION_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/library.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace Atlas {

/// The area of the surface, in squared units of the model.
double area_3d(const Surface& surface);

/// The area of the chart in space.
double area_3d(const Chart& chart);

/// The area of the flattened chart: flipped triangles count negative.
double area_uv(const Chart& chart);

/// The length of all seams in units of the model, each edge once: edges with a triangle on both sides that
/// are not glued. The border of the surface is no seam.
double seam_length(const Surface& surface, const Segmentation& segmentation);

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
Triangle_distortion triangle_distortion(const std::array<Point_3, 3>& p, const std::array<Point_2, 3>& q);

/// The angle between the gradients of u and v in a triangle, in degrees, in [0, 180]; 90 where the map is
/// conformal; not a number for a triangle without area in space or in the plane. What figure 9 of the LSCM
/// paper shows. It depends on how the plane is turned, unlike `Distortion::angle_mean`, which is the most
/// that it can be off.
double gradient_angle(const std::array<Point_3, 3>& p, const std::array<Point_2, 3>& q);

/// The same for every triangle of a flattened chart.
std::vector<double> gradient_angles(const Chart& chart);

/// \brief Distortion of a set of triangles, weighted by their area in space, up to one scale for all of them.
///
/// With g = sqrt(area in the plane / area in space), s1 = g Gamma and s2 = g gamma of each triangle.
/// Triangles without area in space or in the plane are left out.
struct Distortion
{
  std::size_t triangles = 0;           ///< measured
  double area_3d = 0;                  ///< of the measured triangles
  double area_uv = 0;                  ///< of the measured triangles
  double l2_stretch = 1;               ///< sqrt(mean (s1^2 + s2^2)/2), >= 1; Sander et al. 2001
  double linf_stretch = 1;             ///< max s1; Sander et al. 2001
  double stretch_p99 = 1;              ///< 99 % quantile of max(s1, 1/s2)
  double stretch_max = 1;              ///< largest max(s1, 1/s2)
  double quasi_conformal_mean = 1;     ///< mean s1/s2; 1 is conformal
  double quasi_conformal_max = 1;      ///< the largest of a triangle
  double angle_mean = 0;               ///< mean 2 atan(s1/s2) - 90 degrees: the largest loss of a right angle
  double area_mean = 1;                ///< mean max(r, 1/r), r = 1/(s1 s2)
  double area_min = 1;                 ///< least r
  double area_max = 1;                 ///< largest r
  double area_p1 = 1;                  ///< 1 % quantile of r
  double area_p5 = 1;                  ///< 5 % quantile of r
  double area_p95 = 1;                 ///< 95 % quantile of r
  double area_p99 = 1;                 ///< 99 % quantile of r
  double symmetric_dirichlet_mean = 1; ///< mean (s1^2 + s2^2 + 1/s1^2 + 1/s2^2)/4; 1 is isometric
  double symmetric_dirichlet_max = 1;  ///< the largest of a triangle
};

/// Summarises measured triangles. O(n log n) for the quantiles.
Distortion summarize_distortion(std::span<const Triangle_distortion> measured);

/// Measures every triangle of a flattened chart.
std::vector<Triangle_distortion> triangle_distortions(const Chart& chart);

/// Measures every triangle of a chart that is scaled so that its area in the plane is its area in space.
/// \param uv  per vertex of the chart, the coordinates to measure
std::vector<Triangle_distortion> triangle_distortions_at_own_scale(const Chart& chart,
                                                                   std::span<const Point_2> uv);

/// Distortion of one flattened chart, up to its own scale.
Distortion measure_distortion(const Chart& chart);

/// Distortion of several flattened charts, up to one scale for all of them: that of the atlas.
Distortion measure_distortion(std::span<const Chart> charts);

/// The named figure; infinite where nothing could be measured.
double value(const Distortion& d, Distortion_measure measure);

/// The least number that max(s1, 1/s2) of the triangles exceeds on at most 1 - `share` of their area in
/// space. Scaled like `Distortion`; 1 where nothing could be measured. O(n log n).
/// \param share  in [0, 1]; 1 gives the maximum
double stretch_quantile(std::span<const Triangle_distortion> measured, double share);

/// How much of what a bound allows is used: the distortion beyond 1 over that of the bound, of its two parts
/// the one that uses more. At most 1 keeps the bound. O(n log n).
double used_share(std::span<const Triangle_distortion> measured, const Distortion_bound& bound);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/measure/internal/area_impl.h>
#include <Atlas/measure/internal/distortion_impl.h>
#endif

#endif
