// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_TURN_FACE_H
#define ATLAS_SOUP_INTERNAL_TURN_FACE_H

#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <cstddef>

namespace Atlas::internal {

/// Turns a face around; its first corner stays the first.
inline void turn_face(Polygon_soup& soup, Index f)
{
  const auto turn = [&](auto& corners) {
    using Difference = std::ptrdiff_t;
    if (!corners.empty())
      std::reverse(corners.begin() + static_cast<Difference>(soup.first[f] + 1),
                   corners.begin() + static_cast<Difference>(soup.first[f + 1]));
  };
  turn(soup.vertices);
  turn(soup.uv);
  turn(soup.old_uv);
  turn(soup.corner_normal);
}

} // namespace Atlas::internal

#endif
