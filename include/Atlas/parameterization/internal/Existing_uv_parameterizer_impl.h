// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_EXISTING_UV_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_EXISTING_UV_PARAMETERIZER_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Existing_uv_parameterizer.h>
#include <Atlas/parameterization/internal/geometry/chart_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace Atlas {

ATLAS_INLINE Existing_uv_parameterizer::Existing_uv_parameterizer(const Surface& surface,
                                                                  std::span<const Point_2> corner_uv,
                                                                  Any_parameterizer fallback)
    : surface_(&surface), corner_uv_(corner_uv), fallback_(std::move(fallback))
{
  internal::require(std::all_of(surface.corner.begin(), surface.corner.end(),
                                [&](Index corner) { return corner < corner_uv.size(); }),
                    "corner_uv", "must have coordinates for each corner of the surface's input");
}

ATLAS_INLINE Chart_status Existing_uv_parameterizer::parameterize(Chart& chart,
                                                                  const Execution& execution) const
{
  internal::check_chart(chart);
  const std::size_t triangles = surface_->number_of_triangles();
  internal::require(
      chart.source.size() == chart.number_of_triangles() &&
          std::all_of(chart.source.begin(), chart.source.end(), [=](Index t) { return t < triangles; }),
      "chart", "must be one of the surface that the coordinates belong to");
  const double area = take(chart) ? area_uv(chart) : 0;
  if (area == 0)
    return fallback_.parameterize(chart, execution);
  if (area < 0)
    for (Point_2& p : chart.uv)
      p = Point_2(-p.x(), p.y());
  return Chart_status::valid;
}

/// \return `false` if a corner has no finite coordinates
ATLAS_INLINE bool Existing_uv_parameterizer::take(Chart& chart) const
{
  chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
  for (std::size_t t = 0; t < chart.triangles.size(); ++t)
    for (Index i = 0; i < 3; ++i) {
      const Point_2& p = corner_uv_[surface_->corner[3 * chart.source[t] + i]];
      if (!std::isfinite(p.x()) || !std::isfinite(p.y()))
        return false;
      chart.uv[chart.triangles[t][i]] = p;
    }
  return true;
}

} // namespace Atlas

#endif
