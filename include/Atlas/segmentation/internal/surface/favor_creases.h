// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SURFACE_FAVOR_CREASES_H
#define ATLAS_SEGMENTATION_INTERNAL_SURFACE_FAVOR_CREASES_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/bounding_box.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief How sharply a surface bends across its edges, on a scale of the model.
///
/// From the middle of an edge a straight way runs over the triangles on either side, as far as the scale
/// says; the angle is that between the mean normals along both ways. So a fillet counts as the crease that it
/// rounds, and noise as nothing. O(n) ways of O(1) triangles each.
class Crease_finder
{
public:
  explicit Crease_finder(const Surface& surface)
      : surface_(surface), normals_(face_normals(surface)),
        reach_(share_of_model * 2 * bounding_box(surface).half_side)
  {
    // Dozens of ways cross each triangle.
    inward_.reserve(3 * normals_.size());
    for (Index h = 0; h < 3 * normals_.size(); ++h)
      inward_.push_back(unit(CGAL::cross_product(normals_[h / 3], along(h))));
  }

  /// In radians, in [0, pi]; negative where the surface is convex. `h` has an opposite.
  double operator()(Index h) const
  {
    const Index o = surface_.opposite[h];
    const Vector_3 left = mean_normal(h), right = mean_normal(o);
    const double angle = angle_between(left, right);
    return left * inward(o) + right * inward(h) > 0 ? angle : -angle;
  }

private:
  /// The length of a way, of the largest side of the model.
  static constexpr double share_of_model = 0.015;
  static constexpr int most_triangles = 24; ///< on a way: a bound on the cost

  Vector_3 along(Index h) const { return surface_.point(next_halfedge(h)) - surface_.point(h); }

  /// The direction across the edge into the triangle of h.
  const Vector_3& inward(Index h) const { return inward_[h]; }

  /// Along the way that starts across h, from its middle.
  Vector_3 mean_normal(Index h) const
  {
    Point_3 place = CGAL::midpoint(surface_.point(h), surface_.point(next_halfedge(h)));
    Vector_3 way = inward(h), sum(0, 0, 0);
    double left = reach_;
    for (int step = 0; step < most_triangles && left > 0; ++step) {
      const auto [exit, length] = leave(h, place, way);
      const double used = std::min(length, left);
      sum = sum + used * normals_[h / 3];
      left -= used;
      const Index o = exit == no_index ? no_index : surface_.opposite[exit];
      if (o == no_index)
        break;
      place = place + length * way;
      // Straight on in the next triangle: as much along the edge as before, the rest across it.
      const Vector_3 edge = unit(along(exit));
      const double forward = way * edge;
      way = forward * edge + std::sqrt(std::max(0., 1 - forward * forward)) * inward(o);
      h = o;
    }
    return sum.squared_length() > 0 ? sum : normals_[h / 3];
  }

  /// The edge by which a way from a place on edge h leaves the triangle, and after what length.
  std::pair<Index, double> leave(Index h, const Point_3& place, const Vector_3& way) const
  {
    std::pair<Index, double> first{no_index, std::numeric_limits<double>::infinity()};
    for (const Index g : {next_halfedge(h), previous_halfedge(h)}) {
      const Vector_3& in = inward(g);
      const double speed = -(way * in), distance = (place - surface_.point(g)) * in;
      if (speed > 0 && distance / speed < first.second)
        first = {g, std::max(0., distance / speed)};
    }
    return first;
  }

  const Surface& surface_;
  std::vector<Vector_3> normals_; ///< per triangle
  std::vector<Vector_3> inward_;  ///< per halfedge
  double reach_;
};

/// The angle between the sides of a crease, in radians, from which on a seam in it is cheapest, ...
inline constexpr double angle_of_cheapest_creases = std::numbers::pi / 4;
/// ... how much cheaper it is there than in flat land, ...
inline constexpr double discount_in_creases = 0.8;
/// ... and which part of that convex creases get: they are seen from more directions than concave ones.
inline constexpr double share_of_convex_creases = 0.9;

/// Makes seams cheaper in creases, by the same for both sides of an edge.
inline void favor_creases(Surface& surface)
{
  const Crease_finder finder(surface);
  surface.seam_cost.resize(surface.opposite.size(), 1);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (const Index o = surface.opposite[h]; o != no_index && h < o) {
      const double angle = finder(h);
      const double sharp = std::min(1., std::abs(angle) / angle_of_cheapest_creases) *
                           (angle > 0 ? 1 : share_of_convex_creases);
      surface.seam_cost[h] *= 1 - discount_in_creases * sharp;
      surface.seam_cost[o] = surface.seam_cost[h];
    }
}

} // namespace Atlas::internal

#endif
