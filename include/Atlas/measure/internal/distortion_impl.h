// SPDX-License-Identifier: MIT
#ifndef ATLAS_MEASURE_INTERNAL_DISTORTION_IMPL_H
#define ATLAS_MEASURE_INTERNAL_DISTORTION_IMPL_H

#include <Atlas/measure/distortion.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace Atlas {

namespace internal {

/// The first fundamental form of the affine map from the plane to space: a = S_s^2, b = S_s S_t, c = S_t^2.
struct First_fundamental_form
{
  double area_3d, area_uv; ///< a, b and c are only there if both are positive
  double a = 0, b = 0, c = 0;

  First_fundamental_form(const std::array<Point_3, 3>& p, const std::array<Point_2, 3>& q)
  {
    const Vector_3 e1 = p[1] - p[0], e2 = p[2] - p[0];
    const Vector_2 d1 = q[1] - q[0], d2 = q[2] - q[0];
    const double determinant = d1.x() * d2.y() - d1.y() * d2.x();
    area_3d = std::sqrt(CGAL::cross_product(e1, e2).squared_length()) / 2;
    area_uv = std::abs(determinant) / 2;
    if (!has_area())
      return;
    const Vector_3 s = (d2.y() * e1 - d1.y() * e2) / determinant;
    const Vector_3 t = (d1.x() * e2 - d2.x() * e1) / determinant;
    a = s * s;
    b = s * t;
    c = t * t;
  }

  bool has_area() const { return area_3d != 0 && area_uv != 0; }
};

} // namespace internal

ATLAS_INLINE Triangle_distortion triangle_distortion(const std::array<Point_3, 3>& p,
                                                     const std::array<Point_2, 3>& q)
{
  const internal::First_fundamental_form form(p, q);
  Triangle_distortion result;
  result.area_3d = form.area_3d;
  result.area_uv = form.area_uv;
  if (!form.has_area())
    return result;
  const auto [a, b, c] = std::array{form.a, form.b, form.c};
  result.largest = std::sqrt((a + c + std::hypot(a - c, 2 * b)) / 2);
  result.smallest = result.area_3d / result.area_uv / result.largest;
  return result;
}

namespace internal {

/// The extremes and quantiles of ratios of area, given with the weights of their triangles.
inline void summarize_areas(std::vector<std::pair<double, double>> ratios, Distortion& d)
{
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
}

/// Of a triangle with these singular values, 1 for an isometry.
inline double symmetric_dirichlet(double s1, double s2)
{
  return (s1 * s1 + s2 * s2 + 1 / (s1 * s1) + 1 / (s2 * s2)) / 4;
}

/// How many triangles can be measured, and their areas.
inline Distortion sums_of_areas(std::span<const Triangle_distortion> measured)
{
  Distortion d;
  for (const Triangle_distortion& t : measured)
    if (t.is_measurable()) {
      ++d.triangles;
      d.area_3d += t.area_3d;
      d.area_uv += t.area_uv;
    }
  return d;
}

} // namespace internal

ATLAS_INLINE double stretch_quantile(std::span<const Triangle_distortion> measured, double share)
{
  // Sums of areas are rounded; a share of 1 is all of them.
  constexpr double rounding = 1e-12;
  const Distortion areas = internal::sums_of_areas(measured);
  const double g = std::sqrt(areas.area_uv / areas.area_3d);
  std::vector<std::pair<double, double>> stretch; // with the area in space
  stretch.reserve(areas.triangles);
  for (const Triangle_distortion& t : measured)
    if (t.is_measurable())
      stretch.emplace_back(std::max(g * t.largest, 1 / (g * t.smallest)), t.area_3d);
  // From the largest on; only the few that are left out have to be in order.
  std::make_heap(stretch.begin(), stretch.end());
  double rest = (1 - share + rounding) * areas.area_3d;
  while (!stretch.empty() && stretch.front().second <= rest && share < 1) {
    rest -= stretch.front().second;
    std::pop_heap(stretch.begin(), stretch.end());
    stretch.pop_back();
  }
  return stretch.empty() ? 1 : std::max(1.0, stretch.front().first);
}

ATLAS_INLINE Distortion summarize_distortion(std::span<const Triangle_distortion> measured)
{
  Distortion d = internal::sums_of_areas(measured);
  if (d.triangles == 0)
    return d;
  d.stretch_p99 = stretch_quantile(measured, 0.99);
  const double g2 = d.area_uv / d.area_3d, g = std::sqrt(g2);
  double l2 = 0, qc = 0, angle = 0, area = 0, dirichlet = 0;
  std::vector<std::pair<double, double>> ratios; // (r, weight)
  ratios.reserve(d.triangles);
  d.linf_stretch = 0;
  for (const Triangle_distortion& t : measured) {
    if (!t.is_measurable())
      continue;
    const double w = t.area_3d / d.area_3d, s1 = g * t.largest, s2 = g * t.smallest;
    const double r = t.area_uv / t.area_3d / g2, energy = internal::symmetric_dirichlet(s1, s2);
    l2 += w * (s1 * s1 + s2 * s2) / 2;
    qc += w * s1 / s2;
    angle += w * (2 * std::atan(s1 / s2) * 180 / CGAL_PI - 90);
    area += w * std::max(r, 1 / r);
    dirichlet += w * energy;
    d.linf_stretch = std::max(d.linf_stretch, s1);
    d.stretch_max = std::max({d.stretch_max, s1, 1 / s2});
    d.quasi_conformal_max = std::max(d.quasi_conformal_max, s1 / s2);
    d.symmetric_dirichlet_max = std::max(d.symmetric_dirichlet_max, energy);
    ratios.emplace_back(r, w);
  }
  d.l2_stretch = std::sqrt(l2);
  d.quasi_conformal_mean = qc;
  d.angle_mean = angle;
  d.area_mean = area;
  d.symmetric_dirichlet_mean = dirichlet;

  internal::summarize_areas(std::move(ratios), d);
  return d;
}

ATLAS_INLINE std::vector<Triangle_distortion> triangle_distortions(const Chart& chart)
{
  std::vector<Triangle_distortion> result;
  result.reserve(chart.number_of_triangles());
  for (const auto& [a, b, c] : chart.triangles)
    result.push_back(triangle_distortion({chart.points[a], chart.points[b], chart.points[c]},
                                         {chart.uv[a], chart.uv[b], chart.uv[c]}));
  return result;
}

ATLAS_INLINE std::vector<Triangle_distortion> triangle_distortions_at_own_scale(const Chart& chart,
                                                                                std::span<const Point_2> uv)
{
  std::vector<Triangle_distortion> result;
  result.reserve(chart.number_of_triangles());
  double in_space = 0, in_plane = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    result.push_back(
        triangle_distortion({chart.points[a], chart.points[b], chart.points[c]}, {uv[a], uv[b], uv[c]}));
    in_space += result.back().area_3d;
    in_plane += result.back().area_uv;
  }
  if (!(in_space > 0 && in_plane > 0))
    return result;
  const double scale = std::sqrt(in_space / in_plane);
  for (Triangle_distortion& t : result) {
    t.area_uv *= scale * scale;
    t.largest /= scale;
    t.smallest /= scale;
  }
  return result;
}

// The gradients of u and v are the dual basis of S_s and S_t: the two angles make up a straight one.
ATLAS_INLINE double gradient_angle(const std::array<Point_3, 3>& p, const std::array<Point_2, 3>& q)
{
  const internal::First_fundamental_form form(p, q);
  if (!form.has_area())
    return std::numeric_limits<double>::quiet_NaN();
  return std::acos(std::clamp(-form.b / std::sqrt(form.a * form.c), -1.0, 1.0)) * 180 / CGAL_PI;
}

ATLAS_INLINE std::vector<double> gradient_angles(const Chart& chart)
{
  std::vector<double> result;
  result.reserve(chart.number_of_triangles());
  for (const auto& [a, b, c] : chart.triangles)
    result.push_back(gradient_angle({chart.points[a], chart.points[b], chart.points[c]},
                                    {chart.uv[a], chart.uv[b], chart.uv[c]}));
  return result;
}

ATLAS_INLINE Distortion measure_distortion(const Chart& chart)
{
  return summarize_distortion(triangle_distortions(chart));
}

ATLAS_INLINE Distortion measure_distortion(std::span<const Chart> charts)
{
  std::vector<Triangle_distortion> all;
  for (const Chart& chart : charts) {
    const std::vector<Triangle_distortion> part = triangle_distortions(chart);
    all.insert(all.end(), part.begin(), part.end());
  }
  return summarize_distortion(all);
}

ATLAS_INLINE double value(const Distortion& d, Distortion_measure measure)
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

namespace internal {

/// The same as `summarize_distortion()` finds, without what takes longer.
inline double symmetric_dirichlet_mean(std::span<const Triangle_distortion> measured)
{
  const Distortion areas = sums_of_areas(measured);
  if (areas.triangles == 0)
    return std::numeric_limits<double>::infinity();
  const double g = std::sqrt(areas.area_uv / areas.area_3d);
  double sum = 0;
  for (const Triangle_distortion& t : measured)
    if (t.is_measurable())
      sum += t.area_3d / areas.area_3d * symmetric_dirichlet(g * t.largest, g * t.smallest);
  return sum;
}

} // namespace internal

ATLAS_INLINE double used_share(std::span<const Triangle_distortion> measured, const Distortion_bound& bound)
{
  const auto share = [](double figure, double max) {
    if (figure <= max && max <= 1)
      return 1.0;
    return std::isinf(max) ? 0 : std::max(0.0, figure - 1) / (max - 1);
  };
  double result = 0;
  if (std::isfinite(bound.max))
    result = share(bound.measure == Distortion_measure::symmetric_dirichlet
                       ? internal::symmetric_dirichlet_mean(measured)
                       : value(summarize_distortion(measured), bound.measure),
                   bound.max);
  if (std::isfinite(bound.max_stretch))
    result = std::max(result, share(stretch_quantile(measured, bound.stretch_share), bound.max_stretch));
  return result;
}

} // namespace Atlas

#endif
