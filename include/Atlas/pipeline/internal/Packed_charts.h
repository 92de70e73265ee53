// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_PACKED_CHARTS_H
#define ATLAS_PIPELINE_INTERNAL_PACKED_CHARTS_H

#include <Atlas/core/Any_policies.h>
#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/core/internal/mean_weight.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/packing/internal/pages/single_layout.h>
#include <Atlas/pipeline/internal/Repeated_parts.h>

#include <CGAL/Bbox_2.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Charts and where they lie on pages.
struct Packed_charts
{
  Segmentation segmentation; ///< of the whole surface
  std::vector<Index> model;  ///< per chart: that of the models of parts which it is or is a copy of
  std::vector<Chart> charts; ///< in units of the model
  Packing packing;
  std::vector<bool> is_enlarged; ///< per chart, if any is
  std::size_t enlarged = 0;      ///< how many charts are larger than their area says, for their texels
  double coverage = 0;           ///< share of the pages that charts cover
};

/// \brief Packs flattened charts, and the copies of them on copies of parts.
class Chart_packing
{
public:
  /// \param area          of the surface without copies
  /// \param least_texels  charts are enlarged until they have so many. All else must outlive this object
  Chart_packing(const Surface& surface, const Repeated_parts& parts, const Any_packer& packer, double area,
                double least_texels, const Execution& execution)
      : surface_(surface), parts_(parts), packer_(packer), area_(area), least_texels_(least_texels),
        execution_(execution)
  {}

  /// The charts of the whole surface, not packed yet.
  Packed_charts charts(const Segmentation& segmentation, const std::vector<Flattened_chart>& flattened) const
  {
    Packed_charts result;
    result.segmentation = parts_.expand(surface_, segmentation, result.model);
    result.charts = parts_.expand(surface_, result.segmentation, flattened);
    return result;
  }

  void pack(Packed_charts& packed, Page_options page) const
  {
    if (!surface_.density_weight.empty())
      page.weights = weights_of(packed.charts, page);
    for (int round = 0; round < most_rounds && !execution_.is_cancelled(); ++round) {
      packed.packing = packer_.pack(packed.charts, page, execution_);
      if (!(least_texels_ > 0) || packed.packing.number_of_pages == 0 || !enlarge_small(packed, page.weights))
        break;
    }
    packed.coverage = coverage(packed, page);
  }

  /// A bound on the coverage, whatever the packer that keeps the gutter: each chart has to fit on the page
  /// alone.
  double most_coverage(const Packed_charts& packed, const Page_options& page) const
  {
    const bool is_plain = page.pages == 1 && !(page.density > 0) && !page.snaps && page.weights.empty() &&
                          page.groups.empty() && page.locked.empty() && surface_.density_weight.empty() &&
                          !(least_texels_ > 0);
    if (!is_plain)
      return 1;
    const double width = page.width, height = page.height, gutter = packed_gutter(packed, page);
    double area = 0, density = std::numeric_limits<double>::infinity();
    for (const Chart& chart : packed.charts) {
      area += std::abs(area_uv(chart));
      std::vector<Vec2> points;
      for (const Point_2& p : chart.uv)
        points.push_back({p.x(), p.y()});
      if (const std::vector<Vec2> hull = convex_hull(std::move(points)); hull.size() > 2)
        density = std::min(density, largest_scale_alone(hull, width - gutter, height - gutter));
    }
    return std::min(1.0, area * density * density / (width * height));
  }

private:
  /// Larger charts leave less density for all, so that more charts become small.
  static constexpr int most_rounds = 5;
  /// How many times as many texels as asked for charts get at first, for the density that is lost then.
  static constexpr double ample = 1.1;

  /// The gutter that is kept for sure. Packers make it smaller where even points do not fit the page.
  static double packed_gutter(const Packed_charts& packed, const Page_options& page)
  {
    const double gutter = page.effective_gutter();
    const double places = std::floor(page.width / (2 * gutter)) * std::floor(page.height / (2 * gutter));
    return static_cast<double>(packed.charts.size()) <= places ? gutter : 0;
  }

  static double texels_of(const Packed_charts& packed, std::size_t i)
  {
    const Placement& place = packed.packing.placements[i];
    return std::abs(area_uv(packed.charts[i])) * std::norm(std::complex(place.a, place.b)) * place.stretch_x *
           place.stretch_y;
  }

  /// Raises the weights of charts that have too few texels; false if there are none.
  bool enlarge_small(Packed_charts& packed, std::vector<double>& weights) const
  {
    weights.resize(packed.charts.size(), 1);
    bool is_any = false;
    packed.is_enlarged.resize(packed.charts.size(), false);
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (const double texels = texels_of(packed, i); texels > 0 && texels < least_texels_) {
        weights[i] *= std::sqrt(ample * least_texels_ / texels);
        packed.enlarged += !packed.is_enlarged[i];
        packed.is_enlarged[i] = is_any = true;
      }
    return is_any;
  }

  /// About the side of a texel, in units of the model.
  double texel(const Page_options& page) const
  {
    return std::sqrt(area_ / (double(page.width) * page.height));
  }

  /// The mean weight of each chart's triangles, but no chart is made smaller than about a texel by it.
  std::vector<double> weights_of(const std::vector<Chart>& charts, const Page_options& page) const
  {
    std::vector<double> weights(charts.size(), 1);
    execution_.for_each(charts.size(), [&](std::size_t i) {
      const Chart& chart = charts[i];
      const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
      const double extent = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
      weights[i] = mean_weight(surface_, chart);
      if (extent > 0)
        weights[i] = std::max(weights[i], std::min(1.0, texel(page) / extent));
    });
    return weights;
  }

  static double coverage(const Packed_charts& packed, const Page_options& page)
  {
    double texels = 0;
    for (std::size_t i = 0; i < packed.packing.placements.size(); ++i)
      if (packed.packing.layers.empty() || packed.packing.layers[i] == 0)
        texels += texels_of(packed, i);
    const double room = double(page.width) * page.height * packed.packing.number_of_pages;
    return room > 0 ? texels / room : 0;
  }

  const Surface& surface_;
  const Repeated_parts& parts_;
  const Any_packer& packer_;
  double area_, least_texels_;
  const Execution& execution_;
};

} // namespace Atlas::internal

#endif
