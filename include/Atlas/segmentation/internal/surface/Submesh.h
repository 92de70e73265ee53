// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SURFACE_SUBMESH_H
#define ATLAS_SEGMENTATION_INTERNAL_SURFACE_SUBMESH_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The connectivity of some triangles of the surface, glued along some of their edges.
///
/// Halfedges and triangles have local numbers: local triangle t is `triangles[t]` of the surface. Vertices
/// are fans of glued corners, just as extract_chart() makes them.
struct Submesh
{
  std::vector<Index> triangles;           ///< of the surface
  std::vector<Index> opposite;            ///< per local halfedge
  std::vector<Index> vertex;              ///< per local corner
  std::vector<Index> first;               ///< per vertex: the first entry in `outgoing`; one more at the end
  std::vector<Index> outgoing;            ///< local halfedges, sorted by the vertex they start at
  std::vector<std::uint8_t> is_on_border; ///< per vertex

  Index head(Index h) const { return vertex[next_halfedge(h)]; }
  Index global(Index h) const { return 3 * triangles[h / 3] + h % 3; }
  std::size_t number_of_vertices() const { return is_on_border.size(); }

  /// Numbers the vertices anew, after edges were unglued. Linear.
  void number_vertices()
  {
    vertex.assign(opposite.size(), no_index);
    is_on_border.clear();
    for (Index start = 0; start < opposite.size(); ++start)
      if (vertex[start] == no_index)
        number_fan(start);
    first.assign(number_of_vertices() + 1, 0);
    for (const Index v : vertex)
      ++first[v + 1];
    for (std::size_t v = 1; v < first.size(); ++v)
      first[v] += first[v - 1];
    std::vector<Index> place(first.begin(), first.end() - 1);
    outgoing.resize(opposite.size());
    for (Index h = 0; h < opposite.size(); ++h)
      outgoing[place[vertex[h]]++] = h;
  }

  /// Vertices - edges + triangles.
  long long euler() const
  {
    long long border = 0;
    for (const Index o : opposite)
      border += o == no_index;
    const auto halfedges = static_cast<long long>(opposite.size());
    return static_cast<long long>(number_of_vertices()) - (halfedges + border) / 2 + halfedges / 3;
  }

  std::size_t number_of_border_loops() const { return border_loops(opposite).size(); }

private:
  void number_fan(Index start)
  {
    const Index v = static_cast<Index>(number_of_vertices());
    const bool is_closed = for_each_in_fan(
        opposite, start, [&](Index h) { return opposite[h] != no_index; }, [&](Index h) { vertex[h] = v; });
    is_on_border.push_back(!is_closed);
  }
};

/// \param is_glued  per halfedge of the surface, whether triangles of the submesh are glued there
/// \param local     scratch: per triangle of the surface; only entries of `triangles` are used
template <typename Is_glued>
Submesh make_submesh(const Surface& surface, std::vector<Index> triangles, Is_glued is_glued,
                     std::vector<Index>& local)
{
  Submesh submesh;
  submesh.triangles = std::move(triangles);
  for (Index t = 0; t < submesh.triangles.size(); ++t)
    local[submesh.triangles[t]] = t;
  submesh.opposite.assign(3 * submesh.triangles.size(), no_index);
  for (Index h = 0; h < submesh.opposite.size(); ++h)
    if (const Index g = submesh.global(h); is_glued(g)) {
      const Index o = surface.opposite[g];
      submesh.opposite[h] = 3 * local[o / 3] + o % 3;
    }
  submesh.number_vertices();
  return submesh;
}

/// The triangles, per part, of the parts that are connected over glued edges, in the order of their first
/// triangles.
inline std::vector<std::vector<Index>> connected_parts(const Submesh& submesh)
{
  const Components components = connected_components(submesh.opposite);
  std::vector<std::vector<Index>> parts(components.count);
  for (Index t = 0; t < submesh.triangles.size(); ++t)
    parts[components.of_triangle[t]].push_back(t);
  return parts;
}

/// Triangles at which vertex numbers tell another connectivity than the glued edges do: triangles that visit
/// a vertex twice, and edges that share both ends with another edge. A chart is an indexed mesh, so such
/// triangles have to leave it.
inline std::vector<Index> ambiguous_triangles(const Submesh& submesh)
{
  std::vector<std::array<Index, 3>> corners(submesh.triangles.size());
  for (Index h = 0; h < submesh.vertex.size(); ++h)
    corners[h / 3][h % 3] = submesh.vertex[h];
  const std::vector<Index> by_number = opposite_halfedges(corners);
  std::vector<Index> result;
  for (Index t = 0; t < corners.size(); ++t) {
    const auto& [a, b, c] = corners[t];
    bool ambiguous = a == b || b == c || c == a;
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      ambiguous = ambiguous || by_number[h] != submesh.opposite[h];
    if (ambiguous)
      result.push_back(t);
  }
  return result;
}

} // namespace Atlas::internal

#endif
