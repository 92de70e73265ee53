// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_CHART_ARCS_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_CHART_ARCS_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/core/internal/halfedges.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// \brief The network of edges along which a segmentation does not glue triangles, in arcs.
///
/// An arc runs from one fixed vertex to the next: a vertex where three arcs meet, where a cut ends, or where
/// edges that may be glued meet edges that must not. A closed arc has one fixed vertex, anywhere. Arc a has
/// the sides 2a and 2a + 1, each seen from the triangles next to it; at the border of the surface only one.
struct Chart_arcs
{
  std::vector<Index> vertex;          ///< per halfedge: the vertex it starts at, as a manifold counts them
  std::vector<Index> side;            ///< per halfedge: the side of an arc, or `no_index`
  std::vector<std::uint8_t> is_fixed; ///< per vertex
  std::vector<std::uint8_t> must_be_seam; ///< per arc: whether it must stay a seam

  Index number_of_vertices() const { return static_cast<Index>(is_fixed.size()); }
  Index number_of_arcs() const { return static_cast<Index>(must_be_seam.size()); }
};

/// Numbers the vertices of the surface so that sheets that only touch come apart: per halfedge, its start.
inline Index manifold_vertices(const Surface& surface, std::vector<Index>& vertex)
{
  vertex.assign(surface.opposite.size(), no_index);
  Index count = 0;
  for (Index start = 0; start < vertex.size(); ++start) {
    if (vertex[start] != no_index)
      continue;
    for_each_in_fan(
        surface.opposite, start, [&](Index h) { return surface.opposite[h] != no_index; },
        [&](Index h) { vertex[h] = count; });
    ++count;
  }
  return count;
}

/// Finds the arcs. O(n).
inline Chart_arcs chart_arcs(const Surface& surface, const Segmentation& segmentation)
{
  Chart_arcs arcs;
  const Index vertices = manifold_vertices(surface, arcs.vertex);
  const std::size_t n = surface.opposite.size();
  arcs.side.assign(n, no_index);
  arcs.is_fixed.assign(vertices, 0);
  const auto is_seam = [&](Index h) { return !segmentation.is_glued(surface, h); };

  constexpr std::uint8_t many = 3; // edges at a vertex: no more need to be told apart
  const auto count_one_more = [](std::uint8_t& d) { d = static_cast<std::uint8_t>(d < many ? d + 1 : many); };
  std::vector<std::uint8_t> degree(vertices, 0), fixed_degree(vertices, 0);
  for (Index h = 0; h < n; ++h) {
    const Index o = surface.opposite[h];
    if (!is_seam(h) || (o != no_index && o < h))
      continue;
    for (const Index v : {arcs.vertex[h], arcs.vertex[next_halfedge(h)]}) {
      count_one_more(degree[v]);
      if (must_be_seam(surface, h))
        count_one_more(fixed_degree[v]);
    }
  }
  for (Index v = 0; v < vertices; ++v)
    arcs.is_fixed[v] = degree[v] != 0 && (degree[v] != 2 || fixed_degree[v] == 1);

  const auto follow = [&](Index start) { // `start` leaves a fixed vertex
    const Index a = arcs.number_of_arcs();
    arcs.must_be_seam.push_back(must_be_seam(surface, start));
    for (Index h = start;; h = next_on_border(surface.opposite, h, is_seam)) {
      arcs.side[h] = 2 * a;
      if (const Index o = surface.opposite[h]; o != no_index)
        arcs.side[o] = 2 * a + 1;
      if (arcs.is_fixed[arcs.vertex[next_halfedge(h)]])
        break;
    }
  };
  for (Index h = 0; h < n; ++h)
    if (arcs.side[h] == no_index && is_seam(h) && arcs.is_fixed[arcs.vertex[h]])
      follow(h);
  for (Index h = 0; h < n; ++h)
    if (arcs.side[h] == no_index && is_seam(h)) {
      arcs.is_fixed[arcs.vertex[h]] = 1;
      follow(h);
    }
  return arcs;
}

} // namespace Atlas::internal

#endif
