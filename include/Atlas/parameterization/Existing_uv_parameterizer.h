// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_EXISTING_UV_PARAMETERIZER_H
#define ATLAS_PARAMETERIZATION_EXISTING_UV_PARAMETERIZER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/concepts.h>
#include <Atlas/measure/area.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>

#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Takes coordinates that exist, such as those of a file; another parameterizer flattens the charts
/// that have none.
///
/// A chart that lies face down in the plane is turned over. With `Patch_segmentation` on a surface whose
/// patches are the charts of the same coordinates (`constrain_to_uv()`), `generate_atlas()` keeps the shape
/// of every chart that is one-to-one, splits the others, gives all of them the same density, and packs them
/// anew.
///
/// \tparam Fallback  flattens charts that have corners without finite coordinates, or no area in the plane
template <ChartParameterizer Fallback = Bijective_parameterizer<>>
class Existing_uv_parameterizer
{
public:
  /// \param surface    the surface the charts will come from; must outlive this object
  /// \param corner_uv  per input corner; not finite where there are none; must outlive this object
  Existing_uv_parameterizer(const Surface& surface, std::span<const Point_2> corner_uv,
                            Fallback fallback = Fallback())
      : surface_(&surface), corner_uv_(corner_uv), fallback_(std::move(fallback))
  {}

  Chart_status parameterize(Chart& chart, const Execution& execution) const
  {
    const double area = take(chart) ? area_uv(chart) : 0;
    if (area == 0)
      return fallback_.parameterize(chart, execution);
    if (area < 0)
      for (Point_2& p : chart.uv)
        p = Point_2(-p.x(), p.y());
    return Chart_status::valid;
  }

private:
  bool take(Chart& chart) const
  {
    chart.uv.assign(chart.number_of_vertices(), Point_2(0, 0));
    for (std::size_t t = 0; t < chart.triangles.size(); ++t)
      for (Index i = 0; i < 3; ++i) {
        const Point_2& p = corner_uv_[surface_->corner[3 * chart.source[t] + i]];
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()))
          return false;
        chart.uv[chart.triangles[t][i]] = p;
      }
    return true;
  }

  const Surface* surface_;
  std::span<const Point_2> corner_uv_;
  Fallback fallback_;
};

} // namespace Atlas

#endif
