// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_FIXED_BORDER_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_FIXED_BORDER_FIXED_BORDER_PARAMETERIZER_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/parameterization/internal/fixed_border/barycentric_map.h>
#include <Atlas/parameterization/internal/fixed_border/convex_weights.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <vector>

namespace Atlas {

namespace internal {

/// The border vertices, and those without triangles.
inline std::vector<bool> fixed_vertices(const Chart& chart, const std::vector<Index>& border)
{
  std::vector<bool> is_fixed(chart.number_of_vertices(), true);
  for (const auto& corner : chart.triangles)
    for (const Index v : corner)
      is_fixed[v] = false;
  for (const Index v : border)
    is_fixed[v] = true;
  return is_fixed;
}

/// \tparam Weights  one of those of convex_weights.h
template <typename Weights>
bool solve_barycentric(const Chart_geometry& geometry, const std::vector<bool>& is_fixed,
                       std::vector<Complex>& u)
{
  const Weight_entries entries = Weights::entries(geometry, is_fixed);
  return Weights::is_symmetric ? solve_symmetric(u.size(), is_fixed, entries, u)
                               : solve_unsymmetric(u.size(), is_fixed, entries, u);
}

inline bool solve_barycentric(Barycentric_weights weights, const Chart_geometry& geometry,
                              const std::vector<bool>& is_fixed, std::vector<Complex>& u)
{
  switch (weights) {
  case Barycentric_weights::cotangent:
    return solve_barycentric<Cotangent_weights>(geometry, is_fixed, u);
  case Barycentric_weights::mean_value:
    return solve_barycentric<Mean_value_weights>(geometry, is_fixed, u);
  case Barycentric_weights::shape_preserving:
    return solve_barycentric<Shape_preserving_weights>(geometry, is_fixed, u);
  }
  throw Invalid_argument("weights", "must be one of the enumeration");
}

ATLAS_INLINE Chart_status fixed_border_map(Barycentric_weights weights, Chart& chart,
                                           const Execution& execution)
{
  // Only so that border vertices in one place do not fall together.
  constexpr double least_share = 1e-6;
  check_chart(chart);
  chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
  const Injectivity_checker checker(chart);
  if (checker.borders().size() != 1)
    return Chart_status::not_a_disc;
  if (execution.is_cancelled())
    return Chart_status::cancelled;
  const Chart_geometry geometry(chart);
  const std::vector<Index>& border = checker.borders().front();
  std::vector<Complex> u(chart.number_of_vertices());
  place_on_circle(geometry, border, least_share, u);
  if (!solve_barycentric(weights, geometry, fixed_vertices(chart, border), u))
    return Chart_status::solver_failed;
  store_coordinates(geometry, u, density_correction(geometry, u), chart);
  return Chart_status::valid;
}

} // namespace internal

ATLAS_INLINE Chart_status Tutte_parameterizer::parameterize(Chart& chart, const Execution& execution) const
{
  internal::check_chart(chart);
  chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
  internal::Injectivity_checker checker(chart);
  if (checker.borders().size() != 1)
    return Chart_status::not_a_disc;
  const internal::Chart_geometry geometry(chart);
  const std::vector<Index>& border = checker.borders().front();
  std::vector<internal::Complex> u(chart.number_of_vertices()); // vertices without triangles: at the centre
  for (const double share : {least_share, 1.}) {
    if (execution.is_cancelled())
      return Chart_status::cancelled;
    internal::place_on_circle(geometry, border, share, u);
    if (!internal::solve_barycentric<internal::Equal_weights>(geometry,
                                                              internal::fixed_vertices(chart, border), u))
      return Chart_status::solver_failed;
    const double scale = internal::density_correction(geometry, u);
    for (internal::Complex& z : u)
      z *= scale;
    if (!checker.has_flip(u) && checker.is_border_simple(u))
      break;
  }
  internal::store_coordinates(geometry, u, 1, chart);
  return checker.is_one_to_one(u) ? Chart_status::valid : Chart_status::flipped;
}

} // namespace Atlas

#endif
