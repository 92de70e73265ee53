// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_ORIENT_FACES_H
#define ATLAS_SOUP_ORIENT_FACES_H

#include <Atlas/core/build_surface.h>
#include <Atlas/core/internal/equal_points.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

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

} // namespace internal

/// \brief Turns faces around so that neighbours agree which side is outside.
///
/// Neighbours are faces at an edge of these two alone, by position; they agree if they run through it in
/// opposite directions. In each connected part the orientation that most of its faces have wins. Where a part
/// has no orientation, as a Moebius strip, some neighbours go on to disagree. Charts never run over edges of
/// neighbours that disagree: a model with faces of random orientation has many more charts.
///
/// \return the faces that were turned, ascending. O(n log n) for n corners.
inline std::vector<Index> orient_faces(Polygon_soup& soup)
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

/// The number of edges at which two faces, and no others, disagree which side is outside. O(n log n).
inline std::size_t disagreeing_edges(const Polygon_soup& soup)
{
  const std::vector<internal::Face_pair> pairs = internal::pairs_at_edges(soup);
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(),
                                                [](const internal::Face_pair& p) { return !p.agrees; })) /
         2;
}

} // namespace Atlas

#endif
