// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_CHART_H
#define ATLAS_CORE_CHART_H

#include <Atlas/core/Kernel.h>

#include <array>
#include <cstddef>
#include <limits>
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

  /// How many vertices there are.
  std::size_t number_of_vertices() const { return points.size(); }
  /// How many triangles there are.
  std::size_t number_of_triangles() const { return triangles.size(); }
};

/// What is known of one chart. The order is that of severity.
enum class Chart_status {
  valid,               ///< accepted
  bound_exceeded,      ///< one-to-one, but with more distortion than asked for
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
  case Chart_status::bound_exceeded:
    return "the distortion of the chart exceeds its bound";
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

/// What a bound on the distortion of a chart is about. All are at least 1, and 1 is best.
enum class Distortion_measure {
  symmetric_dirichlet,  ///< mean of (s1^2 + s2^2 + 1/s1^2 + 1/s2^2) / 4: both angles and areas
  l2_stretch,           ///< root mean square stretch (Sander et al. 2001)
  linf_stretch,         ///< largest stretch (Sander et al. 2001)
  area_ratio,           ///< largest over smallest density of area, of all triangles
  area_ratio_quantiles, ///< the same between the quantiles of 99 % and 1 % of the area
  quasi_conformal       ///< mean s1 / s2: angles only
};

/// The standard name of the figure, as in reports.
inline const char* name(Distortion_measure measure)
{
  switch (measure) {
  case Distortion_measure::symmetric_dirichlet:
    return "symmetric_dirichlet_mean";
  case Distortion_measure::l2_stretch:
    return "l2_stretch";
  case Distortion_measure::linf_stretch:
    return "linf_stretch";
  case Distortion_measure::area_ratio:
    return "area_ratio";
  case Distortion_measure::area_ratio_quantiles:
    return "area_ratio_quantiles";
  case Distortion_measure::quasi_conformal:
    return "quasi_conformal_mean";
  }
  return "unknown";
}

/// Whether the figure is an average over the chart, not one of its extremes.
inline bool is_mean(Distortion_measure measure)
{
  return measure == Distortion_measure::symmetric_dirichlet || measure == Distortion_measure::l2_stretch ||
         measure == Distortion_measure::quasi_conformal;
}

/// \brief A bound on the distortion of every chart: what is bounded, and by how much.
///
/// Means hide spots, so the stretch of single triangles is bounded too: with the chart scaled to its area in
/// space, max(s1, 1/s2), s1 >= s2 being the singular values of the map to the plane or, which gives the same
/// number, of its inverse.
struct Distortion_bound
{
  Distortion_measure measure = Distortion_measure::symmetric_dirichlet; ///< what is bounded
  double max = std::numeric_limits<double>::infinity();                 ///< its bound, at least 1
  double max_stretch = std::numeric_limits<double>::infinity();         ///< of a triangle, at least 1
  double stretch_share = 1; ///< of the chart's area, in (0, 1], has at most that stretch; 1: all triangles
};

/// \brief What the optimisation did to a chart.
struct Distortion_record
{
  double before = 0;          ///< mean energy over that of an isometry; infinite for a chart that had flips
  double after = 0;           ///< the same when it had ended
  std::size_t iterations = 0; ///< how many Newton steps it took
  bool was_border_guarded = false; ///< whether the border had to be kept from touching itself
};

/// Where the coordinates of a chart came from.
enum class Flattening_start {
  first_choice, ///< the parameterizer that was asked for, as a rule LSCM
  tutte,        ///< Tutte's map, because the first choice was not one-to-one
  schnyder      ///< a drawing on a grid, because Tutte's map needs more than double precision
};

/// A sentence for the user.
inline const char* message(Flattening_start start)
{
  switch (start) {
  case Flattening_start::first_choice:
    return "the chart keeps the map of the chosen parameterizer";
  case Flattening_start::tutte:
    return "the chosen parameterizer was not one-to-one; the chart starts from Tutte's map";
  case Flattening_start::schnyder:
    return "Tutte's map is below double precision; the chart starts from a drawing on a grid";
  }
  return "unknown start";
}

/// \brief What was done to flatten a chart.
struct Flattening_record
{
  Flattening_start start = Flattening_start::first_choice; ///< where the coordinates came from
  std::size_t flips = 0;        ///< triangles that the first choice turned over or made flat
  bool was_overlapping = false; ///< whether the first choice made the border cross or touch itself
  bool is_optimized = false;    ///< whether the optimiser had a part in the result
  Distortion_record distortion; ///< of the optimiser's last run
};

} // namespace Atlas

#endif
