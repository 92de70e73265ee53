// SPDX-License-Identifier: MIT
// Before the guard: where there is no library, that header includes its definitions, and they need all of
// this one.
#include <Atlas/segmentation/Merged_segmentation.h>

#ifndef ATLAS_SEGMENTATION_INTERNAL_MIRROR_HALF_SURFACE_H
#define ATLAS_SEGMENTATION_INTERNAL_MIRROR_HALF_SURFACE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/mirror/find_mirror_plane.h>
#include <Atlas/segmentation/internal/surface/part_of_surface.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// Per polygon the mean of its corners, which does not depend on its diagonals.
inline std::vector<Point_3> centres_of_faces(const Surface& surface)
{
  std::vector<Vector_3> sum(surface.number_of_faces, Vector_3(0, 0, 0));
  std::vector<double> count(surface.number_of_faces, 0);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (!surface.is_diagonal(h)) {
      sum[surface.face[h / 3]] = sum[surface.face[h / 3]] + (surface.point(h) - CGAL::ORIGIN);
      ++count[surface.face[h / 3]];
    }
  std::vector<Point_3> centres;
  for (Index f = 0; f < sum.size(); ++f)
    centres.push_back(count[f] > 0 ? CGAL::ORIGIN + sum[f] / count[f] : Point_3(0, 0, 0));
  return centres;
}

/// Per triangle, whether its polygon is on the side of the plane that the normal points to; polygons in the
/// middle are. Polygons with all their vertices at the border of that side are not: they would have no area
/// once the border is moved to the plane.
inline std::vector<std::uint8_t> triangles_of_half(const Surface& surface, const Mirror_plane& plane)
{
  constexpr double rounding = 1e-9; // the middle, as a share of the size of the triangle
  const std::vector<Point_3> centre = centres_of_faces(surface);
  std::vector<std::uint8_t> is_in(surface.number_of_triangles());
  for (Index t = 0; t < is_in.size(); ++t)
    is_in[t] = plane.distance(centre[surface.face[t]]) >= -rounding * edge_length(surface, 3 * t);
  constexpr int rounds = 3; // each may leave others at the border
  for (int k = 0; k < rounds; ++k) {
    std::vector<std::uint8_t> is_at_border(surface.points.size(), 0), is_kept(surface.number_of_faces, 0);
    for (Index h = 0; h < surface.opposite.size(); ++h)
      if (const Index o = surface.opposite[h]; o != no_index && is_in[h / 3] && !is_in[o / 3])
        for (const Index g : {h, next_halfedge(h)})
          is_at_border[surface.triangles[g / 3][g % 3]] = 1;
    for (Index h = 0; h < surface.opposite.size(); ++h)
      if (!is_at_border[surface.triangles[h / 3][h % 3]])
        is_kept[surface.face[h / 3]] = 1;
    for (Index t = 0; t < is_in.size(); ++t)
      is_in[t] &= is_kept[surface.face[t]];
  }
  return is_in;
}

/// \brief The triangles on one side of a plane as a surface of its own, in coordinates of the plane: x is the
/// distance from it, and exactly 0 where the surface goes on beyond.
struct Half_surface
{
  Half_surface(const Surface& surface, const Mirror_plane& plane)
      : is_in(triangles_of_half(surface, plane)), part(part_of_surface(
                                                      surface, [&](Index t) { return is_in[t]; }, global))
  {
    const Vector_3& n = plane.normal;
    const double x = std::abs(n.x()), y = std::abs(n.y()), z = std::abs(n.z());
    const Vector_3 far = x <= y && x <= z ? Vector_3(1, 0, 0)
                         : y <= z         ? Vector_3(0, 1, 0)
                                          : Vector_3(0, 0, 1);
    const Vector_3 across = CGAL::cross_product(n, far);
    const Vector_3 v = across / std::sqrt(across.squared_length()), w = CGAL::cross_product(n, v);
    for (Point_3& p : part.points)
      p = Point_3(plane.distance(p), v * (p - CGAL::ORIGIN), w * (p - CGAL::ORIGIN));
    for (Index h = 0; h < part.opposite.size(); ++h)
      if (is_at_plane(surface, h))
        for (const Index g : {h, next_halfedge(h)}) {
          Point_3& p = part.points[part.triangles[g / 3][g % 3]];
          p = Point_3(0, p.y(), p.z());
        }
  }

  Index global_halfedge(Index h) const { return 3 * global[h / 3] + h % 3; }

  /// Whether the surface goes on beyond a halfedge of this half, on the other side.
  bool is_at_plane(const Surface& surface, Index h) const
  {
    return part.opposite[h] == no_index && surface.opposite[global_halfedge(h)] != no_index;
  }

  std::vector<std::uint8_t> is_in; ///< per triangle of the surface
  std::vector<Index> global;       ///< per triangle of the half: that of the surface
  Surface part;
};

} // namespace Atlas::internal

#endif
