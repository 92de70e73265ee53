// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_FIXED_BORDER_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_FIXED_BORDER_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/fixed_border/barycentric_map.h>
#include <Atlas/parameterization/internal/fixed_border/convex_weights.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <vector>

namespace Atlas {

/// \brief Maps with the border on a circle, arcs in proportion to lengths, and every inner vertex a weighted
/// mean of its neighbours: the common part of the methods that the LSCM paper compares with.
///
/// The area of the disc is that of the chart. Cost: one sparse factorization, symmetric where the weights
/// are.
template <typename Weights>
class Fixed_border_parameterizer
{
public:
  /// \return `not_a_disc` if there is not exactly one border loop; `solver_failed` without finite solution
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    const internal::Injectivity_checker checker(chart);
    if (checker.borders().size() != 1)
      return Chart_status::not_a_disc;
    if (execution.is_cancelled())
      return Chart_status::cancelled;
    const internal::Chart_geometry geometry(chart);
    std::vector<internal::Complex> u(chart.number_of_vertices());
    std::vector<bool> is_fixed(u.size(), true);
    for (const auto& corner : chart.triangles)
      for (const Index v : corner)
        is_fixed[v] = false;
    for (const Index v : checker.borders().front())
      is_fixed[v] = true;
    internal::place_on_circle(geometry, checker.borders().front(), least_share, u);
    const auto entries = Weights::entries(geometry, is_fixed);
    const bool is_solved = Weights::is_symmetric
                               ? internal::solve_symmetric(u.size(), is_fixed, entries, u)
                               : internal::solve_unsymmetric(u.size(), is_fixed, entries, u);
    if (!is_solved)
      return Chart_status::solver_failed;
    internal::store_coordinates(geometry, u, internal::density_correction(geometry, u), chart);
    return Chart_status::valid;
  }

private:
  /// Only so that border vertices in one place do not fall together.
  static constexpr double least_share = 1e-6;
};

/// \brief Discrete harmonic maps: cotangent weights, the least Dirichlet energy (Eck et al. 1995). Flips
/// where angles are obtuse are possible.
using Harmonic_parameterizer = Fixed_border_parameterizer<internal::Cotangent_weights>;

/// \brief Mean value coordinates: positive weights, so one-to-one in exact arithmetic (Floater 2003).
using Mean_value_parameterizer = Fixed_border_parameterizer<internal::Mean_value_weights>;

/// \brief Shape preserving weights: positive, so one-to-one in exact arithmetic (Floater 1997).
using Floater_parameterizer = Fixed_border_parameterizer<internal::Shape_preserving_weights>;

} // namespace Atlas

#endif
