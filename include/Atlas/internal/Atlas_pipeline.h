// SPDX-License-Identifier: MIT
#ifndef ATLAS_INTERNAL_ATLAS_PIPELINE_H
#define ATLAS_INTERNAL_ATLAS_PIPELINE_H

#include <Atlas/Atlas_report.h>
#include <Atlas/concepts.h>
#include <Atlas/extract_charts.h>
#include <Atlas/internal/Piece_rejoiner.h>
#include <Atlas/internal/Slit_opener.h>
#include <Atlas/internal/round_coordinates.h>
#include <Atlas/measure/area.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Schnyder_parameterizer.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/validation/certify.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// What the caller of the pipeline hears: the stage and its fraction in [0, 1]; `false` cancels.
using Progress = std::function<bool(Stage, double)>;

/// \brief One run from a surface to proved coordinates.
///
/// Data flows one way: segmentation -> charts -> flattened charts -> places on pages -> rounded coordinates
/// -> certificate. Charts that are refused on the way, by the validator or by the certificate, are split and
/// flattened again; every split lowers the number of faces in a chart, so that this ends.
template <ChartSegmentation Segmentation_policy, ChartParameterizer Parameterizer, UVOptimizer Optimizer,
          ChartValidator Validator, ChartPacker Packer>
class Atlas_pipeline
{
public:
  /// Splits that only serve the bound on distortion stop after so many rounds; what is left keeps its status.
  static constexpr int maximal_bound_rounds = 12;
  /// From this round on refused charts are halved, whatever the validator proposes: then there are at most
  /// log2(faces) rounds more.
  static constexpr int first_halving_round = 8;
  /// Rounds of packing, rounding and verification before the faults that remain are reported.
  static constexpr int maximal_page_rounds = 6;
  /// The share of what a bound on a mean allows beyond 1 that charts may use which take in pieces of others.
  static constexpr double share_for_joined_charts = 0.6;
  /// How many times as many triangles as the surface has may be flattened in vain to find other charts for
  /// pieces.
  static constexpr std::size_t work_of_joining = 5;
  /// Cells across a chart to which its coordinates are snapped.
  static constexpr double fineness = 4294967296.0;

  Atlas_pipeline(const Surface& input, const Segmentation_policy& segmentation,
                 const Parameterizer& parameterizer, const Optimizer& optimizer, const Validator& validator,
                 const Packer& packer, const Page_options& page, unsigned threads, Progress progress)
      : surface_(input), segmentation_policy_(segmentation), parameterizer_(parameterizer),
        optimizer_(optimizer), validator_(validator), packer_(packer), page_(page), execution_(threads),
        progress_(std::move(progress))
  {
    normalize();
    page_.density *= unit_;
  }

  /// \param corner_uv  per input corner; untouched when the run is cancelled or there is no surface
  Atlas_report run(std::vector<Point_2>& corner_uv)
  {
    describe_input();
    if (!(report_.area > 0) || !std::isfinite(report_.area))
      return report_;
    timed(Stage::segmentation, [&] { segment(); });
    timed(Stage::parameterization, [&] {
      flatten(chart_numbers());
      rejoin();
    });
    for (int round = 0; !execution_.is_cancelled(); ++round) {
      timed(Stage::packing, [&] { pack(); });
      std::vector<Index> refused;
      timed(Stage::verification, [&] { refused = verify(); });
      if (refused.empty() || round == maximal_page_rounds || !split_on_page(refused))
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

  const Segmentation& segmentation() const { return segmentation_; }

private:
  struct Flattened
  {
    Chart chart;
    Chart_verdict verdict;
    Flattening_record record;
  };

  /// Moves the model to the origin and scales it by a power of two to about unit size, so that no product of
  /// coordinates overflows or loses digits that the input has.
  void normalize()
  {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (const auto& triangle : surface_.triangles)
      for (const Index v : triangle)
        for (int i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], surface_.points[v][i]);
          high[i] = std::max(high[i], surface_.points[v][i]);
        }
    double extent = 0;
    for (int i = 0; i < 3; ++i)
      extent = std::max(extent, high[i] / 2 - low[i] / 2);
    if (!(extent > 0) || !std::isfinite(extent))
      return;
    const int exponent = std::ilogb(extent);
    unit_ = std::ldexp(1.0, exponent);
    const auto coordinate = [&](const Point_3& p, int i) {
      return std::ldexp(p[i], -exponent) - std::ldexp(low[i] / 2 + high[i] / 2, -exponent);
    };
    for (Point_3& p : surface_.points)
      p = Point_3(coordinate(p, 0), coordinate(p, 1), coordinate(p, 2));
    largest_side_ = std::ldexp(2 * extent, -exponent);
  }

  void describe_input()
  {
    report_.faces = surface_.number_of_faces;
    report_.triangles = surface_.number_of_triangles();
    report_.rejected = surface_.rejected;
    report_.page_width = page_.width;
    report_.page_height = page_.height;
    report_.gutter = page_.gutter;
    report_.area = area_3d(surface_);
    if constexpr (requires { Distortion_bound(segmentation_policy_.bound()); })
      report_.bound = segmentation_policy_.bound();
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

  std::vector<Index> chart_numbers() const
  {
    std::vector<Index> numbers(segmentation_.number_of_charts);
    std::iota(numbers.begin(), numbers.end(), Index(0));
    return numbers;
  }

  /// On rounded positions, so that models that are equal but for their scale have the same charts.
  void segment()
  {
    std::vector<Point_3> positions = rounded_positions();
    std::swap(surface_.points, positions);
    segmentation_ = segmentation_policy_.segment(surface_, execution_);
    if (!execution_.is_cancelled())
      cut_to_discs(surface_, segmentation_, execution_);
    std::swap(surface_.points, positions);
  }

  /// In units of the largest side of the bounding box, on a grid that is finer than what matters to charts,
  /// but far coarser than the last digits, which change when a model is scaled. Segmentation compares many
  /// things that are equal but for these, on symmetric models above all.
  std::vector<Point_3> rounded_positions() const
  {
    constexpr double cells = 1 << 30;
    if (!(largest_side_ > 0) || !std::isfinite(largest_side_))
      return surface_.points;
    std::vector<Point_3> result;
    result.reserve(surface_.points.size());
    const auto round = [&](double x) { return std::round(x / largest_side_ * cells) / cells; };
    for (const Point_3& p : surface_.points)
      result.emplace_back(round(p.x()), round(p.y()), round(p.z()));
    return result;
  }

  /// Flattens the charts of the given numbers, splitting what is refused, until every chart is accepted.
  void flatten(std::vector<Index> open)
  {
    accepted_.resize(segmentation_.number_of_charts);
    std::size_t done = 0, total = 0;
    for (const auto& list : lists_of(open))
      total += list.size();
    for (int round = 0; !open.empty() && !execution_.is_cancelled(); ++round) {
      std::vector<Flattened> results = flatten_once(open);
      std::vector<Index> split;
      for (std::size_t i = 0; i < open.size(); ++i) {
        if (is_final(results[i], round)) {
          done += results[i].chart.number_of_triangles();
          accepted_[open[i]] = std::move(results[i]);
        } else if (!this->split(open[i], results[i], round >= first_halving_round, split)) {
          accepted_[open[i]] = std::move(results[i]);
        }
      }
      open = reopen(split);
      (void)execution_.proceed(double(done) / double(std::max<std::size_t>(total, 1)));
    }
  }

  bool is_final(const Flattened& result, int round) const
  {
    const Chart_status status = result.verdict.status;
    return status == Chart_status::valid ||
           (status == Chart_status::area_ratio_exceeded && round >= maximal_bound_rounds);
  }

  std::vector<Flattened> flatten_once(const std::vector<Index>& open) const
  {
    const std::vector<std::vector<Index>> lists = lists_of(open);
    std::vector<Flattened> results(open.size());
    std::vector<Index> local(
        surface_.number_of_triangles()); // charts are disjoint: each writes its own entries
    execution_.for_each(open.size(), [&](std::size_t i) {
      results[i] = flatten_chart(extract_chart(surface_, segmentation_, lists[i], local));
    });
    return results;
  }

  Flattened flatten_chart(Chart chart) const
  {
    Flattened result{std::move(chart), {}, {}};
    Chart_verdict& verdict = result.verdict;
    verdict.status = parameterize(result.chart, result.record);
    if (verdict.status == Chart_status::valid)
      verdict.status = optimizer_.optimize(result.chart, execution_);
    if (verdict.status == Chart_status::valid) {
      give_area(result.chart);
      verdict = validator_.validate(result.chart, execution_);
    }
    return result;
  }

  /// Parameterizers may tell what they did.
  Chart_status parameterize(Chart& chart, Flattening_record& record) const
  {
    if constexpr (requires { parameterizer_.parameterize(chart, execution_, record); })
      return parameterizer_.parameterize(chart, execution_, record);
    else
      return parameterizer_.parameterize(chart, execution_);
  }

  /// Scales the chart to its area in space; but to no less than about a texel, so that tiny and needle-thin
  /// charts get texels of their own and do not collapse when coordinates are rounded.
  void give_area(Chart& chart) const
  {
    const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
    const double extent = std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
    if (!(extent > 0) || !std::isfinite(extent))
      return;
    const double in_plane = std::abs(area_uv(chart)) / extent / extent;
    const double texel = std::sqrt(report_.area / (double(page_.width) * page_.height));
    const double side = std::max(texel, in_plane > 0 ? std::sqrt(area_3d(chart) / in_plane) : 0.0);
    const auto snap = [&](double x) { return std::round(x / extent * fineness) / fineness * side; };
    for (Point_2& p : chart.uv)
      p = Point_2(snap(p.x() - box.xmin()), snap(p.y() - box.ymin()));
  }

  /// Gives pieces of refused charts to charts that stay within the bound with them, or get no worse.
  void rejoin()
  {
    std::vector<Index> pieces;
    for (Index c = 0; c < is_piece_.size(); ++c)
      if (is_piece_[c])
        pieces.push_back(c);
    if (pieces.empty() || execution_.is_cancelled())
      return;
    const auto accept = [&](const Flattened& joined, const Flattened& a, const Flattened& b) {
      return joined.verdict.is_valid() && is_no_worse(joined.chart, a.chart, b.chart);
    };
    const auto flatten = [this](Chart chart) { return flatten_chart(std::move(chart)); };
    report_.rejoined_pieces =
        Piece_rejoiner(surface_, segmentation_, accepted_, flatten, accept, work_of_joining, execution_)
            .run(pieces);
    close_gaps(segmentation_, accepted_);
  }

  /// Whether a chart has no more distortion than the two it came from have on average, or keeps well within
  /// the bound.
  bool is_no_worse(const Chart& joined, const Chart& a, const Chart& b) const
  {
    const auto distortion = [&](const Chart& chart) {
      return value(measure_distortion(chart), report_.bound.measure);
    };
    const double area_a = area_3d(a), area_b = area_3d(b);
    const double mean = (area_a * distortion(a) + area_b * distortion(b)) / (area_a + area_b);
    // Means hide what is bad near the piece.
    const double share = is_mean(report_.bound.measure) ? share_for_joined_charts : 1;
    return distortion(joined) <= std::max(mean, 1 + share * (report_.bound.max - 1));
  }

  /// Gives the parts of a refused chart numbers of their own, and adds all of these to `changed`. False if
  /// the chart is a single face, which cannot be split.
  bool split(Index number, const Flattened& refused, bool is_halved, std::vector<Index>& changed)
  {
    const std::vector<Index>& source = refused.chart.source;
    if (surface_.face[source.front()] == surface_.face[source.back()])
      return false;
    std::vector<Index> parts;
    if (!is_halved)
      parts = whole_face_parts(source, validator_.split(refused.chart, refused.verdict));
    if (std::all_of(parts.begin(), parts.end(), [&](Index part) { return part == parts.front(); }))
      parts = halves(source);
    std::vector<Index> names; // of the parts, in the order of their first triangle
    for (std::size_t i = 0; i < source.size(); ++i) {
      if (names.size() <= parts[i])
        names.resize(parts[i] + 1, no_index);
      Index& name = names[parts[i]];
      if (name == no_index) {
        name = i == 0 ? number : segmentation_.number_of_charts++;
        changed.push_back(name);
      }
      segmentation_.chart[source[i]] = name;
    }
    ++report_.split_charts;
    return true;
  }

  /// The part of a face is that of its first triangle. The triangles of a face follow each other.
  std::vector<Index> whole_face_parts(const std::vector<Index>& source, std::vector<Index> parts) const
  {
    for (std::size_t i = 1; i < source.size(); ++i)
      if (surface_.face[source[i]] == surface_.face[source[i - 1]])
        parts[i] = parts[i - 1];
    return parts;
  }

  /// Two parts with about as many triangles each.
  std::vector<Index> halves(const std::vector<Index>& source) const
  {
    std::vector<Index> parts(source.size(), 0);
    const Index last_of_first = surface_.face[source[(source.size() - 1) / 2]];
    for (std::size_t i = 0; i < source.size(); ++i)
      parts[i] = surface_.face[source[i]] > last_of_first ||
                 (last_of_first == surface_.face[source.back()] && surface_.face[source[i]] == last_of_first);
    return parts;
  }

  /// Makes discs of the charts that were split, and tells all numbers that need flattening now.
  std::vector<Index> reopen(const std::vector<Index>& split)
  {
    if (split.empty())
      return {};
    std::vector<Index> open = cut_to_discs(surface_, segmentation_, split, execution_);
    accepted_.resize(segmentation_.number_of_charts);
    is_piece_.resize(segmentation_.number_of_charts, 0);
    for (const Index c : open)
      is_piece_[c] = 1;
    return open;
  }

  std::vector<std::vector<Index>> lists_of(const std::vector<Index>& numbers) const
  {
    std::vector<Index> place(segmentation_.number_of_charts, no_index);
    for (Index i = 0; i < numbers.size(); ++i)
      place[numbers[i]] = i;
    std::vector<std::vector<Index>> lists(numbers.size());
    for (Index t = 0; t < segmentation_.chart.size(); ++t)
      if (const Index i = place[segmentation_.chart[t]]; i != no_index)
        lists[i].push_back(t);
    return lists;
  }

  void pack()
  {
    charts_.clear();
    for (const Flattened& f : accepted_)
      charts_.push_back(f.chart);
    const Packing packing = packer_.pack(charts_, page_, execution_);
    if (execution_.is_cancelled())
      return;
    report_.pages = packing.number_of_pages;
    report_.density = packing.density / unit_;
    face_page_.assign(surface_.number_of_faces, 0);
    rounding_faults_.assign(charts_.size(), {});
    execution_.for_each(charts_.size(), [&](std::size_t i) {
      for (Point_2& p : charts_[i].uv) {
        const Point_2 texel = packing.placements[i](p);
        p = Point_2(texel.x() / page_.width, texel.y() / page_.height);
      }
      rounding_faults_[i] = Grid_rounding(charts_[i])();
      Slit_opener(surface_, segmentation_, charts_[i])();
    });
    for (std::size_t i = 0; i < charts_.size(); ++i)
      for (const Index t : charts_[i].source)
        face_page_[surface_.face[t]] = packing.placements[i].page;
  }

  /// Writes the coordinates to the corners and proves them. Returns the charts to blame, sorted.
  std::vector<Index> verify()
  {
    write_corners();
    Certificate_options options;
    options.width = page_.width;
    options.height = page_.height;
    options.gutter = page_.gutter;
    report_.certificate = certify(surface_, corner_uv_, face_page_, options, execution_);
    std::vector<bool> refused(charts_.size(), false);
    for (std::size_t i = 0; i < charts_.size(); ++i)
      refused[i] = !rounding_faults_[i].empty();
    const std::vector<Index> face_chart = chart_of_faces();
    for (const Index face : report_.certificate.culprits)
      refused[face_chart[face]] = true;
    std::vector<Index> numbers;
    for (Index i = 0; i < charts_.size(); ++i)
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
    for (const Chart& chart : charts_)
      for (std::size_t t = 0; t < chart.source.size(); ++t)
        for (Index i = 0; i < 3; ++i)
          corner_uv_[surface_.corner[3 * chart.source[t] + i]] = chart.uv[chart.triangles[t][i]];
    write_idle_corners(nowhere);
  }

  /// Corners that no triangle uses (of rejected faces, or the second of two equal neighbours) take the
  /// coordinates of the used corner before them, so that their faces have no area in the plane.
  void write_idle_corners(const Point_2& nowhere)
  {
    Point_2 last(0.5, 0.5);
    for (Point_2& p : corner_uv_) {
      if (p == nowhere)
        p = last;
      last = p;
    }
  }

  /// Splits charts that were flattened well but fail on the page, and flattens the pieces. False if none can
  /// be split.
  bool split_on_page(const std::vector<Index>& refused)
  {
    std::vector<Index> changed;
    bool is_any_drawn = false;
    timed(Stage::parameterization, [&] {
      for (const Index number : refused) {
        Flattened& f = accepted_[number];
        f.verdict.status =
            rounding_faults_[number].empty() ? Chart_status::overlapping : Chart_status::flipped;
        f.verdict.culprits = rounding_faults_[number];
        if (!split(number, f, false, changed))
          is_any_drawn |= draw_on_grid(f);
      }
      if (!changed.empty())
        flatten(reopen(changed));
    });
    return !changed.empty() || is_any_drawn;
  }

  /// The last resort for a face that cannot be split: of all maps, Schnyder's drawing on a grid suffers least
  /// from rounding. False if that has been tried.
  bool draw_on_grid(Flattened& f) const
  {
    Chart drawn = f.chart;
    if (Schnyder_parameterizer().parameterize(drawn, execution_) != Chart_status::valid)
      return false;
    give_area(drawn);
    if (drawn.uv == f.chart.uv)
      return false;
    f.chart = std::move(drawn);
    f.verdict = validator_.validate(f.chart, execution_);
    return true;
  }

  void summarize()
  {
    report_.face_chart = chart_of_faces();
    report_.face_page = face_page_;
    report_.seam_length = seam_length(surface_, segmentation_) * unit_;
    report_.charts.resize(charts_.size());
    std::vector<std::vector<Triangle_distortion>> measured(charts_.size());
    execution_.for_each(charts_.size(), [&](std::size_t i) {
      for (Point_2& p : charts_[i].uv)
        p = Point_2(p.x() * page_.width, p.y() * page_.height);
      measured[i] = triangle_distortions(charts_[i]);
      Chart_report& chart = report_.charts[i];
      chart.status = accepted_[i].verdict.status;
      chart.triangles = charts_[i].number_of_triangles();
      chart.area = area_3d(charts_[i]) * unit_ * unit_;
      chart.distortion = summarize_distortion(measured[i]);
      chart.is_within_bound =
          !(value(chart.distortion, report_.bound.measure) > report_.bound.max) || chart.area == 0;
      chart.flattening = accepted_[i].record;
    });
    report_.charts_beyond_bound = static_cast<std::size_t>(
        std::count_if(report_.charts.begin(), report_.charts.end(),
                      [](const Chart_report& chart) { return !chart.is_within_bound; }));
    std::vector<Triangle_distortion> all;
    for (const auto& part : measured)
      all.insert(all.end(), part.begin(), part.end());
    report_.distortion = summarize_distortion(all);
    report_.packing_efficiency =
        report_.distortion.area_uv / (double(page_.width) * page_.height * double(report_.pages));
    report_.area *= unit_ * unit_;
    report_.status = report_.certificate.is_valid() ? Atlas_status::valid : Atlas_status::not_valid;
  }

  Surface surface_;
  double unit_ = 1;         ///< the model's unit over the unit used here
  double largest_side_ = 0; ///< of the bounding box, in the unit used here
  const Segmentation_policy& segmentation_policy_;
  const Parameterizer& parameterizer_;
  const Optimizer& optimizer_;
  const Validator& validator_;
  const Packer& packer_;
  Page_options page_;
  Execution execution_;
  Progress progress_;

  Segmentation segmentation_;
  std::vector<Flattened> accepted_;    ///< per chart, in units of the model
  std::vector<std::uint8_t> is_piece_; ///< per chart: whether it came from a refused one
  std::vector<Chart> charts_;          ///< per chart, on its page, rounded
  std::vector<std::vector<Index>> rounding_faults_;
  std::vector<Index> face_page_;
  std::vector<Point_2> corner_uv_;
  Atlas_report report_;
};

} // namespace Atlas::internal

#endif
