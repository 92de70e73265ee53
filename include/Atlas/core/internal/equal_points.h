// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_EQUAL_POINTS_H
#define ATLAS_CORE_INTERNAL_EQUAL_POINTS_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace Atlas::internal {

inline bool is_finite(const Point_3& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

/// Gives vertices with exactly equal coordinates one number. O(n log n).
inline std::vector<Index> merge_equal_points(const std::vector<Point_3>& points)
{
  std::vector<Index> order(points.size()), representative(points.size());
  std::iota(order.begin(), order.end(), Index(0));
  // NaN breaks the order of floating-point numbers, so points that are not finite come last and stay alone.
  const auto less = [&](Index i, Index j) {
    const bool a = is_finite(points[i]), b = is_finite(points[j]);
    if (!a || !b)
      return a != b ? a : i < j;
    const Point_3 &p = points[i], &q = points[j];
    return p.x() != q.x()   ? p.x() < q.x()
           : p.y() != q.y() ? p.y() < q.y()
           : p.z() != q.z() ? p.z() < q.z()
                            : i < j;
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && is_finite(points[order[k]]) && points[order[k]] == points[order[k - 1]];
    representative[order[k]] = same ? representative[order[k - 1]] : order[k];
  }
  return representative;
}

} // namespace Atlas::internal

#endif
