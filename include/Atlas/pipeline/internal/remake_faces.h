// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_REMAKE_FACES_H
#define ATLAS_PIPELINE_INTERNAL_REMAKE_FACES_H

#include <Atlas/core/Packing.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/pipeline/internal/Pinned_charts.h>
#include <Atlas/pipeline/internal/count_angles.h>
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
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Unwraps some faces anew, and packs their charts around those of all others, which keep their
/// coordinates to the bit. Of the new charts those with pinned corners lie where these say.
///
/// Faces without finite coordinates are unwrapped too.
class Face_remaker
{
public:
  /// Makes the atlas of a part of the surface alone.
  using Run = std::function<Atlas_report(const Surface&, std::vector<Point_2>&)>;

  /// \param selection  per input face
  /// \param pages      per input face: the page of the coordinates that it keeps; empty: all are on the first
  /// \param uv         per input corner: the coordinates that there are
  Face_remaker(const Surface& surface, const std::vector<bool>& selection, const std::vector<Index>& pages,
               const Pins& pins, const std::vector<Point_2>& uv)
      : surface_(surface), pins_(pins), uv_(uv), pages_(pages)
  {
    require(selection.size() == surface.number_of_faces, "face_selection_map",
            "must tell of each face whether it is selected");
    require(uv.size() == surface.number_of_corners, "face_selection_map",
            "goes with the coordinates that the other faces have");
    require(pages.empty() || pages.size() == surface.number_of_faces, "face_page_map",
            "must have the page of each face");
    pages_.resize(surface.number_of_faces, 0);
    std::vector<bool> is_new = selection;
    for (std::size_t h = 0; h < surface.corner.size(); ++h) {
      const Point_2& p = uv[surface.corner[h]];
      if (!std::isfinite(p.x()) || !std::isfinite(p.y()))
        is_new[surface.face[h / 3]] = true;
    }
    for (std::size_t f = 0; f < pages_.size(); ++f) {
      require(is_new[f] || pages_[f] < max_pages, "face_page_map", "has a page that there cannot be");
      pages_[f] = is_new[f] ? 0 : pages_[f];
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
    fresh_ = charts_.size();
    const Segmentation kept = take_kept_charts(w, h);
    Pinned_charts pinned(part, report.segmentation, std::span(charts_).first(fresh_), pins_, uv_, page,
                         execution);
    const std::vector<Chart> flat = pinned.is_empty() ? std::vector<Chart>() : charts_;
    Certificate_options options{.width = page.width, .height = page.height, .gutter = page.gutter};
    Atlas_report result;
    do {
      if (!flat.empty())
        charts_ = flat;
      const Packing packing = pack(packer, page, report.density, pinned, execution);
      if (execution.is_cancelled() || packing.number_of_pages == 0) {
        report.status = execution.is_cancelled() ? Atlas_status::cancelled : Atlas_status::no_room;
        return report;
      }
      if (!pinned.is_empty() && !pinned.keeps_any() && kept_triangles_.empty()) {
        report.moved_pins = pinned.moved(); // the atlas is what it is without pins
        corner_uv = std::move(uv_of_part);
        return report;
      }
      place(part, report.segmentation, packing, pinned, w, h);
      result = report;
      summarize(result, kept, packing, page, pinned);
      options.gutter = gutter_of_kept(page.gutter, options, pinned, execution);
      result.certificate = certify(surface_, result_, result.face_page, options, execution);
    } while (!result.certificate.is_valid() && give_up_blamed(result.certificate, report, pinned));
    result.status = result.certificate.is_valid() ? Atlas_status::valid : Atlas_status::not_valid;
    corner_uv = std::move(result_);
    return result;
  }

private:
  /// How often charts with a single pin are laid out in another size ...
  static constexpr int most_densities = 8;
  /// ... until their density is that of the others but for this share.
  static constexpr double same_density = 0.02;

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
    std::vector<Point_2> apart = uv_; // no chart goes over pages
    for (std::size_t h = 0; h < rest_.corner.size(); ++h) {
      const Point_2& p = uv_[rest_.corner[h]];
      apart[rest_.corner[h]] = Point_2(p.x() + 2. * page_of_kept(h / 3), p.y());
    }
    Segmentation segmentation = charts_of_uv(rest_, apart);
    take_charts(rest_, segmentation, uv_, width, height);
    return segmentation;
  }

  /// Packs the new charts around those that have their places. Charts with a single pin get the density of
  /// the others, which falls as they grow: it is searched for by bisection.
  /// \param density  that of the new charts alone
  Packing pack(const Any_packer& packer, const Page_options& page, double density, Pinned_charts& pinned,
               const Execution& execution)
  {
    if (pinned.is_empty())
      return pack_once(packer, page, pinned, execution);
    const std::vector<Triangle_uv> stay = kept_on_page();
    pinned.lay(0, stay);
    if (page.density > 0)
      density = page.density;
    else if (pinned.keeps_any() || !stay.empty())
      density = pack_once(packer, page, pinned, execution).density;
    Packing packing;
    double low = 0, high = 0; // densities at which the others have more, and less
    for (int round = 0; round < most_densities && !execution.is_cancelled(); ++round) {
      pinned.lay(density, stay);
      packing = pack_once(packer, page, pinned, execution);
      if (page.density > 0 || !pinned.has_moved() ||
          std::abs(packing.density - density) <= same_density * density)
        break;
      (packing.density > density ? low : high) = density;
      if (low > 0 && high > 0)
        density = std::sqrt(low * high);
      else
        density = packing.density > 0 ? packing.density : density / 2;
    }
    const auto is_any = [](Index) { return true; };
    if (packing.number_of_pages == 0 && pinned.give_up(Pin_fault::no_room, is_any))
      packing = pack_once(packer, page, pinned, execution);
    return packing;
  }

  Packing pack_once(const Any_packer& packer, const Page_options& page, const Pinned_charts& pinned,
                    const Execution& execution)
  {
    Page_options room = page;
    room.locked.assign(fresh_, std::nullopt);
    for (std::size_t c = fresh_; c < charts_.size(); ++c)
      room.locked.push_back(Placement{.page = page_of_kept(charts_[c].source.front())});
    for (const Pinned_charts::Pinned_chart& p : pinned.list()) {
      charts_[p.chart].uv = p.is_kept() ? pinned.texels(p) : p.flat.uv;
      if (p.is_kept())
        room.locked[p.chart] = Placement();
    }
    return packer.pack(charts_, room, execution);
  }

  /// \param t  of the part that stays
  Index page_of_kept(std::size_t t) const { return pages_[surface_.face[kept_triangles_[t]]]; }

  /// The triangles that stay on the first page, where pins are.
  std::vector<Triangle_uv> kept_on_page() const
  {
    std::vector<Triangle_uv> result;
    for (std::size_t h = 0; h < rest_.corner.size(); h += 3)
      if (page_of_kept(h / 3) == 0)
        result.push_back({uv_[rest_.corner[h]], uv_[rest_.corner[h + 1]], uv_[rest_.corner[h + 2]]});
    return result;
  }

  /// The gutter that can be asked for: what has its place may be nearer to each other, or touch where what
  /// was between is unwrapped.
  double gutter_of_kept(double gutter, Certificate_options options, const Pinned_charts& pinned,
                        const Execution& execution) const
  {
    options.gutter = gutter;
    if (kept_triangles_.empty() && !pinned.keeps_any())
      return gutter;
    std::vector<bool> is_placed(is_new_);
    is_placed.flip();
    for (const Pinned_charts::Pinned_chart& p : pinned.list())
      if (p.is_kept())
        for (const Index t : p.flat.source)
          is_placed[triangles_[t]] = true;
    std::vector<Index> numbers;
    const Surface placed = part_of_surface(
        surface_, [&](Index t) { return is_placed[t]; }, numbers);
    const Atlas_certificate kept = certify(placed, result_, pages_, options, execution);
    return std::min({gutter, kept.chart_distance, 2 * std::max(0., kept.page_border_distance)});
  }

  /// Gives up the pins of charts that the certificate blames. Returns whether there are any.
  static bool give_up_blamed(const Atlas_certificate& certificate, const Atlas_report& of_part,
                             Pinned_charts& pinned)
  {
    std::vector<bool> is_blamed(of_part.charts.size(), false);
    for (const Index face : certificate.culprits)
      if (const Index c = of_part.face_chart[face]; c != no_index)
        is_blamed[c] = true;
    return pinned.give_up(certificate.overlaps_between_charts > 0 ? Pin_fault::covers_chart
                                                                  : Pin_fault::not_one_to_one,
                          [&](Index c) { return is_blamed[c]; });
  }

  /// Puts the first charts on their pages, and writes their coordinates.
  void place(const Surface& part, const Segmentation& segmentation, const Packing& packing,
             const Pinned_charts& pinned, double width, double height)
  {
    result_ = uv_;
    std::vector<char> use(uv_.size(), 0); // 1: of a corner that stays, 2: that is new
    for (std::size_t h = 0; h < surface_.corner.size(); ++h)
      use[surface_.corner[h]] = is_new_[h / 3] ? 2 : 1;
    std::vector<bool> is_ready(fresh_, false);
    for (const Pinned_charts::Pinned_chart& p : pinned.list())
      if (p.is_kept()) {
        charts_[p.chart].uv = p.on_page;
        is_ready[p.chart] = true;
      }
    for (std::size_t c = 0; c < fresh_; ++c) {
      Chart& chart = charts_[c];
      if (!is_ready[c]) {
        for (Point_2& p : chart.uv) {
          const Point_2 texel = packing.placements[c](p);
          p = Point_2(texel.x() / width, texel.y() / height);
        }
        straighten_borders(chart);
        (void)Grid_rounding(chart)(); // the certificate tells of what it cannot mend
        Cut_side_separator(part, segmentation, chart)();
      }
      for (std::size_t t = 0; t < chart.source.size(); ++t)
        for (Index i = 0; i < 3; ++i)
          result_[part.corner[3 * chart.source[t] + i]] = chart.uv[chart.triangles[t][i]];
    }
    std::size_t last = 0; // corners without a triangle go with the used one before them
    for (std::size_t c = 0; c < use.size(); ++c)
      if (use[c] != 0)
        last = c;
      else if (use[last] == 2 && !(c < pins_.is_pinned.size() && pins_.is_pinned[c]))
        result_[c] = result_[last];
  }

  /// What the report says of charts and pages: of all of them, in the order of their first triangles.
  void summarize(Atlas_report& report, const Segmentation& kept, const Packing& packing,
                 const Page_options& page, const Pinned_charts& pinned) const
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
    enter(kept, kept_triangles_, fresh_);
    std::vector<Index> number(count, no_index);
    std::vector<Chart_report> charts;
    report.face_chart.assign(surface_.number_of_faces, no_index);
    report.face_page = pages_;
    for (Index t = 0; t < whole.chart.size(); ++t) {
      const Index c = whole.chart[t];
      if (number[c] == no_index) {
        number[c] = static_cast<Index>(charts.size());
        charts.push_back(c < fresh_ ? report.charts[c] : report_of(charts_[c]));
      }
      whole.chart[t] = number[c];
      report.face_chart[surface_.face[t]] = number[c];
      report.face_page[surface_.face[t]] = packing.placements[c].page;
    }
    report.moved_pins = pinned.moved();
    for (Moved_pins& moved : report.moved_pins)
      moved.chart = number[moved.chart];
    report.charts = std::move(charts);
    if (pinned.keeps_any())
      summarize_pinned(report, page, pinned, number);
    report.area = area_3d(surface_);
    report.seam_length = seam_length(surface_, whole);
    report.segmentation = std::move(whole);
    report.pages = packing.number_of_pages;
    report.density = packing.density;
    report.faces = surface_.number_of_faces;
    report.triangles = surface_.number_of_triangles();
    report.packing_efficiency =
        covered_texels(page) / (double(page.width) * page.height * double(report.pages));
  }

  /// The figures of charts that are stretched between pins, and those of the atlas with them.
  void summarize_pinned(Atlas_report& report, const Page_options& page, const Pinned_charts& pinned,
                        const std::vector<Index>& number) const
  {
    std::vector<Chart> in_texels(charts_.begin(), charts_.begin() + static_cast<std::ptrdiff_t>(fresh_));
    std::vector<Triangle_distortion> all;
    for (Chart& chart : in_texels) {
      for (Point_2& p : chart.uv)
        p = Point_2(p.x() * page.width, p.y() * page.height);
      const std::vector<Triangle_distortion> own = triangle_distortions(chart);
      all.insert(all.end(), own.begin(), own.end());
    }
    for (const Pinned_charts::Pinned_chart& p : pinned.list()) {
      if (!p.is_kept() || !p.is_stretched())
        continue;
      Chart_report& chart = report.charts[number[p.chart]];
      const std::vector<Triangle_distortion> own = triangle_distortions(in_texels[p.chart]);
      chart = report_of(in_texels[p.chart]);
      chart.stretch = stretch_quantile(own, report.bound.stretch_share);
      chart.is_within_bound = chart.area == 0 || used_share(own, report.bound) <= 1;
      if (!chart.is_within_bound)
        chart.reason = Excess_reason::not_asked_for;
    }
    report.distortion = summarize_distortion(all);
    report.gradient_angles = {};
    count_angles(in_texels, report.gradient_angles);
    report.charts_beyond_bound = static_cast<std::size_t>(
        std::count_if(report.charts.begin(), report.charts.end(),
                      [](const Chart_report& chart) { return !chart.is_within_bound; }));
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
  double covered_texels(const Page_options& page) const
  {
    double texels = 0;
    for (std::size_t c = 0; c < charts_.size(); ++c)
      texels += std::abs(area_uv(charts_[c])) * (c < fresh_ ? double(page.width) * page.height : 1);
    return texels;
  }

  const Surface& surface_;
  const Pins& pins_;
  Surface rest_; ///< what stays
  const std::vector<Point_2>& uv_;
  std::vector<Index> pages_;                      ///< per input face: of those that stay, of all others 0
  std::vector<bool> is_new_;                      ///< per triangle
  std::vector<Index> triangles_, kept_triangles_; ///< of the part, and of the rest: those of the surface
  std::size_t fresh_ = 0;                         ///< how many charts are new
  std::vector<Chart> charts_;                     ///< the new ones, then those that stay
  std::vector<Point_2> result_;
};

} // namespace Atlas::internal

#endif
