// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_CUT_ZIPPER_H
#define ATLAS_PIPELINE_INTERNAL_CUT_ZIPPER_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/core/internal/cuts.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/pipeline/internal/Tail_slitter.h>
#include <Atlas/pipeline/internal/tiny_charts.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Zips cuts that end inside a chart, from there on, as far as nobody needs them.
///
/// Merging leaves cuts as long as the borders were that they come from. Where they run over places with
/// little curvature, the chart is as flat without them. So a cut is zipped over vertices whose curvature is
/// little together, and that stays if little more of the chart is stretched farther than wanted.
class Cut_zipper
{
public:
  /// Flattens and validates a chart. Called from several threads.
  using Flatten = std::function<Flattened_chart(Chart)>;
  /// Only lays a chart flat; one that has coordinates is near its best. Called from several threads.
  using Lay_flat = std::function<Chart_status(Chart&)>;

  /// \param wanted  stretch that as little as possible shall exceed
  Cut_zipper(const Surface& surface, Segmentation& segmentation, double wanted, Flatten flatten,
             Lay_flat lay_flat, const Execution& execution)
      : surface_(surface), segmentation_(segmentation), stretched_(wanted), flatten_(std::move(flatten)),
        lay_flat_(std::move(lay_flat)), execution_(execution), unit_(std::sqrt(area_3d(surface))),
        local_(surface.number_of_triangles())
  {}

  /// Charts are those of the segmentation.
  void run(std::vector<Flattened_chart>& charts)
  {
    execution_.for_each(charts.size(), [&](std::size_t i) {
      if (charts[i].verdict.is_valid() && !is_unrolled(charts[i])) // nets of hard surfaces keep their shape
        zip(charts[i]);
    });
  }

private:
  /// What the zipped vertices of a cut may have of curvature in sum, tried in this order: the angle that is
  /// missing around them to a full one.
  static constexpr std::array curvatures{1.2, 0.5, 0.2};
  /// By which the share of the surface that is stretched too far may grow for the length of a zip, in roots
  /// of the surface's area.
  static constexpr double greatest_rate = 0.0075;
  /// Zips that are shorter, in the same unit, are not worth the time.
  static constexpr double least_length = 0.01;

  void zip(Flattened_chart& f)
  {
    std::optional<double> of_copy; // of the chart as it is
    for (const Cut& cut : cuts_of(f.chart)) {
      std::size_t last = 0;
      for (const double curvature : curvatures) {
        const std::size_t n = number_of_flat(cut, curvature);
        const double length =
            std::accumulate(cut.length.begin(), cut.length.begin() + static_cast<std::ptrdiff_t>(n), 0.);
        if (length < least_length * unit_ || execution_.is_cancelled())
          break;
        if (n != std::exchange(last, n) && is_zipped(f, std::span(cut.edges).first(n), length, of_copy))
          break;
      }
    }
  }

  /// A cut from its end inside the chart outwards.
  struct Cut
  {
    std::vector<Index> edges; ///< halfedges of the surface
    std::vector<double> length;
    std::vector<double> curvature; ///< per edge that of the vertex at its inner end
  };

  static std::size_t number_of_flat(const Cut& cut, double limit)
  {
    double sum = 0;
    std::size_t result = 0;
    for (std::size_t i = 0; i < cut.edges.size() && std::abs(sum) <= 2 * limit; ++i)
      if (sum += cut.curvature[i]; std::abs(sum) <= limit)
        result = i + 1;
    return result;
  }

  /// Zips edges if the chart is good without them.
  /// \param of_copy  see is_promising()
  bool is_zipped(Flattened_chart& f, std::span<const Index> edges, double length,
                 std::optional<double>& of_copy)
  {
    for (const Index h : edges)
      set_cut(surface_, segmentation_, h, false);
    Chart zipped = extract_chart(surface_, segmentation_, f.chart.source, local_);
    const double most_growth = greatest_rate * length * unit_;
    if (is_promising(zipped, f.chart, most_growth, of_copy)) {
      Flattened_chart now = flatten_(std::move(zipped));
      if (now.verdict.is_valid() && stretched_(now.chart) - stretched_(f.chart) <= most_growth) {
        f = std::move(now);
        of_copy.reset();
        return true;
      }
    }
    for (const Index h : edges)
      set_cut(surface_, segmentation_, h, true);
    return false;
  }

  /// Whether coarse copies of a large chart, with and without a zip, leave hope for it. Copies are stretched
  /// farther than the chart, and so may be what the zip adds.
  /// \param of_copy  stretched area of a copy of the chart without the zip, once that is known
  bool is_promising(const Chart& zipped, const Chart& chart, double most_growth,
                    std::optional<double>& of_copy) const
  {
    constexpr double triangles = 2500, hope = 3, hope_of_copies = 0.15;
    Chart after = coarse_copy(zipped, triangles);
    if (after.number_of_triangles() == zipped.number_of_triangles())
      return true;
    if (!of_copy) {
      Chart before = coarse_copy(chart, triangles);
      if (lay_flat_(before) != Chart_status::valid)
        return true;
      of_copy = stretched_(before);
    }
    return lay_flat_(after) != Chart_status::valid ||
           stretched_(after) - *of_copy <= hope * most_growth + hope_of_copies * *of_copy;
  }

  std::vector<Cut> cuts_of(const Chart& chart) const
  {
    const std::vector<Index> opposite = opposite_halfedges(chart.triangles);
    const auto tail = [&](Index h) { return chart.triangles[h / 3][h % 3]; };
    const auto head = [&](Index h) { return tail(next_halfedge(h)); };
    const auto of_surface = [&](Index h) { return 3 * chart.source[h / 3] + h % 3; };
    std::vector<Index> leaving(chart.number_of_vertices(), no_index), arriving = leaving, border;
    for (Index h = 0; h < opposite.size(); ++h)
      if (opposite[h] == no_index) {
        leaving[tail(h)] = arriving[head(h)] = h;
        border.push_back(h);
      }
    const std::vector<double> angle = angles_around_vertices(chart);
    std::vector<Cut> cuts;
    std::size_t left = border.size();
    for (const Index h : border) {
      Cut cut;
      Index a = h, b = leaving[head(h)];
      double around = angle[head(h)];
      // Three edges of the border are the least that a disc has.
      while (surface_.opposite[of_surface(a)] == of_surface(b) && may_cross(surface_, of_surface(a)) &&
             left >= 5) {
        cut.edges.push_back(of_surface(a));
        cut.length.push_back(edge_length(surface_, of_surface(a)));
        cut.curvature.push_back(2 * std::numbers::pi - around);
        around = angle[tail(a)] + angle[head(b)];
        a = arriving[tail(a)];
        b = leaving[head(b)];
        left -= 2;
      }
      if (!cut.edges.empty())
        cuts.push_back(std::move(cut));
    }
    return cuts;
  }

  static std::vector<double> angles_around_vertices(const Chart& chart)
  {
    std::vector<double> result(chart.number_of_vertices(), 0);
    for (const auto& triangle : chart.triangles)
      for (int i = 0; i < 3; ++i) {
        const Point_3& p = chart.points[triangle[i]];
        result[triangle[i]] +=
            angle_between(chart.points[triangle[(i + 1) % 3]] - p, chart.points[triangle[(i + 2) % 3]] - p);
      }
    return result;
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  Stretched_area stretched_;
  Flatten flatten_;
  Lay_flat lay_flat_;
  const Execution& execution_;
  double unit_;              ///< root of the area of the surface
  std::vector<Index> local_; ///< scratch: per triangle of the surface; charts are disjoint
};

} // namespace Atlas::internal

#endif
