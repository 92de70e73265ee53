// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_DISTORTION_OPTIMIZER_H
#define ATLAS_PARAMETERIZATION_DISTORTION_OPTIMIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>

#include <cstddef>

namespace Atlas {

/// \brief When the optimisation of a chart ends.
struct Distortion_options
{
  static constexpr std::size_t default_max_iterations = 60; ///< of Newton steps
  static constexpr double default_tolerance = 2e-4; ///< relative decrease of the energy at which they end

  /// Charts of many vertices take fewer: a million over their number, but eight at least.
  std::size_t max_iterations = default_max_iterations;
  /// The optimisation ends when an iteration lowers the energy by less than this part of it; at least 0.
  double tolerance = default_tolerance;
  /// The optimisation ends when the mean energy over that of an isometry is at most this; 0 stands for never.
  double target = 0;
  /// Once the mean of the energy is least, that of this power of it is lowered in the same way: an exponent
  /// above 1 trades a little of the mean for much less distortion at the worst places. At least 1, which
  /// stands for the mean alone.
  unsigned tail_exponent = 1;
  /// Whether the chart's coordinates are near such a minimum already, as after a small change: then only the
  /// power is lowered if there is an exponent, and at full size.
  bool starts_near_minimum = false;
  /// In [0, 1], for `Distortion_energy::conformal_stretch` only: 0 is conformal, 1 is least stretch.
  double stretch_weight = 0.5;
  /// Whether border vertices keep their places, up to one scale for the whole chart: for charts with a border
  /// that was chosen, as harmonic maps have (Table 1 of the LSCM paper).
  bool keeps_border = false;
};

/// \brief What an optimiser minimises: the mean over a chart, weighted by area in space, of an energy of the
/// singular values x and y of each triangle's map.
enum class Distortion_energy {
  symmetric_dirichlet, ///< x^2 + y^2 + 1/x^2 + 1/y^2; an isometry has 4
  mips,                ///< x/y + y/x; every conformal map has 2
  stretch,             ///< (1/x^2 + 1/y^2) / 2 + x y; an isometry has 2
  conformal_stretch    ///< (1 - w) times `mips` plus w times `stretch`, w being `stretch_weight`
};

namespace internal {

/// Throws `Invalid_argument` if an option cannot be.
void check_options(const Distortion_options& options);

/// Lowers an energy of a chart that has coordinates.
Chart_status optimize_distortion(Distortion_energy energy, const Distortion_options& options, Chart& chart,
                                 const Execution& execution, Distortion_record& record);

} // namespace internal

/// \brief Lowers the distortion of a chart without flips: the common part of `Symmetric_dirichlet_optimizer`,
/// `MIPS_optimizer`, `Stretch_optimizer` and `Conformal_stretch_optimizer`.
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
template <Distortion_energy energy>
class Distortion_optimizer
{
public:
  /// \throws Invalid_argument unless tolerance and target are at least 0
  explicit Distortion_optimizer(Distortion_options options = {}) : options_(options)
  {
    internal::check_options(options_);
  }

  /// \return `valid` if the map is one-to-one in the end, as it is if it was in the beginning; `overlapping`
  /// if only its border still crosses itself; `flipped` for a map with flips, which is left alone
  /// \throws Invalid_argument unless the chart has coordinates for each vertex
  Chart_status optimize(Chart& chart, const Execution& execution) const
  {
    Distortion_record record;
    return optimize(chart, execution, record);
  }

  /// \copydoc optimize
  /// \param record  energies before and after, and the number of iterations at full size
  Chart_status optimize(Chart& chart, const Execution& execution, Distortion_record& record) const
  {
    return internal::optimize_distortion(energy, options_, chart, execution, record);
  }

private:
  Distortion_options options_;
};

/// \brief Brings the singular values near 1 everywhere: symmetric Dirichlet energy (Smith and Schaefer 2015),
/// with the secants of SLIM (Rabinovich et al. 2017) along the singular values. What
/// `Bijective_parameterizer` optimises by default.
///
/// Some 3 to 10 iterations from LSCM, more from Tutte's map.
using Symmetric_dirichlet_optimizer = Distortion_optimizer<Distortion_energy::symmetric_dirichlet>;

/// \brief Brings the singular values near each other, at any scale: most isometric parameterizations (Hormann
/// and Greiner 2000), a conformal map that cannot flip.
using MIPS_optimizer = Distortion_optimizer<Distortion_energy::mips>;

/// \brief Lowers the L2 stretch of Sander, Snyder, Gortler and Hoppe, Texture mapping progressive meshes,
/// 2001, with a free border, as the LSCM paper does for its Table 1.
///
/// Their method moves one vertex after another along random lines; this one finds the same minimum with
/// derivatives. The least mean of the record's energy over all scales of a chart is its L2 stretch.
using Stretch_optimizer = Distortion_optimizer<Distortion_energy::stretch>;

/// \brief Trades conformality for stretch by `Distortion_options::stretch_weight`, in one criterion, as the
/// LSCM paper proposes for the future.
///
/// With weight 0 it is `MIPS_optimizer`, with weight 1 `Stretch_optimizer`. As the weight rises, the minimum
/// has no less MIPS energy and no more stretch.
using Conformal_stretch_optimizer = Distortion_optimizer<Distortion_energy::conformal_stretch>;

/// \brief Leaves every chart as the parameterizer made it. A model of `UVOptimizer`.
struct Identity_optimizer
{
  /// \return `valid`
  [[nodiscard]] Chart_status optimize(Chart&, const Execution&) const { return Chart_status::valid; }
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/distortion/Distortion_optimizer_impl.h>
#endif

#endif
