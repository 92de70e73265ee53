// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_DISTORTION_OPTIMIZER_H
#define ATLAS_PARAMETERIZATION_DISTORTION_OPTIMIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Flattening_record.h>
#include <Atlas/parameterization/internal/distortion/Multilevel_start.h>
#include <Atlas/parameterization/internal/distortion/distortion_minimizer.h>
#include <Atlas/parameterization/internal/geometry/normalize_area.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief When the optimisation of a chart ends.
struct Distortion_options
{
  static constexpr std::size_t default_max_iterations = 60;
  static constexpr double default_tolerance = 2e-4;

  std::size_t max_iterations = default_max_iterations;
  /// The optimisation ends when an iteration lowers the energy by less than this part of it.
  double tolerance = default_tolerance;
  /// The optimisation ends when the mean energy over that of an isometry is at most this; 0 stands for never.
  double target = 0;
};

/// \brief Lowers the mean over a chart without flips of an energy of the singular values: the common part of
/// `Symmetric_dirichlet_optimizer`, `MIPS_optimizer` and `Stretch_optimizer`.
///
/// Newton's method: Hessians made semidefinite triangle by triangle in closed form; one symbolic
/// factorization for all iterations; steps that stop before the first triangle turns over, confirmed by exact
/// predicates. No triangle is ever flipped. A border that does not touch itself never will: when a step would
/// make it, a barrier energy between the border's vertices and edges joins in (Smith and Schaefer, Bijective
/// parameterization with free boundaries, 2015). In the end the chart's area in the plane is its area in
/// space.
///
/// Charts of some thousand vertices are optimised from coarse to fine: on coarser meshes of the chart first,
/// each of a quarter of the vertices, whose minimum is the start of the next (in the manner of hierarchical
/// parameterizations: Hormann, Greiner and Campagna 1999).
///
/// Cost: a sparse factorization of order 2n per iteration; as a rule 2 to 5 iterations at full size.
template <typename Energy>
class Distortion_optimizer
{
public:
  explicit Distortion_optimizer(Distortion_options options = {}) : options_(options) {}

  /// \return `valid` if the map is one-to-one in the end, as it is if it was in the beginning; `overlapping`
  /// if only its border still crosses itself; `flipped` for a map with flips, which is left alone
  Chart_status optimize(Chart& chart, const Execution& execution) const
  {
    Distortion_record record;
    return optimize(chart, execution, record);
  }

  Chart_status optimize(Chart& chart, const Execution& execution, Distortion_record& record) const
  {
    record = {};
    const internal::Chart_geometry geometry(chart);
    std::vector<internal::Complex> u(chart.number_of_vertices());
    for (std::size_t v = 0; v < u.size(); ++v)
      u[v] = {geometry.from_model(chart.uv[v].x()), geometry.from_model(chart.uv[v].y())};
    internal::Distortion_minimizer<Energy> minimizer(geometry, std::move(u));
    record.before = record.after = minimizer.mean_energy() / Energy::isometry;
    if (minimizer.has_flip() || chart.triangles.empty())
      return Chart_status::flipped;
    minimizer.scale(minimizer.best_scale());
    const double target = options_.target * Energy::isometry;
    if (minimizer.mean_energy() > target) {
      internal::Multilevel_start<Energy> start(geometry, minimizer.borders(), minimizer.coordinates());
      if (start(options_.max_iterations, options_.tolerance, execution) &&
          minimizer.adopt(start.coordinates()) && start.is_guarded())
        minimizer.guard();
    }
    record.iterations = minimizer.minimize(options_.max_iterations, options_.tolerance, target, execution);
    minimizer.scale(internal::density_correction(geometry, minimizer.coordinates()));
    internal::store_coordinates(geometry, minimizer.coordinates(), 1, chart);
    record.after = minimizer.mean_energy() / Energy::isometry;
    record.was_border_guarded = minimizer.is_guarded();
    if (execution.is_cancelled())
      return Chart_status::cancelled;
    return minimizer.is_border_simple() ? Chart_status::valid : Chart_status::overlapping;
  }

private:
  Distortion_options options_;
};

} // namespace Atlas

#endif
