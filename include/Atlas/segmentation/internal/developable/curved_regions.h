// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_CURVED_REGIONS_H
#define ATLAS_SEGMENTATION_INTERNAL_DEVELOPABLE_CURVED_REGIONS_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// \brief The parts of a surface that are curved in both directions, though rounding could explain the angle
/// defect of each vertex alone.
///
/// On a fine mesh the angle defect of a vertex is as small as what rounding its position can make, whatever
/// the surface is. But over a region the defects that rounding makes cancel each other, as those inside of a
/// border that stays in its place have a fixed sum (Gauss and Bonnet), while those of a surface that is
/// curved add up. O(n).
class Curved_regions
{
public:
  /// \param vertex    per halfedge: where it starts
  /// \param defect    per vertex, with its sign, in radians
  /// \param is_asked  per vertex: only defects of these count, not those of creases
  Curved_regions(const Surface& surface, const std::vector<Index>& vertex, const std::vector<double>& defect,
                 const std::vector<std::uint8_t>& is_asked)
      : surface_(surface), vertex_(vertex), defect_(defect), is_asked_(is_asked), corners_(defect.size(), 0),
        region_(surface.number_of_triangles(), no_index)
  {
    for (const Index v : vertex_)
      ++corners_[v];
    for (Index seed = 0; seed < region_.size(); ++seed)
      if (is_free(seed))
        curvature_.push_back(grow(seed));
  }

  /// Per vertex, whether it is of a curved region.
  std::vector<std::uint8_t> vertices() const
  {
    Union_find parts(static_cast<Index>(curvature_.size()));
    for (Index h = 0; h < vertex_.size(); ++h)
      if (is_curved(h / 3) && may_cross(surface_, h) && is_curved(surface_.opposite[h] / 3))
        parts.unite(region_[h / 3], region_[surface_.opposite[h] / 3]);
    std::vector<double> total(curvature_.size(), 0);
    for (Index r = 0; r < total.size(); ++r)
      total[parts.find(r)] += curvature_[r];
    std::vector<std::uint8_t> result(defect_.size(), 0);
    for (Index h = 0; h < vertex_.size(); ++h)
      if (is_curved(h / 3) && total[parts.find(region_[h / 3])] > least_total)
        result[vertex_[h]] = 1;
    return result;
  }

private:
  bool is_curved(Index t) const { return region_[t] != no_index && curvature_[region_[t]] > 0; }

  bool is_free(Index t) const
  {
    return region_[t] == no_index &&
           (is_asked_[vertex_[3 * t]] || is_asked_[vertex_[3 * t + 1]] || is_asked_[vertex_[3 * t + 2]]);
  }

  /// A new region around a triangle. Returns the sum of its defects, without sign, or 0 where it unrolls.
  double grow(Index seed)
  {
    const Index number = static_cast<Index>(curvature_.size());
    std::vector<Index> triangles{seed};
    region_[seed] = number;
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (Index h = 3 * triangles[i]; h < 3 * triangles[i] + 3; ++h) {
        if (is_asked_[vertex_[h]])
          sum += defect_[vertex_[h]] / corners_[vertex_[h]];
        if (!may_cross(surface_, h))
          continue;
        const Index other = surface_.opposite[h] / 3;
        if (is_asked_[vertex_[h]] && is_asked_[vertex_[next_halfedge(h)]]) {
          const double turn = angle_between(unit_normal(surface_, h / 3), unit_normal(surface_, other));
          squares += turn * turn;
        }
        if (triangles.size() < most_triangles && is_free(other)) {
          region_[other] = number;
          triangles.push_back(other);
        }
      }
    return std::abs(sum) > least_curved * squares ? std::abs(sum) : 0;
  }

  /// A region is large enough for rounding to cancel, and not as large as what the model shows.
  static constexpr std::size_t most_triangles = 200;
  /// The defects of a region over the squares of the angles at its edges: 0.4 on spheres, 0 where it unrolls.
  static constexpr double least_curved = 0.005;
  /// Curved regions that hang together and have less curvature unroll with a stretch below 1.02.
  static constexpr double least_total = 0.25;

  const Surface& surface_;
  const std::vector<Index>& vertex_;
  const std::vector<double>& defect_;
  const std::vector<std::uint8_t>& is_asked_;
  std::vector<Index> corners_, region_; ///< per vertex; per triangle
  std::vector<double> curvature_;       ///< per region
};

} // namespace Atlas::internal

#endif
