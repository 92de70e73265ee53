// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_FIXED_BORDER_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_FIXED_BORDER_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>

namespace Atlas {

/// \brief With which weights an inner vertex is the mean of its neighbours.
enum class Barycentric_weights {
  cotangent,       ///< half the sum of the cotangents of the angles opposite to an edge: Eck et al. 1995
  mean_value,      ///< Floater 2003; positive
  shape_preserving ///< Floater 1997; positive
};

namespace internal {

Chart_status fixed_border_map(Barycentric_weights weights, Chart& chart, const Execution& execution);

} // namespace internal

/// \brief Maps with the border on a circle, arcs in proportion to lengths, and every inner vertex a weighted
/// mean of its neighbours: the common part of the methods that the LSCM paper compares with.
///
/// The area of the disc is that of the chart. Cost: one sparse factorization, symmetric where the weights
/// are.
template <Barycentric_weights weights>
class Fixed_border_parameterizer
{
public:
  /// \return `not_a_disc` if there is not exactly one border loop; `solver_failed` without finite solution
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    return internal::fixed_border_map(weights, chart, execution);
  }
};

/// \brief Discrete harmonic maps: cotangent weights, the least Dirichlet energy (Eck et al. 1995). Flips
/// where angles are obtuse are possible.
using Harmonic_parameterizer = Fixed_border_parameterizer<Barycentric_weights::cotangent>;

/// \brief Mean value coordinates: positive weights, so one-to-one in exact arithmetic (Floater 2003).
using Mean_value_parameterizer = Fixed_border_parameterizer<Barycentric_weights::mean_value>;

/// \brief Shape preserving weights: positive, so one-to-one in exact arithmetic (Floater 1997).
using Floater_parameterizer = Fixed_border_parameterizer<Barycentric_weights::shape_preserving>;

/// \brief Barycentric map onto a disc with all weights equal: Tutte, How to draw a graph, 1963.
///
/// The border goes to a circle, every inner vertex to the mean of its neighbours. In exact arithmetic that is
/// one-to-one for every chart that is a disc, whatever the shapes of its triangles. In double precision,
/// parts deep inside long tubes shrink below resolution; so the result is checked exactly, and arcs in
/// proportion to the border's lengths are given up for equal ones if need be. The area of the disc is that of
/// the chart.
///
/// Cost: one or two real sparse factorizations of the inner vertices.
class Tutte_parameterizer
{
public:
  /// The part of the mean arc that the shortest border edge gets.
  static constexpr double least_share = 0.1;

  /// \return `valid` only if the map is one-to-one, proved by exact predicates; `flipped` if double precision
  /// does not suffice; `not_a_disc` if there is not exactly one border loop
  Chart_status parameterize(Chart& chart, const Execution& execution) const;
};

/// \brief A straight-line drawing of the chart on an integer grid: Schnyder 1990.
///
/// Built without floating-point arithmetic from the connectivity alone, so one-to-one for every disc, also
/// where Tutte's map shrinks below double precision. Shapes are as bad as can be: it is the last start for an
/// optimiser. Scaled by a power of two, to the chart's area within a factor of 4. Linear time but for the
/// sorting of edges.
class Schnyder_parameterizer
{
public:
  /// \return `valid`, or `not_a_disc`; the coordinates are then all zero
  Chart_status parameterize(Chart& chart, const Execution& execution) const;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/fixed_border/Fixed_border_parameterizer_impl.h>
#include <Atlas/parameterization/internal/fixed_border/Schnyder_parameterizer_impl.h>
#endif

#endif
