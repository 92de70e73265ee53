// SPDX-License-Identifier: MIT
// Headers alone: there is no library to link.
#include <Atlas/core/build_surface.h>
#include <Atlas/validation/certify.h>

#include <vector>

int main()
{
  const std::vector<Atlas::Point_3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Atlas::Surface surface = Atlas::build_surface(points, {0, 4}, {0, 1, 2, 3});
  const std::vector<Atlas::Point_2> uv = {{.25, .25}, {.75, .25}, {.75, .75}, {.25, .75}};
  return Atlas::certify(surface, uv).is_valid() ? 0 : 1;
}
