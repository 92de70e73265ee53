// SPDX-License-Identifier: MIT
#ifndef ATLAS_EXAMPLE_STAND_UP_H
#define ATLAS_EXAMPLE_STAND_UP_H

#include <Atlas/core/Kernel.h>

#include <string>
#include <vector>

/// Turns the model so that the named axis, as "z" or "-y", points up.
inline std::vector<Atlas::Point_3> stand_up(std::vector<Atlas::Point_3> points, const std::string& up)
{
  const int axis = up.back() - 'x';
  const double sign = up.front() == '-' ? -1 : 1;
  for (Atlas::Point_3& p : points)
    p = Atlas::Point_3(p[(axis + 2) % 3], sign * p[axis], sign * p[(axis + 1) % 3]);
  return points;
}

#endif
