// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_CONSTRAIN_HARD_EDGES_H
#define ATLAS_CORE_CONSTRAIN_HARD_EDGES_H

#include <Atlas/core/Surface.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace Atlas {

/// \brief Makes seams of all edges at which the normals of the two triangles turn by more than an angle.
///
/// \param degrees  in (0, 180]; a cube's edges have 90
///
/// Diagonals of polygons, edges that must not be seams, and edges of triangles without area are left alone.
/// Linear.
inline void constrain_hard_edges(Surface& surface, double degrees)
{
  CGAL_precondition_msg(degrees > 0 && degrees <= 180, "the hard angle must be in (0, 180] degrees");
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

} // namespace Atlas

#endif
