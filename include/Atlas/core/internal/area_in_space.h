// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_AREA_IN_SPACE_H
#define ATLAS_CORE_INTERNAL_AREA_IN_SPACE_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Atlas::internal {

/// Whether a triangle in space has an area, beyond what the rounding of its coordinates makes of three points
/// on a line: its height is at least 8 units in the last place of its largest coordinate.
inline bool has_area(const Point_3& p, const Point_3& q, const Point_3& r)
{
  const double twice_area = std::sqrt(CGAL::cross_product(q - p, r - p).squared_length());
  const double longest =
      std::max({(q - p).squared_length(), (r - p).squared_length(), (r - q).squared_length()});
  double largest = 0;
  for (const Point_3* s : {&p, &q, &r})
    largest = std::max({largest, std::abs(s->x()), std::abs(s->y()), std::abs(s->z())});
  if (!(twice_area > 8 * std::numeric_limits<double>::epsilon() * largest * std::sqrt(longest)))
    return false;
  return twice_area > 1e-9 * longest || !CGAL::collinear(p, q, r);
}

} // namespace Atlas::internal

#endif
