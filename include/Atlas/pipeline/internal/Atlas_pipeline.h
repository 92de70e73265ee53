// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_ATLAS_PIPELINE_H
#define ATLAS_PIPELINE_INTERNAL_ATLAS_PIPELINE_H

#include <Atlas/measure/distortion.h>
#include <Atlas/packing/internal/pages/least_page.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/pipeline/internal/Chart_flattener.h>
#include <Atlas/pipeline/internal/Packed_charts.h>
#include <Atlas/pipeline/internal/Page_cutter.h>
#include <Atlas/pipeline/internal/Repeated_parts.h>
#include <Atlas/pipeline/internal/count_angles.h>
#include <Atlas/pipeline/internal/idle_corners.h>
#include <Atlas/pipeline/internal/normalize.h>
#include <Atlas/pipeline/internal/round_coordinates.h>
#include <Atlas/pipeline/internal/run_atlas.h>
#include <Atlas/pipeline/internal/separate_cut_sides.h>
#include <Atlas/pipeline/internal/straighten_borders.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/validation/certify.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief One run from a surface to proved coordinates.
///
/// Data flows one way: segmentation -> charts -> flattened charts -> places on pages -> rounded coordinates
/// -> certificate. Charts that the certificate refuses go back to the flattener.
class Atlas_pipeline
{
public:
  /// Rounds of packing, rounding and verification before the faults that remain are reported.
  static constexpr int maximal_page_rounds = 6;

  /// \param policies  must outlive this object
  /// \param wishes    what charts do for their pages
  /// \param trade     when they are cut unless `wishes` ask for a coverage
  /// \param shared    which parts of the surface that are copies of others get the same charts
  Atlas_pipeline(const Surface& input, const Policies& policies, const Page_options& page,
                 const Page_wishes& wishes, const Cut_trade& trade, Chart_stacking shared, unsigned threads,
                 Progress progress)
      : surface_(input), model_(normalize(surface_)), policies_(policies), page_(page), wishes_(wishes),
        trade_(trade), execution_(threads), progress_(std::move(progress)), parts_(surface_, shared),
        charted_(parts_.is_empty() ? surface_ : parts_.models()),
        flattener_(charted_, charted_segmentation_, policies, execution_)
  {
    page_.density *= model_.unit;
  }

  /// \param corner_uv  per input corner; untouched when the run is cancelled or there is no surface
  Atlas_report run(std::vector<Point_2>& corner_uv)
  {
    describe_input();
    if (!(report_.area > 0) || !std::isfinite(report_.area))
      return report_;
    timed(Stage::segmentation, [&] { segment(); });
    timed(Stage::parameterization, [&] { flattener_.run(texel(), report_.bound); });
    for (int round = 0; !execution_.is_cancelled(); ++round) {
      timed(Stage::packing, [&] { pack(); });
      if (report_.pages == 0 && !execution_.is_cancelled()) {
        report_.status = Atlas_status::no_room;
        return report_;
      }
      std::vector<Index> refused;
      timed(Stage::verification, [&] { refused = verify(); });
      bool is_other = false;
      if (!refused.empty() && round < maximal_page_rounds)
        timed(Stage::parameterization, [&] { is_other = flattener_.replace(refused, rounding_faults_); });
      if (!is_other)
        break;
    }
    if (execution_.is_cancelled()) {
      report_.status = Atlas_status::cancelled;
      return report_;
    }
    summarize();
    corner_uv = std::move(corner_uv_);
    return report_;
  }

private:
  void describe_input()
  {
    report_.faces = surface_.number_of_faces;
    report_.triangles = surface_.number_of_triangles();
    report_.rejected = surface_.rejected;
    report_.page_width = page_.width;
    report_.page_height = page_.height;
    report_.gutter = page_.gutter;
    report_.area = area_3d(surface_);
    charted_area_ = parts_.is_empty() ? report_.area : area_3d(charted_);
    report_.bound = policies_.segmentation.bound().value_or(Distortion_bound());
  }

  template <typename Work>
  void timed(Stage stage, Work&& work)
  {
    if (execution_.is_cancelled())
      return;
    const auto start = std::chrono::steady_clock::now();
    if (progress_)
      execution_ =
          execution_.with_callback([this, stage](double fraction) { return progress_(stage, fraction); });
    if (execution_.proceed(0)) {
      work();
      (void)execution_.proceed(1);
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    report_.seconds[static_cast<std::size_t>(stage)] += elapsed.count();
  }

  void segment()
  {
    charted_segmentation_ = policies_.segmentation.segment(charted_, execution_);
    report_.segmented_charts = charted_segmentation_.number_of_charts;
    if (!execution_.is_cancelled())
      cut_to_discs(charted_, charted_segmentation_, execution_);
  }

  void pack()
  {
    const Chart_packing packing(surface_, parts_, policies_.packer, charted_area_,
                                wishes_.min_texels_per_chart, execution_);
    Packed_charts packed = packing.charts(charted_segmentation_, flattener_.charts());
    if (std::exchange(page_.has_free_aspect, false))
      set_page(least_page(packed.charts, page_, policies_.packer, execution_));
    packing.pack(packed, page_);
    cut_for_pages(packing, packed);
    if (execution_.is_cancelled())
      return;
    segmentation_ = std::move(packed.segmentation);
    charted_chart_ = std::move(packed.model);
    charts_ = std::move(packed.charts);
    packing_ = std::move(packed.packing);
    report_.enlarged_charts = packed.enlarged;
    report_.pages = packing_.number_of_pages;
    if (report_.pages > 0)
      round();
  }

  /// Cuts charts as the wishes for pages say.
  void cut_for_pages(const Chart_packing& packing, Packed_charts& packed)
  {
    Page_cutter cutter(charted_, packing, page_, wishes_.min_coverage, trade_, report_.bound, execution_);
    std::optional<Cut_charts> cut = cutter(charted_segmentation_, flattener_.charts(), packed);
    are_cuts_exhausted_ = cutter.is_exhausted();
    if (!cut || execution_.is_cancelled())
      return;
    report_.pieces_cut_for_pages += cut->packed.charts.size() - packed.charts.size();
    charted_segmentation_ = std::move(cut->segmentation);
    flattener_.take(std::move(cut->flattened));
    packed = std::move(cut->packed);
  }

  /// Puts charts on their pages, in coordinates that can be stored.
  void round()
  {
    report_.density = packing_.density / model_.unit;
    face_page_.assign(surface_.number_of_faces, 0);
    rounding_faults_.assign(charts_.size(), {});
    execution_.for_each(charts_.size(), [&](std::size_t i) {
      for (Point_2& p : charts_[i].uv) {
        const Point_2 texel = packing_.placements[i](p);
        p = turned_over(i, Point_2(texel.x() / page_.width, texel.y() / page_.height));
      }
      straighten_borders(charts_[i]);
      rounding_faults_[i] = Grid_rounding(charts_[i])();
      Cut_side_separator(surface_, segmentation_, charts_[i])();
    });
    for (std::size_t i = 0; i < charts_.size(); ++i)
      for (const Index t : charts_[i].source)
        face_page_[surface_.face[t]] = packing_.placements[i].page;
  }

  void set_page(const Page_options& page)
  {
    page_ = page;
    report_.page_width = page_.width;
    report_.page_height = page_.height;
  }

  /// Charts that lie face down, on a mirror image of theirs, are turned over with the page as long as they
  /// are worked on. Exact on the grid of rounded coordinates.
  Point_2 turned_over(std::size_t chart, const Point_2& p) const
  {
    return packing_.placements[chart].is_mirrored ? Point_2(1 - p.x(), p.y()) : p;
  }

  /// About the side of a texel, in units of the model.
  double texel() const { return std::sqrt(charted_area_ / (double(page_.width) * page_.height)); }

  /// The page of each face, where charts that lie on copies of theirs have pages of their own.
  std::vector<Index> pages_of_layers() const
  {
    std::vector<Index> pages = face_page_;
    for (std::size_t i = 0; i < packing_.layers.size(); ++i)
      for (const Index t : charts_[i].source)
        pages[surface_.face[t]] = packing_.placements[i].page + packing_.layers[i] * packing_.number_of_pages;
    return pages;
  }

  /// About the positions and in the unit of the model as it is given.
  Atlas_certificate certificate_of_model(const Certificate_options& options)
  {
    surface_.points.swap(model_.positions);
    Atlas_certificate result = certify(surface_, corner_uv_, pages_of_layers(), options, execution_);
    surface_.points.swap(model_.positions);
    result.pages = std::min(result.pages, report_.pages);
    result.seam_length *= model_.unit;
    result.density_min /= model_.unit;
    result.density_max /= model_.unit;
    return result;
  }

  /// Writes the coordinates to the corners and proves them. Returns the charts of the flattener to blame,
  /// sorted.
  std::vector<Index> verify()
  {
    write_corners();
    Certificate_options options;
    options.width = page_.width;
    options.height = page_.height;
    options.gutter = page_.gutter;
    report_.certificate = certificate_of_model(options);
    std::vector<bool> refused(flattener_.charts().size(), false);
    for (std::size_t i = 0; i < charts_.size(); ++i)
      if (!rounding_faults_[i].empty())
        refused[charted_chart_[i]] = true;
    const std::vector<Index> face_chart = chart_of_faces();
    for (const Index face : report_.certificate.culprits)
      refused[charted_chart_[face_chart[face]]] = true;
    std::vector<Index> numbers;
    for (Index i = 0; i < refused.size(); ++i)
      if (refused[i])
        numbers.push_back(i);
    return numbers;
  }

  std::vector<Index> chart_of_faces() const
  {
    std::vector<Index> result(surface_.number_of_faces, no_index);
    for (std::size_t t = 0; t < surface_.face.size(); ++t)
      result[surface_.face[t]] = segmentation_.chart[t];
    return result;
  }

  void write_corners()
  {
    const Point_2 nowhere(-1, -1);
    corner_uv_.assign(surface_.number_of_corners, nowhere);
    for (std::size_t c = 0; c < charts_.size(); ++c) {
      const Chart& chart = charts_[c];
      for (std::size_t t = 0; t < chart.source.size(); ++t)
        for (Index i = 0; i < 3; ++i)
          corner_uv_[surface_.corner[3 * chart.source[t] + i]] =
              turned_over(c, chart.uv[chart.triangles[t][i]]);
    }
    write_idle_corners(corner_uv_, nowhere);
  }

  /// Numbers the charts in the order of their first triangles, as the certificate does.
  void renumber()
  {
    std::vector<Index> number(charts_.size(), no_index);
    Index next = 0;
    for (Index& c : segmentation_.chart) {
      if (number[c] == no_index)
        number[c] = next++;
      c = number[c];
    }
    report_.charts.resize(charts_.size());
    std::vector<Chart_report> reports(charts_.size());
    for (std::size_t c = 0; c < charts_.size(); ++c)
      reports[number[c]] = std::move(report_.charts[c]);
    report_.charts = std::move(reports);
    report_.face_chart = chart_of_faces();
    report_.segmentation = std::move(segmentation_);
  }

  /// The distortion before the optimizer.
  /// \param measured  per chart its triangles; empty for those that the optimizer did not change
  void summarize_unoptimized(std::vector<std::vector<Triangle_distortion>> measured)
  {
    const auto is_empty = [](const auto& part) { return part.empty(); };
    if (std::all_of(measured.begin(), measured.end(), is_empty))
      return;
    std::vector<Triangle_distortion> all;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (measured[i].empty())
        measured[i] = triangle_distortions_at_own_scale(charts_[i], charts_[i].uv);
      all.insert(all.end(), measured[i].begin(), measured[i].end());
    }
    report_.unoptimized = summarize_distortion(all);
  }

  void summarize_coverage()
  {
    double covered = report_.distortion.area_uv;
    for (std::size_t i = 0; i < packing_.layers.size(); ++i)
      if (packing_.layers[i] > 0) {
        ++report_.stacked_charts;
        covered -= report_.charts[i].distortion.area_uv;
      }
    report_.packing_efficiency = covered / (double(page_.width) * page_.height * double(report_.pages));
    report_.min_coverage = wishes_.min_coverage;
    report_.coverage_outcome =
        coverage_outcome(report_.packing_efficiency, wishes_.min_coverage, are_cuts_exhausted_);
  }

  /// What is reported is about the model as it is given.
  void restore_positions()
  {
    surface_.points.swap(model_.positions);
    for (Chart& chart : charts_)
      for (std::size_t t = 0; t < chart.source.size(); ++t)
        for (int i = 0; i < 3; ++i)
          chart.points[chart.triangles[t][i]] = surface_.points[surface_.triangles[chart.source[t]][i]];
    report_.area = area_3d(surface_) * model_.unit * model_.unit;
  }

  void summarize()
  {
    restore_positions();
    report_.split_charts = flattener_.split_charts();
    report_.rejoined_pieces = flattener_.rejoined_pieces();
    report_.face_page = face_page_;
    report_.seam_length = seam_length(surface_, segmentation_) * model_.unit;
    report_.charts.resize(charts_.size());
    std::vector<std::vector<Triangle_distortion>> measured(charts_.size()), unoptimized(charts_.size());
    execution_.for_each(charts_.size(), [&](std::size_t i) {
      for (Point_2& p : charts_[i].uv)
        p = Point_2(p.x() * page_.width, p.y() * page_.height);
      measured[i] = triangle_distortions(charts_[i]);
      const Flattened_chart& flat = flattener_.charts()[charted_chart_[i]];
      if (!flat.uv_before.empty())
        unoptimized[i] = triangle_distortions_at_own_scale(flat.chart, flat.uv_before);
      Chart_report& chart = report_.charts[i];
      chart.status = flat.verdict.status;
      chart.triangles = charts_[i].number_of_triangles();
      chart.area = area_3d(charts_[i]) * model_.unit * model_.unit;
      chart.distortion = summarize_distortion(measured[i]);
      chart.stretch = stretch_quantile(measured[i], report_.bound.stretch_share);
      chart.is_within_bound = chart.area == 0 || used_share(measured[i], report_.bound) <= 1;
      if (!chart.is_within_bound)
        chart.reason = reason_for_excess(surface_, flat, report_.bound);
      chart.unoptimized = unoptimized[i].empty() ? chart.distortion : summarize_distortion(unoptimized[i]);
      chart.flattening = flat.record;
    });
    summarize_unoptimized(std::move(unoptimized));
    count_angles(charts_, report_.gradient_angles);
    report_.charts_beyond_bound = static_cast<std::size_t>(
        std::count_if(report_.charts.begin(), report_.charts.end(),
                      [](const Chart_report& chart) { return !chart.is_within_bound; }));
    std::vector<Triangle_distortion> all;
    for (const auto& part : measured)
      all.insert(all.end(), part.begin(), part.end());
    report_.distortion = summarize_distortion(all);
    if (report_.unoptimized.triangles == 0)
      report_.unoptimized = report_.distortion;
    summarize_coverage();
    report_.status = report_.certificate.is_valid() ? Atlas_status::valid : Atlas_status::not_valid;
    renumber();
  }

  Surface surface_;
  Normalization model_;
  const Policies& policies_;
  Page_options page_;
  Page_wishes wishes_;
  Cut_trade trade_;
  bool are_cuts_exhausted_ = false;
  Execution execution_;
  Progress progress_;

  Repeated_parts parts_;
  Surface& charted_; ///< what is segmented and flattened: the surface, but for parts that are copies
  double charted_area_ = 0;
  Segmentation charted_segmentation_;
  Chart_flattener flattener_;
  Segmentation segmentation_;
  std::vector<Index> charted_chart_; ///< per chart: the flattener's, which it is or is a copy of
  std::vector<Chart> charts_;        ///< per chart, on its page, rounded
  Packing packing_;
  std::vector<std::vector<Index>> rounding_faults_;
  std::vector<Index> face_page_;
  std::vector<Point_2> corner_uv_;
  Atlas_report report_;
};

} // namespace Atlas::internal

#endif
