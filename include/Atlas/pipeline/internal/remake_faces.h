// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_REMAKE_FACES_H
#define ATLAS_PIPELINE_INTERNAL_REMAKE_FACES_H

#include <Atlas/core/errors.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/pipeline/internal/round_coordinates.h>
#include <Atlas/pipeline/internal/run_atlas.h>
#include <Atlas/pipeline/internal/separate_cut_sides.h>
#include <Atlas/pipeline/internal/straighten_borders.h>
#include <Atlas/segmentation/internal/surface/part_of_surface.h>
#include <Atlas/validation/certify.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Unwraps some faces anew, and packs their charts around those of all others, which keep their
/// coordinates to the bit.
///
/// Faces without finite coordinates are unwrapped too.
class Face_remaker
{
public:
  /// Makes the atlas of a part of the surface alone.
  using Run = std::function<Atlas_report(const Surface&, std::vector<Point_2>&)>;

  /// \param selection  per input face
  /// \param uv         per input corner: the coordinates that there are
  Face_remaker(const Surface& surface, const std::vector<bool>& selection, const std::vector<Point_2>& uv)
      : surface_(surface), uv_(uv)
  {
    require(selection.size() == surface.number_of_faces, "face_selection_map",
            "must tell of each face whether it is selected");
    require(uv.size() == surface.number_of_corners, "face_selection_map",
            "goes with the coordinates that the other faces have");
    std::vector<bool> is_new = selection;
    for (std::size_t h = 0; h < surface.corner.size(); ++h) {
      const Point_2& p = uv[surface.corner[h]];
      if (!std::isfinite(p.x()) || !std::isfinite(p.y()))
        is_new[surface.face[h / 3]] = true;
    }
    is_new_.resize(surface.number_of_triangles());
    for (std::size_t t = 0; t < is_new_.size(); ++t)
      is_new_[t] = is_new[surface.face[t]];
    for (std::size_t h = 0; h < surface.corner.size(); ++h) {
      const Point_2& p = uv[surface.corner[h]];
      require(is_new_[h / 3] || (p.x() >= 0 && p.x() <= 1 && p.y() >= 0 && p.y() <= 1), "face_selection_map",
              "faces that are not selected must have coordinates in [0, 1]^2");
    }
  }

  /// \param corner_uv  output; untouched when there is no atlas
  Atlas_report operator()(const Run& run, const Any_packer& packer, const Page_options& page,
                          const Execution& execution, std::vector<Point_2>& corner_uv)
  {
    Surface part = part_of_surface(
        surface_, [&](Index t) { return is_new_[t]; }, triangles_);
    part.rejected = surface_.rejected;
    std::vector<Point_2> uv_of_part;
    Atlas_report report = run(part, uv_of_part);
    if (uv_of_part.empty())
      return report;
    const double w = page.width, h = page.height;
    take_charts(part, report.segmentation, uv_of_part, w / report.density, h / report.density);
    const std::size_t fresh = charts_.size();
    const Segmentation kept = take_kept_charts(w, h);
    Page_options room = page;
    room.locked.assign(fresh, std::nullopt);
    room.locked.resize(charts_.size(), Placement());
    const Packing packing = packer.pack(charts_, room, execution);
    if (packing.number_of_pages == 0 || execution.is_cancelled()) {
      report.status = execution.is_cancelled() ? Atlas_status::cancelled : Atlas_status::no_room;
      return report;
    }
    place(part, report.segmentation, packing, w, h, fresh);
    summarize(report, kept, packing, page, fresh);
    Certificate_options options{.width = page.width, .height = page.height, .gutter = page.gutter};
    options.gutter = gutter_of_kept(options, execution);
    report.certificate = certify(surface_, result_, report.face_page, options, execution);
    report.status = report.certificate.is_valid() ? Atlas_status::valid : Atlas_status::not_valid;
    corner_uv = std::move(result_);
    return report;
  }

private:
  /// Adds the charts of a part, with coordinates times two factors.
  void take_charts(const Surface& part, const Segmentation& segmentation, const std::vector<Point_2>& uv,
                   double along_u, double along_v)
  {
    for (Chart& chart : extract_charts(part, segmentation)) {
      chart.uv.resize(chart.number_of_vertices());
      for (std::size_t t = 0; t < chart.source.size(); ++t)
        for (Index i = 0; i < 3; ++i) {
          const Point_2& p = uv[part.corner[3 * chart.source[t] + i]];
          chart.uv[chart.triangles[t][i]] = Point_2(p.x() * along_u, p.y() * along_v);
        }
      charts_.push_back(std::move(chart));
    }
  }

  /// Adds the charts that stay, in texels, and gives their segmentation.
  Segmentation take_kept_charts(double width, double height)
  {
    rest_ = part_of_surface(
        surface_, [&](Index t) { return !is_new_[t]; }, kept_triangles_);
    Segmentation segmentation = charts_of_uv(rest_, uv_);
    take_charts(rest_, segmentation, uv_, width, height);
    return segmentation;
  }

  /// The gutter that can be asked for: what stays may be nearer to each other, or touch where what was
  /// between is unwrapped.
  double gutter_of_kept(const Certificate_options& options, const Execution& execution) const
  {
    if (kept_triangles_.empty())
      return options.gutter;
    const Atlas_certificate kept = certify(rest_, uv_, {}, options, execution);
    return std::min({options.gutter, kept.chart_distance, 2 * std::max(0., kept.page_border_distance)});
  }

  /// Puts the first charts on their pages, and writes their coordinates.
  void place(const Surface& part, const Segmentation& segmentation, const Packing& packing, double width,
             double height, std::size_t fresh)
  {
    result_ = uv_;
    std::vector<char> use(uv_.size(), 0); // 1: of a corner that stays, 2: that is new
    for (std::size_t h = 0; h < surface_.corner.size(); ++h)
      use[surface_.corner[h]] = is_new_[h / 3] ? 2 : 1;
    for (std::size_t c = 0; c < fresh; ++c) {
      Chart& chart = charts_[c];
      for (Point_2& p : chart.uv) {
        const Point_2 texel = packing.placements[c](p);
        p = Point_2(texel.x() / width, texel.y() / height);
      }
      straighten_borders(chart);
      (void)Grid_rounding(chart)(); // the certificate tells of what it cannot mend
      Cut_side_separator(part, segmentation, chart)();
      for (std::size_t t = 0; t < chart.source.size(); ++t)
        for (Index i = 0; i < 3; ++i)
          result_[part.corner[3 * chart.source[t] + i]] = chart.uv[chart.triangles[t][i]];
    }
    std::size_t last = 0; // corners without a triangle go with the used one before them
    for (std::size_t c = 0; c < use.size(); ++c)
      if (use[c] != 0)
        last = c;
      else if (use[last] == 2)
        result_[c] = result_[last];
  }

  /// What the report says of charts and pages: of all of them, in the order of their first triangles.
  void summarize(Atlas_report& report, const Segmentation& kept, const Packing& packing,
                 const Page_options& page, std::size_t fresh) const
  {
    const auto count = static_cast<Index>(charts_.size());
    Segmentation whole{std::vector<Index>(surface_.number_of_triangles()),
                       std::vector<std::uint8_t>(surface_.opposite.size(), 0), count};
    const auto enter = [&](const Segmentation& part, const std::vector<Index>& triangles, std::size_t first) {
      for (Index t = 0; t < triangles.size(); ++t) {
        whole.chart[triangles[t]] = part.chart[t] + static_cast<Index>(first);
        for (Index i = 0; i < 3; ++i)
          whole.cut[3 * triangles[t] + i] = part.cut[3 * t + i];
      }
    };
    enter(report.segmentation, triangles_, 0);
    enter(kept, kept_triangles_, fresh);
    std::vector<Index> number(count, no_index);
    std::vector<Chart_report> charts;
    report.face_chart.assign(surface_.number_of_faces, no_index);
    report.face_page.assign(surface_.number_of_faces, 0);
    for (Index t = 0; t < whole.chart.size(); ++t) {
      const Index c = whole.chart[t];
      if (number[c] == no_index) {
        number[c] = static_cast<Index>(charts.size());
        charts.push_back(c < fresh ? report.charts[c] : report_of(charts_[c]));
      }
      whole.chart[t] = number[c];
      report.face_chart[surface_.face[t]] = number[c];
      report.face_page[surface_.face[t]] = packing.placements[c].page;
    }
    report.charts = std::move(charts);
    report.segmentation = std::move(whole);
    report.pages = packing.number_of_pages;
    report.density = packing.density;
    report.faces = surface_.number_of_faces;
    report.triangles = surface_.number_of_triangles();
    report.packing_efficiency =
        covered_texels(fresh, page) / (double(page.width) * page.height * double(report.pages));
  }

  static Chart_report report_of(const Chart& chart)
  {
    Chart_report report;
    report.triangles = chart.number_of_triangles();
    report.area = area_3d(chart);
    report.distortion = report.unoptimized = summarize_distortion(triangle_distortions(chart));
    return report;
  }

  /// New charts are in coordinates of the page by now, the others in texels.
  double covered_texels(std::size_t fresh, const Page_options& page) const
  {
    double texels = 0;
    for (std::size_t c = 0; c < charts_.size(); ++c)
      texels += std::abs(area_uv(charts_[c])) * (c < fresh ? double(page.width) * page.height : 1);
    return texels;
  }

  const Surface& surface_;
  Surface rest_; ///< what stays
  const std::vector<Point_2>& uv_;
  std::vector<bool> is_new_;                      ///< per triangle
  std::vector<Index> triangles_, kept_triangles_; ///< of the part, and of the rest: those of the surface
  std::vector<Chart> charts_;                     ///< the new ones, then those that stay
  std::vector<Point_2> result_;
};

} // namespace Atlas::internal

#endif
