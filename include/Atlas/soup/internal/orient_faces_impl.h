// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_ORIENT_FACES_IMPL_H
#define ATLAS_SOUP_INTERNAL_ORIENT_FACES_IMPL_H

#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/equal_points.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/soup/internal/turn_face.h>
#include <Atlas/soup/orient_faces.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace Atlas {

namespace internal {

/// Two faces at an edge that is of no other face.
struct Face_pair
{
  Index face, other;
  bool agrees; ///< whether they run through the edge in opposite directions
};

/// Each pair from both sides, sorted by `face`.
inline std::vector<Face_pair> pairs_at_edges(const Polygon_soup& soup)
{
  struct Edge
  {
    std::pair<Index, Index> ends;
    Index face;
    bool is_upward;
  };
  const std::vector<Index> place = merge_equal_points(soup.points);
  const auto vertex = [&](Index v) { return v < place.size() ? place[v] : no_index; };
  std::vector<Edge> edges;
  edges.reserve(soup.number_of_corners());
  for (Index f = 0; f < soup.number_of_faces(); ++f) {
    const auto face = soup.face(f);
    for (std::size_t i = 0; i < face.size(); ++i)
      if (const Index a = vertex(face[i]), b = vertex(face[(i + 1) % face.size()]);
          a != b && a != no_index && b != no_index)
        edges.push_back({std::minmax(a, b), f, a < b});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.face < b.face;
  });
  std::vector<Face_pair> pairs;
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j].ends == edges[i].ends)
      ++j;
    const Edge &a = edges[i], &b = edges[j - 1];
    if (j - i != 2 || a.face == b.face)
      continue;
    pairs.push_back({a.face, b.face, a.is_upward != b.is_upward});
    pairs.push_back({b.face, a.face, a.is_upward != b.is_upward});
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Face_pair& a, const Face_pair& b) { return a.face < b.face; });
  return pairs;
}

} // namespace internal

ATLAS_INLINE std::vector<Index> orient_faces(Polygon_soup& soup)
{
  const std::vector<internal::Face_pair> pairs = internal::pairs_at_edges(soup);
  constexpr Index unseen = no_index;
  std::vector<Index> turned(soup.number_of_faces(), unseen), result; // 0 or 1, relative to the part's first
  for (Index seed = 0; seed < turned.size(); ++seed) {
    if (turned[seed] != unseen)
      continue;
    turned[seed] = 0;
    std::vector<Index> part{seed};
    for (std::size_t i = 0; i < part.size(); ++i) {
      auto pair = std::lower_bound(pairs.begin(), pairs.end(), part[i],
                                   [](const internal::Face_pair& p, Index f) { return p.face < f; });
      for (; pair != pairs.end() && pair->face == part[i]; ++pair)
        if (turned[pair->other] == unseen) {
          turned[pair->other] = pair->agrees ? turned[part[i]] : 1 - turned[part[i]];
          part.push_back(pair->other);
        }
    }
    const auto ones = std::count_if(part.begin(), part.end(), [&](Index f) { return turned[f] == 1; });
    const Index loser = 2 * static_cast<std::size_t>(ones) > part.size() ? 0 : 1;
    std::copy_if(part.begin(), part.end(), std::back_inserter(result),
                 [&](Index f) { return turned[f] == loser; });
  }
  std::sort(result.begin(), result.end());
  for (const Index f : result)
    internal::turn_face(soup, f);
  return result;
}

ATLAS_INLINE std::size_t disagreeing_edges(const Polygon_soup& soup)
{
  const std::vector<internal::Face_pair> pairs = internal::pairs_at_edges(soup);
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(),
                                                [](const internal::Face_pair& p) { return !p.agrees; })) /
         2;
}

ATLAS_INLINE void start_polygons_at_fans(const Surface& surface, Polygon_soup& soup)
{
  internal::require(surface.number_of_faces == soup.number_of_faces() &&
                        surface.number_of_corners == soup.number_of_corners(),
                    "surface", "must have been built of the soup");
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
