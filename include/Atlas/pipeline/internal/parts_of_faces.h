// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_PARTS_OF_FACES_H
#define ATLAS_PIPELINE_INTERNAL_PARTS_OF_FACES_H

#include <Atlas/core/Surface.h>

#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// The part of a face is that of its first triangle. The triangles of a face follow each other.
inline std::vector<Index> whole_face_parts(const Surface& surface, const std::vector<Index>& source,
                                           std::vector<Index> parts)
{
  for (std::size_t i = 1; i < source.size(); ++i)
    if (surface.face[source[i]] == surface.face[source[i - 1]])
      parts[i] = parts[i - 1];
  return parts;
}

/// Two parts with about as many triangles each.
inline std::vector<Index> halves(const Surface& surface, const std::vector<Index>& source)
{
  std::vector<Index> parts(source.size(), 0);
  const Index last_of_first = surface.face[source[(source.size() - 1) / 2]];
  for (std::size_t i = 0; i < source.size(); ++i)
    parts[i] = surface.face[source[i]] > last_of_first ||
               (last_of_first == surface.face[source.back()] && surface.face[source[i]] == last_of_first);
  return parts;
}

} // namespace Atlas::internal

#endif
