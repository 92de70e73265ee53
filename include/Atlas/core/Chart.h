// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_CHART_H
#define ATLAS_CORE_CHART_H

#include <Atlas/core/Kernel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Atlas {

/// \brief A piece of the surface as an indexed triangle mesh in flat arrays: what flattening, validation and
/// packing work on.
///
/// Vertices on a seam occur once per side, so a chart that borders itself is open along its seam. Corner `i`
/// of triangle `t` is corner `i` of the surface's triangle `source[t]`.
struct Chart
{
  std::vector<Point_3> points; ///< per vertex: position in space, unit of the model
  std::vector<std::array<Index, 3>>
      triangles;             ///< per triangle: its vertices, counterclockwise seen from outside
  std::vector<Index> source; ///< per triangle: the triangle of the surface it came from
  std::vector<Point_2> uv;   ///< per vertex: coordinates in the plane; empty before flattening

  std::size_t number_of_vertices() const { return points.size(); }
  std::size_t number_of_triangles() const { return triangles.size(); }
};

/// What is known of one chart. The order is that of severity.
enum class Chart_status {
  valid,               ///< accepted
  area_ratio_exceeded, ///< one-to-one, but densities vary more than asked for
  flipped,             ///< a triangle is turned over or has no area in the plane though it has area in space
  overlapping,         ///< two triangles cover each other in the plane
  not_a_disc,          ///< the chart is not homeomorphic to a disc
  solver_failed,       ///< the linear system could not be solved to finite numbers
  cancelled            ///< the caller asked to stop
};

/// A sentence for the user.
inline const char* message(Chart_status status)
{
  switch (status) {
  case Chart_status::valid:
    return "the chart is valid";
  case Chart_status::area_ratio_exceeded:
    return "the ratio of the largest to the smallest density in the chart exceeds the bound";
  case Chart_status::flipped:
    return "a triangle of the chart is flipped or flat in the plane";
  case Chart_status::overlapping:
    return "two triangles of the chart overlap in the plane";
  case Chart_status::not_a_disc:
    return "the chart is not homeomorphic to a disc";
  case Chart_status::solver_failed:
    return "the linear system of the flattening could not be solved";
  case Chart_status::cancelled:
    return "the caller asked to stop";
  }
  return "unknown status";
}

} // namespace Atlas

#endif
