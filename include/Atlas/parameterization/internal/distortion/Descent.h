// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_DESCENT_H
#define ATLAS_PARAMETERIZATION_INTERNAL_DISTORTION_DESCENT_H

#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/Distortion_optimizer.h>
#include <Atlas/parameterization/internal/distortion/distortion_minimizer.h>

#include <cmath>
#include <cstddef>

namespace Atlas::internal {

/// \brief Leads maps of one chart, on meshes of any fineness, to the least mean of an energy, and from there
/// to that of its power if the options have an exponent.
///
/// A map that comes from such a minimum on a coarser mesh is near both, so that the mean is left out.
template <typename Energy>
class Descent
{
public:
  using Minimizer = Distortion_minimizer<Power_of_energy<Energy>>;

  /// \param options  must outlive this object
  Descent(const Energy& energy, const Distortion_options& options)
      : energy_(energy), options_(options), is_near_(options.starts_near_minimum)
  {}

  /// The energy of which minimizers are made.
  Power_of_energy<Energy> mean() const { return {energy_}; }

  /// Ends early when the mean is at most `target`; 0 stands for never.
  /// \return the number of steps
  std::size_t operator()(Minimizer& minimizer, double target, const Execution& execution)
  {
    std::size_t steps = 0;
    if (!is_near_ || !has_tail())
      steps = minimizer.minimize(options_.max_iterations, options_.tolerance, target, execution);
    is_near_ = true;
    return steps + (has_tail() ? lower_tail(minimizer, execution) : 0);
  }

  /// The next map does not come from the last one.
  void start_over() { is_near_ = false; }

private:
  /// The mean of a power is larger and falls faster: its last digits gain nothing that is seen.
  static constexpr double tail_tolerance = 10;

  bool has_tail() const { return options_.tail_exponent > 1; }

  std::size_t lower_tail(Minimizer& minimizer, const Execution& execution) const
  {
    std::size_t steps = 0;
    minimizer.change_energy({energy_, options_.tail_exponent});
    if (std::isfinite(minimizer.mean_energy()))
      steps = minimizer.minimize(options_.max_iterations, tail_tolerance * options_.tolerance, 0, execution);
    minimizer.change_energy({energy_});
    return steps;
  }

  Energy energy_;
  const Distortion_options& options_;
  bool is_near_;
};

} // namespace Atlas::internal

#endif
