// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_PAIR_DOUBLED_FACES_H
#define ATLAS_CORE_INTERNAL_PAIR_DOUBLED_FACES_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/equal_points.h>
#include <Atlas/core/internal/halfedges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Takes apart the sheets of faces that are there several times on the same vertices: both sides of
/// two-sided models, and copies.
///
/// Faces with the same set of places are twins, and never adjacent to each other. At an edge where exactly
/// two such sets meet, the faces that run along it in opposite directions are paired, first with first,
/// second with second, in the order of the file. So each side of a two-sided model is a sheet, and so are the
/// first of all copies, the second, and so on. Edges of other kinds are left alone. O(n log n), linear where
/// no face is double.
class Doubled_faces
{
public:
  /// \param surface  with its opposites, as far as edges have exactly two faces
  explicit Doubled_faces(Surface& surface) : surface_(surface), place_(merge_equal_points(surface.points)) {}

  void pair()
  {
    number_twins();
    if (!has_twins_)
      return;
    std::vector<Edge> edges = open_edges();
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
      while (j < edges.size() && edges[j].ends == edges[i].ends)
        ++j;
      pair_edge(&edges[i], j - i);
    }
  }

private:
  /// One side of an edge; sides are sorted by edge, set of twins and direction, then in the order of the
  /// file.
  struct Edge
  {
    std::pair<Index, Index> ends;
    Index twins;
    bool is_upward;
    Index halfedge;
    bool operator<(const Edge& other) const
    {
      return std::tie(ends, twins, is_upward, halfedge) <
             std::tie(other.ends, other.twins, other.is_upward, other.halfedge);
    }
  };

  Index place(Index h) const { return place_[surface_.triangles[h / 3][h % 3]]; }

  /// Numbers the sets of faces with the same places, among faces that have an open edge.
  void number_twins()
  {
    twins_.assign(surface_.number_of_faces, no_index);
    std::map<std::vector<Index>, Index> numbers;
    std::vector<Index> places;
    for (std::size_t t = 0, end = 0; t < surface_.number_of_triangles(); t = end) {
      bool is_open = false;
      places.clear();
      for (; end < surface_.number_of_triangles() && surface_.face[end] == surface_.face[t]; ++end)
        for (Index h = static_cast<Index>(3 * end); h < 3 * end + 3; ++h) {
          is_open = is_open || surface_.opposite[h] == no_index;
          places.push_back(place(h));
        }
      if (!is_open)
        continue;
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end()), places.end());
      const auto [it, is_new] = numbers.try_emplace(places, static_cast<Index>(numbers.size()));
      twins_[surface_.face[t]] = it->second;
      has_twins_ = has_twins_ || !is_new;
    }
  }

  /// The sides of all edges without an opposite, or with that of a twin.
  std::vector<Edge> open_edges() const
  {
    std::vector<Edge> edges;
    for (Index h = 0; h < surface_.opposite.size(); ++h) {
      const Index o = surface_.opposite[h], twins = twins_[surface_.face[h / 3]];
      const bool is_between_twins = o != no_index && surface_.face[o / 3] != surface_.face[h / 3] &&
                                    twins != no_index && twins_[surface_.face[o / 3]] == twins;
      const Index a = place(h), b = place(next_halfedge(h));
      if ((o == no_index || is_between_twins) && a != b)
        edges.push_back({std::minmax(a, b), twins, a < b, h});
    }
    return edges;
  }

  /// Pairs the sides of one edge, if two sets of twins meet there.
  void pair_edge(const Edge* edges, std::size_t size)
  {
    std::array<std::vector<Index>, 4> sides; // first set down, up, second set down, up
    bool has_double = false;
    for (std::size_t i = 0; i < size; ++i) {
      const bool is_second = edges[i].twins != edges[0].twins;
      if (is_second && edges[i].twins != edges[size - 1].twins)
        return; // more than two sets
      std::vector<Index>& side = sides[2 * std::size_t(is_second) + std::size_t(edges[i].is_upward)];
      side.push_back(edges[i].halfedge);
      has_double = has_double || (i > 0 && edges[i].twins == edges[i - 1].twins);
    }
    if (!has_double)
      return;
    for (std::size_t i = 0; i < size; ++i)
      surface_.opposite[edges[i].halfedge] = no_index;
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < std::min(sides[k].size(), sides[3 - k].size()); ++i) {
        surface_.opposite[sides[k][i]] = sides[3 - k][i];
        surface_.opposite[sides[3 - k][i]] = sides[k][i];
      }
  }

  Surface& surface_;
  std::vector<Index> place_; ///< per vertex
  std::vector<Index> twins_; ///< per face: the number of its set; `no_index` where it has no open edge
  bool has_twins_ = false;
};

} // namespace Atlas::internal

#endif
