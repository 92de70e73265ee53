// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_CONSTRAIN_EDGES_IMPL_H
#define ATLAS_CORE_INTERNAL_CONSTRAIN_EDGES_IMPL_H

#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/extract_charts.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace Atlas {

ATLAS_INLINE void constrain_hard_edges(Surface& surface, double degrees)
{
  internal::require(degrees > 0 && degrees <= 180, "hard_angle", "must be in (0, 180] degrees");
  surface.constraint.resize(surface.opposite.size(), Edge_constraint::none);
  const double least_cosine = std::cos(degrees * std::numbers::pi / 180);
  const auto direction = [&](Index h) { // of about unit length, at any scale of the model
    const Vector_3 v = surface.point(next_halfedge(h)) - surface.point(h);
    return v / std::max({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
  };
  const auto normal = [&](Index t) {
    const Vector_3 n = CGAL::cross_product(direction(3 * t), direction(3 * t + 1));
    return n / std::sqrt(n.squared_length()); // not a number without an area: no comparison holds
  };
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (const Index o = surface.opposite[h]; o != no_index && h < o && !surface.is_diagonal(h) &&
                                             surface.constraint[h] == Edge_constraint::none &&
                                             normal(h / 3) * normal(o / 3) < least_cosine)
      surface.constraint[h] = surface.constraint[o] = Edge_constraint::seam;
}

ATLAS_INLINE void constrain_to_uv(Surface& surface, std::span<const Point_2> uv)
{
  const Segmentation charts = charts_of_uv(surface, uv);
  surface.patch = charts.chart;
  surface.constraint.assign(surface.opposite.size(), Edge_constraint::none);
  for (Index h = 0; h < surface.constraint.size(); ++h)
    if (charts.cut[h])
      surface.constraint[h] = Edge_constraint::seam;
  for (Index t = 0; t < surface.patch.size(); ++t) {
    const auto at = [&](Index i) { return uv[surface.corner[3 * t + i]]; };
    if (charts.chart[t] != no_index && CGAL::orientation(at(0), at(1), at(2)) == CGAL::RIGHT_TURN)
      surface.patch[t] += charts.number_of_charts;
  }
}

} // namespace Atlas

#endif
