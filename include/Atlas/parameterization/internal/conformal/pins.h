// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_PINS_H
#define ATLAS_PARAMETERIZATION_INTERNAL_CONFORMAL_PINS_H

#include <Atlas/parameterization/LSCM_traits.h>
#include <Atlas/parameterization/internal/geometry/border.h>

#include <span>
#include <vector>

namespace Atlas::internal {

/// Two far-apart border vertices, as far from each other in the plane as in space.
inline std::vector<LSCM_pin> default_pins(const Chart_geometry& geometry)
{
  const auto [first, second] = far_apart_vertices(geometry);
  double distance = geometry.distance(first, second);
  if (!(distance > 0))
    distance = 1;
  return {{first, Point_2(0, 0)}, {second, Point_2(geometry.to_model(distance), 0)}};
}

/// The image of a pin in the unit of the geometry.
inline Complex image(const Chart_geometry& geometry, const LSCM_pin& pin)
{
  return {geometry.from_model(pin.uv.x()), geometry.from_model(pin.uv.y())};
}

/// The pins where they belong, everything else at the origin.
inline std::vector<Complex> pinned(const Chart_geometry& geometry, std::span<const LSCM_pin> pins)
{
  std::vector<Complex> u(geometry.number_of_vertices());
  for (const LSCM_pin& pin : pins)
    u[pin.vertex] = image(geometry, pin);
  return u;
}

} // namespace Atlas::internal

#endif
