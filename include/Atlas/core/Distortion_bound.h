// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_DISTORTION_BOUND_H
#define ATLAS_CORE_DISTORTION_BOUND_H

#include <limits>

namespace Atlas {

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

/// A bound on the distortion of every chart: what is bounded, and by how much.
struct Distortion_bound
{
  Distortion_measure measure = Distortion_measure::symmetric_dirichlet;
  double max = std::numeric_limits<double>::infinity();
};

} // namespace Atlas

#endif
