// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_FACETS_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_FACETS_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace Atlas::internal {

/// How far points may be off a plane or off their twin in the plane, over the diagonal of the model: what
/// files with six digits leave of a position.
inline constexpr double relative_position_noise = 4e-6;
/// Largest angle in radians between the normal of a triangle and that of its facet, where noise does not
/// explain it.
inline constexpr double largest_tilt_in_facet = 2e-3;

/// \brief The plane parts of a surface: triangles that lie in one plane and hang together.
struct Facets
{
  std::vector<Index> of_triangle;
  std::vector<Vector_3> normal; ///< per facet: unit; the zero vector where the facet is but a segment
  std::vector<double> area;     ///< per facet

  Index count() const { return static_cast<Index>(normal.size()); }
};

/// The least height of a triangle: its area over half its longest edge.
inline double least_height(const Surface& surface, Index t)
{
  const double longest = std::max(
      {edge_length(surface, 3 * t), edge_length(surface, 3 * t + 1), edge_length(surface, 3 * t + 2)});
  return longest > 0 ? 2 * triangle_area(surface, t) / longest : 0;
}

/// \brief Finds the facets, the largest triangles first.
///
/// A triangle joins while its corners are within the noise of the plane. Its own normal has a say as far as
/// noise allows: that of a sliver has none. Seams that the user wants bound facets; input faces stay whole as
/// far as they are plane. O(n log n).
inline Facets coplanar_facets(const Surface& surface, double noise)
{
  const std::size_t n = surface.number_of_triangles();
  Facets facets;
  facets.of_triangle.assign(n, no_index);
  std::vector<double> area(n), height(n);
  std::vector<Vector_3> normal(n);
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), Index(0));
  for (Index t = 0; t < n; ++t) {
    area[t] = triangle_area(surface, t);
    height[t] = least_height(surface, t);
    normal[t] = unit_normal(surface, t);
  }
  std::sort(order.begin(), order.end(),
            [&](Index s, Index t) { return height[s] != height[t] ? height[s] > height[t] : s < t; });
  for (const Index seed : order) {
    if (facets.of_triangle[seed] != no_index)
      continue;
    const Index facet = facets.count();
    const Vector_3 up = normal[seed];
    const Point_3 origin = surface.point(3 * seed);
    facets.normal.push_back(up);
    facets.area.push_back(0);
    flood_fill(
        surface.opposite, seed, [&](Index h) { return may_cross(surface, h); },
        [&](Index t) {
          if (facets.of_triangle[t] != no_index)
            return false;
          if (t != seed) {
            for (Index h = 3 * t; h < 3 * t + 3; ++h)
              if (!(std::abs((surface.point(h) - origin) * up) <= noise))
                return false;
            const double tilt = largest_tilt_in_facet + 2 * noise / std::max(height[t], 1e-300);
            if (tilt < 1 && angle_between(normal[t], up) > tilt)
              return false;
          }
          facets.of_triangle[t] = facet;
          facets.area[facet] += area[t];
          return true;
        });
  }
  return facets;
}

} // namespace Atlas::internal

#endif
