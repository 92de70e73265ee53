// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_FACETS_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_NET_FACETS_H

#include <Atlas/planar/internal/box_tree.h>
#include <Atlas/planar/internal/convex_hull.h>
#include <Atlas/segmentation/internal/developable/Facet_arcs.h>
#include <Atlas/segmentation/internal/developable/Net_layout.h>

#include <cmath>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// What nets are made of: the hard facets, each in its plane, and the arcs between them. It never changes, so
/// all trials share it.
struct Net_facets
{
  Net_facets(const Surface& of_surface, const Facets& of_facets, const Hard_facets& are_hard,
             double noise_of_points)
      : surface(of_surface), facets(of_facets), hard(are_hard), noise(noise_of_points),
        local(coordinates_in_facets(surface, facets)), arc_of(local.size(), no_index),
        arcs_at(facets.count()), triangles_of(facets.count())
  {
    for (Index f = 0; f < facets.count(); ++f)
      if (hard.is_hard(f))
        whole_area += facets.area[f];
    unit = std::sqrt(whole_area);
    arcs = facet_arcs(surface, facets, hard, unit);
    for (Index a = 0; a < arcs.size(); ++a) {
      arcs_at[arcs[a].a].push_back(a);
      arcs_at[arcs[a].b].push_back(a);
      for (const Index h : arcs[a].halfedges)
        arc_of[h] = arc_of[surface.opposite[h]] = a;
    }
    for (Index t = 0; t < facets.of_triangle.size(); ++t)
      if (hard.is_hard(facets.of_triangle[t]))
        triangles_of[facets.of_triangle[t]].push_back(t);
    for (Index f = 0; f < facets.count(); ++f) {
      hulls.push_back(hull_of(f));
      trees.push_back(tree_of(f));
      borders.push_back(border_of(f));
    }
  }

  Index facet(Index h) const { return facets.of_triangle[h / 3]; }

  const Surface& surface;
  const Facets& facets;
  const Hard_facets& hard;
  double noise;                    ///< how far points may be off their place
  double whole_area = 0, unit = 1; ///< of the hard facets; its root
  std::vector<Vec2> local;         ///< per halfedge: where it starts in the plane of its facet
  std::vector<Facet_arc> arcs;
  std::vector<Index> arc_of;                             ///< per halfedge
  std::vector<std::vector<Index>> arcs_at, triangles_of; ///< per facet; none of those that are not hard
  std::vector<std::vector<Vec2>> hulls;                  ///< of the facets, in their planes
  std::vector<Box_tree> trees;                           ///< of the triangles of the facets there
  std::vector<Alignment> borders;                        ///< of the facets there

private:
  std::vector<Vec2> hull_of(Index f) const
  {
    std::vector<Vec2> points;
    for (const Index t : triangles_of[f])
      points.insert(points.end(), local.begin() + 3 * t, local.begin() + 3 * t + 3);
    return convex_hull(std::move(points));
  }

  Alignment border_of(Index f) const
  {
    std::vector<Vec2> segments;
    for (const Index t : triangles_of[f])
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (const Index o = surface.opposite[h]; o == no_index || facet(o) != f)
          segments.push_back(local[next_halfedge(h)] - local[h]);
    return alignment_of(segments);
  }

  Box_tree tree_of(Index f) const
  {
    constexpr std::size_t leaf_size = 4;
    std::vector<Box_2> boxes;
    for (const Index t : triangles_of[f]) {
      Box_2& box = boxes.emplace_back();
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        box.add(local[h].x, local[h].y);
    }
    return Box_tree(boxes, leaf_size, Execution());
  }
};

} // namespace Atlas::internal

#endif
