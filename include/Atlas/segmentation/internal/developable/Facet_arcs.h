// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_FACET_ARCS_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_FACET_ARCS_H

#include <Atlas/segmentation/internal/developable/Hard_facets.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// What two hard facets have in common: the edges between them.
struct Facet_arc
{
  Index a, b;                   ///< facets, a < b
  std::vector<Index> halfedges; ///< of facet a
  double length = 0;            ///< times what seams cost there
  double rank = 0;              ///< logarithm of the length over a unit in steps of 1e-4
  bool is_ruling = true;        ///< the surface bends smoothly across all of it, if coarsely, ...
  bool is_smooth = true;        ///< ... and is no crease anywhere
  bool is_forced = false;       ///< it must not be a seam
};

/// Creases are rulings only on the sides of prisms of few sides: where facets hang together in a row by
/// them, and bend smoothly nowhere. Elsewhere they are the edges of chamfers.
inline void leave_rulings_of_prisms(std::vector<Facet_arc>& arcs, Index facets)
{
  std::vector<int> smooth(facets, 0), coarse(facets, 0);
  for (const Facet_arc& arc : arcs)
    for (const Index f : {arc.a, arc.b}) {
      smooth[f] += arc.is_smooth;
      coarse[f] += arc.is_ruling && !arc.is_smooth;
    }
  const auto is_in_row = [&](Index f) { return smooth[f] == 0 && coarse[f] <= 2; };
  for (Facet_arc& arc : arcs)
    arc.is_ruling &= arc.is_smooth || (is_in_row(arc.a) && is_in_row(arc.b));
}

/// The arcs between hard facets, in the order of their first halfedges.
inline std::vector<Facet_arc> facet_arcs(const Surface& surface, const Facets& facets,
                                         const Hard_facets& hard, double unit)
{
  std::vector<Facet_arc> arcs;
  std::map<std::pair<Index, Index>, std::size_t> number;
  for (Index h = 0; h < surface.opposite.size(); ++h) {
    if (!may_cross(surface, h))
      continue;
    const Index f = facets.of_triangle[h / 3], g = facets.of_triangle[surface.opposite[h] / 3];
    if (f >= g || !hard.is_hard(f) || !hard.is_hard(g))
      continue;
    const auto [place, is_new] = number.try_emplace({f, g}, arcs.size());
    if (is_new)
      arcs.push_back({f, g, {}});
    Facet_arc& arc = arcs[place->second];
    arc.halfedges.push_back(h);
    arc.length += edge_length(surface, h) * wanted_cost(surface, h);
    arc.is_ruling &= hard.is_ruling(h);
    arc.is_smooth &= hard.is_ruling(h) && hard.turn(h) <= crease_degrees * CGAL_PI / 180;
    arc.is_forced |= must_not_be_seam(surface, h);
  }
  leave_rulings_of_prisms(arcs, facets.count());
  // Lengths that are equal but for rounding have to be equal, whatever the scale.
  for (Facet_arc& arc : arcs)
    arc.rank = std::round(std::log(std::max(arc.length / unit, 1e-100)) * 1e4);
  return arcs;
}

} // namespace Atlas::internal

#endif
