// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_CHART_SLITTER_H
#define ATLAS_PIPELINE_INTERNAL_CHART_SLITTER_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/core/internal/cuts.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>
#include <Atlas/validation/internal/Worst_place.h>

#include <functional>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Why a flattened chart exceeds the bound once its coordinates are rounded.
inline Excess_reason reason_for_excess(const Surface& surface, const Flattened_chart& f,
                                       const Distortion_bound& bound)
{
  const std::vector<Index>& source = f.chart.source;
  if (surface.face[source.front()] == surface.face[source.back()])
    return Excess_reason::single_face;
  if (f.verdict.status == Chart_status::bound_exceeded)
    return Excess_reason::split_in_vain;
  if (f.verdict.status == Chart_status::area_ratio_exceeded)
    return Excess_reason::density_given_up;
  const bool is_kept = used_share(triangle_distortions(f.chart), bound) <= 1;
  return is_kept ? Excess_reason::rounded : Excess_reason::not_asked_for;
}

/// \brief Opens charts that exceed their bound by slits, where few of them will do.
///
/// A slit to the tip of a cone costs half of what a cut through it does, and the chart stays one. Seams that
/// the user forbids and diagonals of faces are no way for a slit; sharp edges are cheap.
class Chart_slitter
{
public:
  /// More slits than that in one chart make a comb: then two charts are better.
  static constexpr int maximal_slits = 2;
  /// A slit that does not end the matter lowers the distortion beyond 1 at least by this factor.
  static constexpr double least_gain = 0.8;

  /// \param flatten  flattens the chart of the given triangles with the cuts of that moment
  using Flatten = std::function<Flattened_chart(const std::vector<Index>&)>;

  Chart_slitter(const Surface& surface, Segmentation& segmentation)
      : surface_(surface), segmentation_(segmentation), costs_(surface, sharp_angle, sharp_discount)
  {}

  /// Changes nothing if slits do not bring the chart within the bound. Charts may be opened side by side.
  void operator()(Flattened_chart& f, const Distortion_bound& bound, const Flatten& flatten) const
  {
    std::vector<Index> cut;
    Flattened_chart opened = f;
    for (int i = 0; i < maximal_slits && opened.verdict.status == Chart_status::bound_exceeded; ++i) {
      const std::vector<Index> slit = slit_of(opened.chart);
      if (slit.empty())
        break;
      for (const Index h : slit)
        set_cut(surface_, segmentation_, h, true);
      cut.insert(cut.end(), slit.begin(), slit.end());
      Flattened_chart next = flatten(f.chart.source);
      if (!next.verdict.is_valid() && !(used(next, bound) <= least_gain * used(opened, bound)))
        break;
      opened = std::move(next);
    }
    if (opened.verdict.is_valid())
      f = std::move(opened);
    else
      for (const Index h : cut)
        set_cut(surface_, segmentation_, h, false);
  }

private:
  static constexpr double sharp_angle = std::numbers::pi / 4, sharp_discount = 0.75;

  static double used(const Flattened_chart& f, const Distortion_bound& bound)
  {
    return used_share(triangle_distortions(f.chart), bound);
  }

  /// Halfedges of the surface.
  std::vector<Index> slit_of(const Chart& chart) const
  {
    const auto of_surface = [&](Index h) { return 3 * chart.source[h / 3] + h % 3; };
    std::vector<Index> slit = Worst_place(chart, [&](Index h) {
                                const Seam_costs::Cost cost = costs_(of_surface(h));
                                return must_not_be_seam(surface_, of_surface(h))
                                           ? std::numeric_limits<double>::infinity()
                                           : cost.cost;
                              }).slit();
    for (Index& h : slit)
      h = of_surface(h);
    return slit;
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  Seam_costs costs_;
};

} // namespace Atlas::internal

#endif
