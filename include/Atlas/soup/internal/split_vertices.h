// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_SPLIT_VERTICES_H
#define ATLAS_SOUP_INTERNAL_SPLIT_VERTICES_H

#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <numeric>
#include <utility>
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

/// What tells the corners of a vertex apart. Coordinates that are not finite are all the same.
struct Corner_key
{
  double u = INFINITY, v = INFINITY;
  Index normal = no_index;
  auto operator<=>(const Corner_key&) const = default;
};

inline Corner_key corner_key(const Polygon_soup& soup, std::size_t c)
{
  Corner_key key;
  if (!soup.uv.empty() && std::isfinite(soup.uv[c].x()) && std::isfinite(soup.uv[c].y())) {
    key.u = soup.uv[c].x();
    key.v = soup.uv[c].y();
  }
  if (!soup.corner_normal.empty())
    key.normal = soup.corner_normal[c];
  return key;
}

/// Per corner the first corner that has the same vertex, coordinates and normal; `no_index` where the vertex
/// does not exist.
inline std::vector<Index> first_equal_corners(const Polygon_soup& soup)
{
  std::vector<std::size_t> begin(soup.points.size() + 1, 0); // per vertex, in `corners`; one more closes
  for (const Index vertex : soup.vertices)
    if (vertex < soup.points.size())
      ++begin[vertex + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::pair<Corner_key, Index>> corners(begin.back()); // by vertex
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  for (std::size_t c = 0; c < soup.number_of_corners(); ++c)
    if (const Index vertex = soup.vertices[c]; vertex < soup.points.size())
      corners[end[vertex]++] = {corner_key(soup, c), static_cast<Index>(c)};
  std::vector<Index> result(soup.number_of_corners(), no_index);
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    std::sort(corners.begin() + begin[v], corners.begin() + begin[v + 1]);
    for (std::size_t i = begin[v]; i < begin[v + 1]; ++i)
      result[corners[i].second] = i > begin[v] && corners[i].first == corners[i - 1].first
                                      ? result[corners[i - 1].second]
                                      : corners[i].second;
  }
  return result;
}

/// \brief Gives every distinct combination of vertex, coordinates and normal one new vertex, in the order in
/// which the corners of the faces meet them. Vertices that no face uses are not kept. O(n log n).
inline Split_vertices split_vertices(const Polygon_soup& soup)
{
  Split_vertices split;
  const std::vector<Index> first = first_equal_corners(soup);
  split.corner.reserve(first.size());
  for (std::size_t c = 0; c < first.size(); ++c) {
    if (first[c] != c) {
      split.corner.push_back(first[c] == no_index ? no_index : split.corner[first[c]]);
      continue;
    }
    split.corner.push_back(static_cast<Index>(split.original.size()));
    split.original.push_back(soup.vertices[c]);
    if (const Corner_key key = corner_key(soup, c); !soup.uv.empty())
      split.uv.push_back(std::isfinite(key.u) ? Point_2(key.u, key.v) : Point_2(NAN, NAN));
    if (!soup.corner_normal.empty())
      split.normal.push_back(soup.corner_normal[c]);
  }
  return split;
}

} // namespace Atlas::internal

#endif
