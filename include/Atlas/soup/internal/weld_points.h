// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_WELD_POINTS_H
#define ATLAS_SOUP_INTERNAL_WELD_POINTS_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/core/internal/equal_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace Atlas::internal {

/// The longest side of the bounding box of the points that are finite.
inline double extent(const std::vector<Point_3>& points)
{
  std::array<double, 3> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  for (const Point_3& p : points)
    for (std::size_t k = 0; k < 3 && is_finite(p); ++k) {
      low[k] = std::min(low[k], p[static_cast<int>(k)]);
      high[k] = std::max(high[k], p[static_cast<int>(k)]);
    }
  double result = 0;
  for (std::size_t k = 0; k < 3; ++k)
    result = std::max(result, high[k] - low[k]);
  return result;
}

/// \brief Moves points that are nearer to each other than a tolerance to the same place: that of the first of
/// them. Chains of near points are one.
///
/// \param tolerance  as a share of the longest side of the bounding box, in (0, 0.1]
/// \return how many points have moved. O(n log n) where few points share a cell of that size
inline std::size_t weld_points(std::vector<Point_3>& points, double tolerance)
{
  using Cell = std::array<std::int64_t, 3>;
  const double size = tolerance * extent(points);
  if (!(size > 0))
    return 0;
  std::map<Cell, std::vector<Index>> cells;
  Union_find sets(points.size());
  for (Index v = 0; v < points.size(); ++v) {
    if (!is_finite(points[v]))
      continue;
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k)
      cell[k] = static_cast<std::int64_t>(std::floor(points[v][static_cast<int>(k)] / size));
    for (std::int64_t i = 0; i < 27; ++i)
      if (const auto near = cells.find({cell[0] + i / 9 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i % 3 - 1});
          near != cells.end())
        for (const Index w : near->second)
          if (CGAL::squared_distance(points[v], points[w]) <= size * size)
            sets.unite(v, w);
    cells[cell].push_back(v);
  }
  std::vector<Index> first(points.size(), no_index);
  std::size_t moved = 0;
  for (Index v = 0; v < points.size(); ++v) {
    Index& representative = first[sets.find(v)];
    if (representative == no_index)
      representative = v;
    moved += points[v] != points[representative] && is_finite(points[v]);
    if (is_finite(points[v]))
      points[v] = points[representative];
  }
  return moved;
}

} // namespace Atlas::internal

#endif
