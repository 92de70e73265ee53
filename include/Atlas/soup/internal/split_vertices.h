// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_SPLIT_VERTICES_H
#define ATLAS_SOUP_INTERNAL_SPLIT_VERTICES_H

#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/index_uv.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// \brief A mesh whose attributes are per vertex, as formats and graphics cards want it.
struct Split_vertices
{
  std::vector<Index> original; ///< per new vertex: the vertex of the soup it came from (the cross-reference)
  std::vector<Index>
      corner; ///< per corner of the soup: its new vertex; `no_index` if its vertex does not exist
  std::vector<Point_2> uv;   ///< per new vertex; NaN where none; empty if the soup has none
  std::vector<Index> normal; ///< per new vertex: a normal of the soup or `no_index`; empty if it has none
  std::size_t number_of_vertices() const { return original.size(); }
};

/// \brief Gives every distinct combination of vertex, coordinates and normal one new vertex, in the order in
/// which the corners of the faces meet them. Vertices that no face uses are not kept. O(n) expected.
inline Split_vertices split_vertices(const Polygon_soup& soup)
{
  Split_vertices split;
  const Indexed_uv uv = index_uv(soup.uv);
  Row_table<2> table(soup.points.size());
  split.corner.reserve(soup.number_of_corners());
  for (std::size_t c = 0; c < soup.number_of_corners(); ++c) {
    const Index vertex = soup.vertices[c];
    if (vertex >= soup.points.size()) {
      split.corner.push_back(no_index);
      continue;
    }
    const Index t = uv.corner.empty() ? no_index : uv.corner[c];
    const Index n = soup.corner_normal.empty() ? no_index : soup.corner_normal[c];
    const Index v = table({vertex, std::uint64_t(t) << 32 | n});
    split.corner.push_back(v);
    if (v < split.original.size())
      continue;
    split.original.push_back(vertex);
    if (!soup.uv.empty())
      split.uv.push_back(t == no_index ? Point_2(NAN, NAN) : uv.points[t]);
    if (!soup.corner_normal.empty())
      split.normal.push_back(n);
  }
  return split;
}

} // namespace Atlas::internal

#endif
