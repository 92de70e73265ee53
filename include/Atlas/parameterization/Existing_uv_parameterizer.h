// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_EXISTING_UV_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_EXISTING_UV_PARAMETERIZER_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>

#include <span>

namespace Atlas {

/// \brief Takes coordinates that exist, such as those of a file; another parameterizer flattens the charts
/// that have none.
///
/// A chart that lies face down in the plane is turned over. With `Patch_segmentation` on a surface whose
/// patches are the charts of the same coordinates (`constrain_to_uv()`), `generate_atlas()` keeps the shape
/// of every chart that is one-to-one, splits the others, gives all of them the same density, and packs them
/// anew.
class Existing_uv_parameterizer
{
public:
  /// \param surface    the surface the charts will come from; must outlive this object
  /// \param corner_uv  per input corner; not finite where there are none; must outlive this object
  /// \param fallback   flattens charts that have corners without finite coordinates, or no area in the plane:
  /// any model of `ChartParameterizer`
  /// \throws Invalid_argument unless there are coordinates for each corner of the surface's input
  Existing_uv_parameterizer(const Surface& surface, std::span<const Point_2> corner_uv,
                            Any_parameterizer fallback = Bijective_parameterizer());

  /// \return `valid`, also for coordinates that are not one-to-one; or what the fallback returns
  /// \throws Invalid_argument if the chart is not one of the surface
  Chart_status parameterize(Chart& chart, const Execution& execution) const;

private:
  bool take(Chart& chart) const;

  const Surface* surface_;
  std::span<const Point_2> corner_uv_;
  Any_parameterizer fallback_;
};

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/parameterization/internal/Existing_uv_parameterizer_impl.h>
#endif

#endif
