// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_NORMALIZE_AREA_H
#define ATLAS_PARAMETERIZATION_INTERNAL_GEOMETRY_NORMALIZE_AREA_H

#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <cmath>
#include <span>
#include <vector>

namespace Atlas::internal {

/// The sum of the absolute areas of the triangles in the plane.
inline double area_in_plane(const Chart& chart, std::span<const Complex> u)
{
  double sum = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    const Complex p = u[b] - u[a], q = u[c] - u[a];
    sum += std::abs(p.real() * q.imag() - p.imag() * q.real());
  }
  return sum / 2;
}

/// The area of the chart in space, in the unit of the geometry. Triangles without area count as the very thin
/// ones that they are flattened as, so that a chart of such triangles keeps its length.
inline double area_in_space(const Chart_geometry& geometry)
{
  double sum = 0;
  for (Index t = 0; t < geometry.number_of_triangles(); ++t)
    if (!geometry.is_point(t))
      sum += geometry.planar(t).double_area;
  return sum / 2;
}

/// What to multiply u by, so that the chart has the same area in the plane as in space. A chart that is a
/// single point remains one.
inline double density_correction(const Chart_geometry& geometry, std::span<const Complex> u)
{
  const double area = area_in_space(geometry);
  const double scale = std::sqrt(area / area_in_plane(geometry.chart(), u));
  return area > 0 ? std::isfinite(scale) && scale > 0 ? scale : 1 : 0;
}

/// chart.uv in the unit of the geometry: the other way round.
inline std::vector<Complex> coordinates_of(const Chart_geometry& geometry)
{
  std::vector<Complex> u;
  u.reserve(geometry.number_of_vertices());
  for (const Point_2& p : geometry.chart().uv)
    u.emplace_back(geometry.from_model(p.x()), geometry.from_model(p.y()));
  return u;
}

/// chart.uv = scale * u, in the unit of the model.
inline void store_coordinates(const Chart_geometry& geometry, std::span<const Complex> u, double scale,
                              Chart& chart)
{
  chart.uv.resize(u.size());
  for (std::size_t v = 0; v < u.size(); ++v)
    chart.uv[v] = Point_2(geometry.to_model(scale * u[v].real()), geometry.to_model(scale * u[v].imag()));
}

} // namespace Atlas::internal

#endif
