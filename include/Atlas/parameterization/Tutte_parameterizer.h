// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_TUTTE_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_TUTTE_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/internal/fixed_border/barycentric_map.h>
#include <Atlas/parameterization/internal/geometry/injectivity.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <algorithm>
#include <vector>

namespace Atlas {

/// \brief Barycentric map onto a disc with all weights equal: Tutte, How to draw a graph, 1963.
///
/// The border goes to a circle, every inner vertex to the mean of its neighbours. In exact arithmetic that is
/// one-to-one for every chart that is a disc, whatever the shapes of its triangles. In double precision,
/// parts deep inside long tubes shrink below resolution; so the result is checked exactly, and arcs in
/// proportion to the border's lengths are given up for equal ones if need be. The area of the disc is that of
/// the chart.
///
/// Cost: one real sparse factorization of the inner vertices.
class Tutte_parameterizer
{
public:
  /// The part of the mean arc that the shortest border edge gets.
  static constexpr double least_share = 0.1;

  /// \return `valid` only if the map is one-to-one, proved by exact predicates; `flipped` if double precision
  /// does not suffice; `not_a_disc` if there is not exactly one border loop
  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    internal::Injectivity_checker checker(chart);
    if (checker.borders().size() != 1)
      return Chart_status::not_a_disc;
    const internal::Chart_geometry geometry(chart);
    std::vector<internal::Complex> u(chart.number_of_vertices());
    for (const double share : {least_share, 1.}) {
      if (execution.is_cancelled())
        return Chart_status::cancelled;
      internal::place_on_circle(geometry, checker.borders().front(), share, u);
      if (!solve(chart, checker.borders().front(), u))
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

private:
  static bool solve(const Chart& chart, const std::vector<Index>& border, std::vector<internal::Complex>& u)
  {
    std::vector<bool> is_fixed(u.size(), true);
    for (const auto& corner : chart.triangles)
      for (const Index v : corner)
        is_fixed[v] = false; // vertices without triangles stay at the centre
    for (const Index v : border)
      is_fixed[v] = true;
    // Every inner edge is met from both of its triangles, which doubles all weights alike.
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(6 * chart.triangles.size());
    for (const auto& corner : chart.triangles)
      for (int i = 0; i < 3; ++i) {
        const int v = static_cast<int>(corner[i]), w = static_cast<int>(corner[(i + 1) % 3]);
        entries.emplace_back(v, w, 0.5);
        entries.emplace_back(w, v, 0.5);
      }
    return internal::solve_symmetric(u.size(), is_fixed, entries, u);
  }
};

} // namespace Atlas

#endif
