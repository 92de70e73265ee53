// SPDX-License-Identifier: MIT
#ifndef ATLAS_MEASURE_INTERNAL_STRAIGHT_LAYOUT_H
#define ATLAS_MEASURE_INTERNAL_STRAIGHT_LAYOUT_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/Quad_grid.h>
#include <Atlas/measure/distortion.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace Atlas::internal {

/// Lines between the columns of a grid: each column is as wide as the edges across it are long on average,
/// which is the least squares fit.
/// \param length  of the edge at a line of the other family, per column: `length(column, line)`
template <typename Length>
std::vector<double> lines_of_grid(Index columns, Index lines, Length length)
{
  std::vector<double> result{0};
  for (Index c = 0; c < columns; ++c) {
    double sum = 0;
    for (Index l = 0; l < lines; ++l)
      sum += length(c, l);
    result.push_back(result.back() + sum / lines);
  }
  return result;
}

/// Lays a chart that is a regular grid of quadrilaterals out as a rectangle, rows and columns on straight
/// lines. False, and the chart as it was, if it is no such grid or exceeds the bound then.
/// \param face  per triangle of the surface
inline bool lay_out_straight(Chart& chart, const std::vector<Index>& face, const Distortion_bound& bound)
{
  const std::vector<Index> opposite = opposite_halfedges(chart.triangles);
  std::vector<Index> all(chart.number_of_triangles()), local(all), faces;
  std::iota(all.begin(), all.end(), Index(0));
  for (const Index t : chart.source)
    faces.push_back(face[t]);
  const Quad_grid grid(opposite, all, faces, local, [&](Index h) { return opposite[h] != no_index; });
  if (!grid.is_grid() || grid.is_tube())
    return false;
  const auto tail = [&](Index h) { return chart.triangles[h / 3][h % 3]; };
  const auto length = [&](Index h) {
    return std::sqrt(CGAL::squared_distance(chart.points[tail(h)], chart.points[tail(next_halfedge(h))]));
  };
  const Index m = grid.columns(), n = grid.rows();
  const std::vector<double> x = lines_of_grid(m, n + 1, [&](Index c, Index l) {
    return length(l < n ? grid.side(c, l, Quad_grid::bottom) : grid.side(c, n - 1, Quad_grid::top));
  });
  const std::vector<double> y = lines_of_grid(n, m + 1, [&](Index r, Index l) {
    return length(l < m ? grid.side(l, r, Quad_grid::left) : grid.side(m - 1, r, Quad_grid::right));
  });
  std::vector<Point_2> before(chart.number_of_vertices());
  before.swap(chart.uv);
  for (Index r = 0; r < n; ++r)
    for (Index c = 0; c < m; ++c) {
      chart.uv[tail(grid.side(c, r, Quad_grid::bottom))] = Point_2(x[c], y[r]);
      chart.uv[tail(grid.side(c, r, Quad_grid::right))] = Point_2(x[c + 1], y[r]);
      chart.uv[tail(grid.side(c, r, Quad_grid::top))] = Point_2(x[c + 1], y[r + 1]);
      chart.uv[tail(grid.side(c, r, Quad_grid::left))] = Point_2(x[c], y[r + 1]);
    }
  const std::vector<Triangle_distortion> measured = triangle_distortions(chart);
  const bool is_kept = std::all_of(measured.begin(), measured.end(),
                                   [](const Triangle_distortion& t) { return t.area_uv > 0; }) &&
                       used_share(measured, bound) <= 1;
  if (!is_kept)
    chart.uv.swap(before);
  return is_kept;
}

} // namespace Atlas::internal

#endif
