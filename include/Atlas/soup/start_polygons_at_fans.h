// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_START_POLYGONS_AT_FANS_H
#define ATLAS_SOUP_START_POLYGONS_AT_FANS_H

#include <Atlas/core/Surface.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <cstddef>

namespace Atlas {

/// \brief Turns the corners of each polygon so that it starts where the surface's fan of triangles does.
///
/// Readers see a polygon as the fan from its first corner. A concave or bent polygon has one-to-one
/// coordinates on the fan that `build_surface()` chose for it, and need not have them on another one. Most
/// polygons stay as they are. Linear.
///
/// \pre `surface` was built of `soup`
inline void start_polygons_at_fans(const Surface& surface, Polygon_soup& soup)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const std::size_t f = surface.face[t];
    if (t > 0 && surface.face[t - 1] == f)
      continue;
    const auto rotate = [&](auto& values) {
      if (values.size() == soup.number_of_corners())
        std::rotate(values.begin() + static_cast<std::ptrdiff_t>(soup.first[f]),
                    values.begin() + static_cast<std::ptrdiff_t>(surface.corner[3 * t]),
                    values.begin() + static_cast<std::ptrdiff_t>(soup.first[f + 1]));
    };
    rotate(soup.uv);
    rotate(soup.old_uv);
    rotate(soup.corner_normal);
    rotate(soup.vertices);
  }
}

} // namespace Atlas

#endif
