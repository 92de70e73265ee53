// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_ROUND_COORDINATES_H
#define ATLAS_PIPELINE_INTERNAL_ROUND_COORDINATES_H

#include <Atlas/core/Chart.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Coordinates of the page are stored as multiples of 2^-24: each of them in [0, 1] is a float, and so is any
/// difference, so that no later conversion rounds again.
inline constexpr double grid_cells = 16777216;

/// \brief Rounds the coordinates of one chart to the grid, and mends the triangles that rounding turns over.
///
/// Rounding can flatten or turn triangles of the size of a grid cell. A vertex of such a triangle is moved by
/// up to three cells to where the worst of the triangles around it is best. Nothing else moves, and never a
/// vertex that is fixed.
class Grid_rounding
{
public:
  /// \param is_fixed  per vertex whether it stays as it is; empty: none does
  explicit Grid_rounding(Chart& chart, std::vector<bool> is_fixed = {})
      : chart_(chart), is_fixed_(std::move(is_fixed))
  {
    is_fixed_.resize(chart.number_of_vertices(), false);
  }

  /// \return the triangles that remain flipped, and those that are flat though they have area in space;
  /// sorted.
  std::vector<Index> operator()()
  {
    for (std::size_t v = 0; v < chart_.uv.size(); ++v)
      if (Point_2& p = chart_.uv[v]; !is_fixed_[v])
        p = Point_2(snap(p.x()), snap(p.y()));
    std::vector<Index> bad = bad_triangles();
    for (int pass = 0; pass < maximal_passes && !bad.empty(); ++pass) {
      if (first_.empty())
        collect_stars();
      for (const Index t : bad)
        for (const Index v : chart_.triangles[t])
          if (!is_fixed_[v])
            improve(v);
      bad = bad_triangles();
    }
    return bad;
  }

private:
  static constexpr int maximal_passes = 8;
  static constexpr int reach = 3;

  static double snap(double x)
  {
    return std::clamp(std::round(x * grid_cells), 0.0, grid_cells) / grid_cells;
  }

  bool has_area(Index t) const
  {
    const auto& [a, b, c] = chart_.triangles[t];
    return !CGAL::collinear(chart_.points[a], chart_.points[b], chart_.points[c]);
  }

  std::vector<Index> bad_triangles() const
  {
    std::vector<Index> bad;
    for (Index t = 0; t < chart_.triangles.size(); ++t) {
      const auto& [a, b, c] = chart_.triangles[t];
      const auto turn = CGAL::orientation(chart_.uv[a], chart_.uv[b], chart_.uv[c]);
      if (turn == CGAL::RIGHT_TURN || (turn == CGAL::COLLINEAR && has_area(t)))
        bad.push_back(t);
    }
    return bad;
  }

  void collect_stars()
  {
    first_.assign(chart_.points.size() + 1, 0);
    for (const auto& triangle : chart_.triangles)
      for (const Index v : triangle)
        ++first_[v + 1];
    for (std::size_t v = 0; v < chart_.points.size(); ++v)
      first_[v + 1] += first_[v];
    star_.resize(3 * chart_.triangles.size());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (Index t = 0; t < chart_.triangles.size(); ++t)
      for (const Index v : chart_.triangles[t])
        star_[next[v]++] = t;
  }

  /// The area of the worst triangle around v, in grid cells: exact, as all coordinates are small integers
  /// there.
  double worst_area(Index v) const
  {
    double worst = std::numeric_limits<double>::infinity();
    for (Index k = first_[v]; k < first_[v + 1]; ++k) {
      const auto& [a, b, c] = chart_.triangles[star_[k]];
      worst = std::min(worst, CGAL::area(chart_.uv[a], chart_.uv[b], chart_.uv[c]));
    }
    return worst;
  }

  void improve(Index v)
  {
    const Point_2 start = chart_.uv[v];
    Point_2 best = start;
    double best_area = worst_area(v);
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j) {
        chart_.uv[v] = Point_2(snap(start.x() + i / grid_cells), snap(start.y() + j / grid_cells));
        if (const double area = worst_area(v); area > best_area) {
          best_area = area;
          best = chart_.uv[v];
        }
      }
    chart_.uv[v] = best;
  }

  Chart& chart_;
  std::vector<bool> is_fixed_;
  std::vector<Index> first_, star_; // the triangles around each vertex
};

} // namespace Atlas::internal

#endif
