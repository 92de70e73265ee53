// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_BIJECTIVE_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_BIJECTIVE_PARAMETERIZER_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/parameterization/Distortion_optimizer.h>

#include <vector>

namespace Atlas {

/// \brief Which charts are optimised.
enum class Optimize_charts {
  always,   ///< all, for low symmetric Dirichlet energy
  if_needed ///< those whose first map is not one-to-one, for a map that is, and is as conformal as that
            ///< allows
};

/// \brief Flattens every disc one-to-one: the chosen parameterizer, then an optimiser that cannot flip; where
/// that does not give a one-to-one map, the optimiser from Tutte's map; and where double precision does
/// not hold that, from Schnyder's drawing.
///
/// With `Optimize_charts::if_needed` the repaired map is led on to the least MIPS energy (Hormann and Greiner
/// 2000), which is conformal distortion, instead of the least symmetric Dirichlet energy.
///
/// One-to-one means: proved by exact predicates on the coordinates in double precision.
class Bijective_parameterizer
{
public:
  /// The first choice is `LSCM_parameterizer`.
  /// \param optimize  which charts are optimised
  /// \param options   when an optimisation ends
  /// \throws Invalid_argument if an option cannot be
  explicit Bijective_parameterizer(Optimize_charts optimize = Optimize_charts::always,
                                   const Distortion_options& options = {});

  /// \param first  the first choice: any model of `ChartParameterizer`
  Bijective_parameterizer(Optimize_charts optimize, const Distortion_options& options,
                          Any_parameterizer first);

  /// \return `valid` for every disc with area; else the reason
  Chart_status parameterize(Chart& chart, const Execution& execution) const;

  /// \copydoc parameterize
  /// \param record  what was wrong with the first choice, where the coordinates came from, and what the
  /// optimisation did
  Chart_status parameterize(Chart& chart, const Execution& execution, Flattening_record& record) const;

private:
  bool try_first(Chart& chart, const Execution& execution, Flattening_record& record) const;
  Chart_status optimize(Chart& chart, const Execution& execution, Flattening_record& record) const;

  Optimize_charts when_;
  Distortion_options options_;
  Any_parameterizer first_;
};

/// \brief Lays charts that are regular grids of quadrilaterals out as rectangles, rows and columns on
/// straight lines; all others go to another parameterizer.
///
/// Strips of quadrilaterals, as of a road or a rope, keep a texture that runs along them straight. Each
/// column is as wide, and each row as high, as the edges across it are long on average, which is the least
/// squares fit. A grid is laid out so only if it keeps the bound then. A model of `RecordingParameterizer`.
/// Linear but for sorting.
class Straight_parameterizer
{
public:
  /// \param face   per triangle of the surface that the charts will come from: its face, as `Surface::face`
  /// \param other  flattens all other charts
  /// \param bound  on the distortion of a chart
  Straight_parameterizer(std::vector<Index> face, Any_parameterizer other, const Distortion_bound& bound);

  /// \return `valid` for a straight chart; else what the other parameterizer says
  /// \throws Invalid_argument if the chart is not one of the surface
  Chart_status parameterize(Chart& chart, const Execution& execution) const;
  /// \copydoc parameterize
  /// \param record  as the other parameterizer leaves it; as by default for a straight chart
  Chart_status parameterize(Chart& chart, const Execution& execution, Flattening_record& record) const;

private:
  std::vector<Index> face_;
  Any_parameterizer other_;
  Distortion_bound bound_;
};

/// \brief Unrolls charts that are developable; all others go to another parameterizer.
///
/// A chart is developable if it can be laid into the plane triangle by triangle with all lengths as they are,
/// within `max_stretch`, and does not cover itself there. So a box's net, a cylinder with a cut and a cone
/// keep their exact shape. The image is turned so that most of its border is parallel to the axes. A model of
/// `RecordingParameterizer`. O(n log n).
class Isometric_parameterizer
{
public:
  /// Largest stretch or compression of lengths at which a chart still counts as unrolled: what rounded
  /// positions leave. 1 / 2000 of the area may have more.
  static constexpr double max_stretch = 1.002;

  /// \param other  flattens charts that are not developable
  explicit Isometric_parameterizer(Any_parameterizer other);

  /// \return `valid` for an unrolled chart; else what the other parameterizer says
  Chart_status parameterize(Chart& chart, const Execution& execution) const;
  /// \copydoc parameterize
  /// \param record  as the other parameterizer leaves it; as by default for an unrolled chart
  Chart_status parameterize(Chart& chart, const Execution& execution, Flattening_record& record) const;

private:
  Any_parameterizer other_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/Bijective_parameterizer_impl.h>
#include <Atlas/parameterization/internal/isometric/Isometric_parameterizer_impl.h>
#include <Atlas/parameterization/internal/straight/Straight_parameterizer_impl.h>
#endif

#endif
