// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_FAST_MARCHING_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_FAST_MARCHING_H

#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Distances on the surface from a set of vertices, by fast marching.
///
/// R. Kimmel, J. Sethian, Computing geodesic paths on manifolds, PNAS 1998: across each triangle the wave
/// front is taken for plane. Where that does not fit (obtuse and degenerate triangles) it follows the edges,
/// which gives a value that is too large, never one too small. O(n log n).
class Fast_marching
{
public:
  Fast_marching(const Surface& surface, const Submesh& submesh) : surface_(surface), submesh_(submesh) {}

  const std::vector<double>& distance() const { return distance_; }
  bool is_reached(Index v) const { return distance_[v] < std::numeric_limits<double>::infinity(); }

  void run(const std::vector<Index>& sources)
  {
    distance_.assign(submesh_.number_of_vertices(), std::numeric_limits<double>::infinity());
    is_done_.assign(submesh_.number_of_vertices(), 0);
    for (const Index v : sources)
      improve(v, 0);
    while (!queue_.empty()) {
      const Index v = queue_.top().second;
      queue_.pop();
      if (is_done_[v])
        continue;
      is_done_[v] = 1;
      for (Index k = submesh_.first[v]; k < submesh_.first[v + 1]; ++k)
        cross_triangle(submesh_.outgoing[k]);
    }
  }

private:
  using Entry = std::pair<double, Index>;

  void improve(Index v, double d)
  {
    if (d < distance_[v]) {
      distance_[v] = d;
      queue_.emplace(d, v);
    }
  }

  const Point_3& place(Index h) const { return surface_.point(submesh_.global(h)); }

  /// From the vertex at the tail of h, just done, to the two others of its triangle.
  void cross_triangle(Index h)
  {
    const Index n = next_halfedge(h), p = previous_halfedge(h);
    const Index v = submesh_.vertex[h], a = submesh_.vertex[n], b = submesh_.vertex[p];
    if (!is_done_[a])
      improve(a, std::min(distance_[v] + distance_between(place(h), place(n)), plane_wave(h, p, n)));
    if (!is_done_[b])
      improve(b, std::min(distance_[v] + distance_between(place(h), place(p)), plane_wave(h, n, p)));
  }

  /// The time at which a plane wave that passed corners i and j arrives at corner k; infinity if it would not
  /// come from between them.
  double plane_wave(Index i, Index j, Index k) const
  {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (!is_done_[submesh_.vertex[j]])
      return never;
    const double length = distance_between(place(i), place(j));
    const double rise = distance_[submesh_.vertex[j]] - distance_[submesh_.vertex[i]];
    if (!(std::abs(rise) < length))
      return never;
    const Vector_3 along = (place(j) - place(i)) / length, to = place(k) - place(i);
    const double x = along * to, y = std::sqrt(std::max(0., to.squared_length() - x * x));
    const double slope = rise / length, across = std::sqrt(1 - slope * slope);
    const double foot = x - y * slope / across; // where the ray through corner k crosses the line i-j
    return foot >= 0 && foot <= length ? distance_[submesh_.vertex[i]] + slope * x + across * y : never;
  }

  const Surface& surface_;
  const Submesh& submesh_;
  std::vector<double> distance_;
  std::vector<std::uint8_t> is_done_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

} // namespace Atlas::internal

#endif
