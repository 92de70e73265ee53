// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SURFACE_SEAM_COSTS_H
#define ATLAS_SEGMENTATION_INTERNAL_SURFACE_SEAM_COSTS_H

#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <vector>

namespace Atlas::internal {

/// How much dearer a seam is along an edge that should not be one: more than any detour is long.
inline constexpr double penalty_of_unwanted_seams = 1e4;

/// Whether the user wants no seam at an edge.
inline bool is_unwanted_seam(const Surface& surface, Index h)
{
  return !surface.constraint.empty() && surface.constraint[h] == Edge_constraint::no_seam;
}

/// What the user says a seam costs at an edge, per length.
inline double wanted_cost(const Surface& surface, Index h)
{
  return surface.seam_cost.empty() ? 1 : surface.seam_cost[h];
}

/// \brief What a seam costs along each edge: its length times the user's factor, less at sharp edges, much
/// more where there should be none.
class Seam_costs
{
public:
  /// \param sharp_angle    the angle between normals, in radians, at which a seam is cheapest
  /// \param sharp_discount how much cheaper it is there, in [0, 1]
  Seam_costs(const Surface& surface, double sharp_angle, double sharp_discount)
      : surface_(surface), sharp_angle_(sharp_angle), sharp_discount_(sharp_discount),
        normals_(sharp_discount > 0 ? face_normals(surface) : std::vector<Vector_3>())
  {}

  struct Cost
  {
    double cost;        ///< without the penalty
    double penalty;     ///< a factor
    bool is_impossible; ///< the edge can never be a seam
  };

  Cost operator()(Index h) const
  {
    double sharp = 0;
    if (sharp_discount_ > 0)
      sharp = std::min(1., angle_between(normals_[h / 3], normals_[surface_.opposite[h] / 3]) / sharp_angle_);
    return {edge_length(surface_, h) * wanted_cost(surface_, h) * (1 - sharp_discount_ * sharp),
            is_unwanted_seam(surface_, h) ? penalty_of_unwanted_seams : 1, surface_.is_diagonal(h)};
  }

private:
  const Surface& surface_;
  double sharp_angle_, sharp_discount_;
  std::vector<Vector_3> normals_; ///< per triangle
};

} // namespace Atlas::internal

#endif
