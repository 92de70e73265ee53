// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_CHART_FLATTENER_H
#define ATLAS_PIPELINE_INTERNAL_CHART_FLATTENER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Fixed_border_parameterizer.h>
#include <Atlas/pipeline/Atlas_report.h>
#include <Atlas/pipeline/internal/Chart_slitter.h>
#include <Atlas/pipeline/internal/Cut_zipper.h>
#include <Atlas/pipeline/internal/Tail_slitter.h>
#include <Atlas/pipeline/internal/close_cuts.h>
#include <Atlas/pipeline/internal/joined_charts.h>
#include <Atlas/pipeline/internal/parts_of_faces.h>
#include <Atlas/pipeline/internal/scale_to_area.h>
#include <Atlas/pipeline/internal/tiny_charts.h>
#include <Atlas/pipeline/presets.h>
#include <Atlas/segmentation/cut_to_discs.h>
#include <Atlas/segmentation/internal/rejoining/Fragment_merger.h>
#include <Atlas/validation/internal/chart_faults.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Flattens the charts of a segmentation until each one is accepted.
///
/// Charts that are refused, by the validator or later on the page, are split and flattened again; every split
/// lowers the number of faces in a chart, so that this ends. Pieces may then join other charts.
class Chart_flattener
{
public:
  /// Splits for the bound on distortion have to lower what exceeds it by this factor ...
  static constexpr double least_gain_of_splits = 0.8;
  /// ... within so many generations of pieces: a surface that is rough at the scale of its triangles is not
  /// mended by cutting it up.
  static constexpr int generations_in_vain = 4;
  /// How many times as many triangles as the surface has may be flattened in vain to find other charts for
  /// pieces.
  static constexpr std::size_t work_of_joining = 5;

  /// \param segmentation  is changed where charts are split or joined
  Chart_flattener(const Surface& surface, Segmentation& segmentation, const Policies& policies,
                  const Execution& execution)
      : surface_(surface), segmentation_(segmentation), policies_(policies), execution_(execution),
        slitter_(surface, segmentation)
  {}

  /// \param texel  about the side of a texel in units of the model
  /// \param bound  the segmentation's
  void run(double texel, const Distortion_bound& bound)
  {
    texel_ = texel;
    bound_ = bound;
    if (std::isfinite(bound.max) || std::isfinite(bound.max_stretch))
      yardstick_ = bound;
    std::vector<Index> all(segmentation_.number_of_charts);
    std::iota(all.begin(), all.end(), Index(0));
    flatten(std::move(all));
    if (policies_.repair.rejoin_pieces)
      rejoin();
    slit_tails();
    close_cuts();
  }

  /// Splits charts that were flattened well but fail on the page, and flattens the pieces.
  /// \param faults  per chart the triangles that rounding flips
  /// \return whether any chart is another one now
  bool replace(const std::vector<Index>& refused, const std::vector<std::vector<Index>>& faults)
  {
    std::vector<Index> changed;
    bool is_any_drawn = false;
    for (const Index number : refused) {
      Flattened_chart& f = charts_[number];
      f.verdict.status = faults[number].empty() ? Chart_status::overlapping : Chart_status::flipped;
      f.verdict.culprits = faults[number];
      if (!split(number, f, false, changed))
        is_any_drawn |= draw_on_grid(f);
    }
    if (!changed.empty()) {
      flatten(reopen(changed));
      close_cuts();
    }
    return !changed.empty() || is_any_drawn;
  }

  /// Takes pieces of its charts in their place, with the numbers that they have in the segmentation now.
  void take(std::vector<Flattened_chart> charts)
  {
    charts_ = std::move(charts);
    history_.resize(charts_.size());
    is_piece_.resize(charts_.size(), 0);
  }

  const std::vector<Flattened_chart>& charts() const { return charts_; } ///< as the segmentation numbers them
  std::size_t split_charts() const { return split_charts_; }
  std::size_t rejoined_pieces() const { return rejoined_pieces_; }

private:
  /// What splits for the bound on distortion have done to a chart so far.
  struct Split_history
  {
    double used = std::numeric_limits<double>::infinity(); ///< of the bound when that was last lowered
    int in_vain = 0;                                       ///< generations of pieces since then
  };

  /// Flattens the charts of the given numbers, splitting what is refused, until every chart is accepted.
  void flatten(std::vector<Index> open)
  {
    charts_.resize(segmentation_.number_of_charts);
    history_.resize(segmentation_.number_of_charts);
    std::size_t done = 0, total = 0;
    for (const auto& list : lists_of(open))
      total += list.size();
    for (int round = 0; !open.empty() && !execution_.is_cancelled(); ++round) {
      std::vector<Flattened_chart> results = flatten_once(open);
      std::vector<Index> split;
      for (std::size_t i = 0; i < open.size(); ++i) {
        if (is_final(open[i], results[i], round)) {
          done += results[i].chart.number_of_triangles();
          charts_[open[i]] = std::move(results[i]);
        } else if (!this->split(open[i], results[i], round >= policies_.repair.first_halving_round, split)) {
          give_coordinates(results[i]);
          charts_[open[i]] = std::move(results[i]);
        }
      }
      open = reopen(split);
      (void)execution_.proceed(double(done) / double(std::max<std::size_t>(total, 1)));
    }
  }

  /// Whether the chart stays as it is. Takes note of how splits for the bound have fared.
  bool is_final(Index number, const Flattened_chart& result, int round)
  {
    const Chart_status status = result.verdict.status;
    if (status == Chart_status::bound_exceeded) {
      const double used = used_share(triangle_distortions(result.chart), yardstick_);
      Split_history& history = history_[number];
      const bool has_gained = std::isfinite(used) && used <= least_gain_of_splits * history.used;
      history = has_gained ? Split_history{used, 0} : Split_history{history.used, history.in_vain + 1};
      return history.in_vain >= generations_in_vain;
    }
    return status == Chart_status::valid ||
           (status == Chart_status::area_ratio_exceeded && round >= policies_.repair.max_bound_rounds);
  }

  std::vector<Flattened_chart> flatten_once(const std::vector<Index>& open) const
  {
    const std::vector<std::vector<Index>> lists = lists_of(open);
    std::vector<Flattened_chart> results(open.size());
    std::vector<Index> local(
        surface_.number_of_triangles()); // charts are disjoint: each writes its own entries
    execution_.for_each(open.size(), [&](std::size_t i) {
      const auto flatten = [&](const std::vector<Index>& triangles) {
        return flatten_chart(extract_chart(surface_, segmentation_, triangles, local));
      };
      results[i] = flatten(lists[i]);
      slitter_(results[i], yardstick_, flatten);
    });
    return results;
  }

  Flattened_chart flatten_chart(Chart chart) const
  {
    Flattened_chart result{std::move(chart), {}, {}, {}};
    Chart_verdict& verdict = result.verdict;
    verdict.status = policies_.parameterizer.parameterize(result.chart, execution_, result.record);
    if (verdict.status == Chart_status::valid && !policies_.repair.optimize_accepted)
      verdict.status = optimize(result);
    if (verdict.status == Chart_status::valid) {
      scale_to_area(result.chart, texel_);
      verdict = policies_.validator.validate(result.chart, execution_);
    }
    if (verdict.status == Chart_status::valid && policies_.repair.optimize_accepted)
      optimize_accepted(result);
    return result;
  }

  /// Optimises a chart, and remembers what it was like before.
  Chart_status optimize(Flattened_chart& f) const
  {
    std::vector<Point_2> before = f.chart.uv;
    const Chart_status status = policies_.optimizer.optimize(f.chart, execution_);
    if (f.chart.uv != before)
      f.uv_before = std::move(before);
    return status;
  }

  /// Optimises a chart that the validator accepts; it stays as it is if the result were refused.
  void optimize_accepted(Flattened_chart& accepted) const
  {
    Flattened_chart optimized = accepted;
    if (optimize(optimized) != Chart_status::valid || optimized.uv_before.empty())
      return;
    scale_to_area(optimized.chart, texel_);
    if (policies_.validator.validate(optimized.chart, execution_).is_valid())
      accepted = std::move(optimized);
  }

  /// A face that cannot be split keeps what it was refused with; where a policy failed to give it coordinates
  /// at all, it gets those of a drawing on a grid.
  void give_coordinates(Flattened_chart& f) const
  {
    const Chart_status status = f.verdict.status;
    if (status != Chart_status::solver_failed && status != Chart_status::not_a_disc &&
        status != Chart_status::cancelled && has_coordinates(f.chart))
      return;
    f.chart.uv.assign(f.chart.number_of_vertices(), Point_2(0, 0));
    if (draw_on_grid(f))
      f.record.start = Flattening_start::schnyder;
  }

  /// Gives pieces of refused charts to charts that stay within the bound with them, or get no worse.
  void rejoin()
  {
    std::vector<Index> pieces;
    for (Index c = 0; c < charts_.size(); ++c)
      if ((c < is_piece_.size() && is_piece_[c]) || is_tiny(charts_[c]))
        pieces.push_back(c);
    if (pieces.empty() || execution_.is_cancelled())
      return;
    const auto accept = [&](const Flattened_chart& joined, const Flattened_chart& a,
                            const Flattened_chart& b) {
      return (joined.verdict.is_valid() || are_all_beyond_bound(joined, a, b)) &&
             (is_no_worse(joined.chart, a.chart, b.chart, bound_) || (is_tiny(a) && !is_unrolled(b)));
    };
    const auto flatten = [this](Chart chart) { return flatten_chart(std::move(chart)); };
    rejoined_pieces_ =
        Fragment_merger(surface_, segmentation_, charts_, flatten, accept, work_of_joining, execution_)
            .run(pieces);
    close_gaps(segmentation_, charts_);
  }

  /// Slits charts where much of the surface is stretched farther than wanted; not those of a segmentation
  /// without a bound, which are what they are for other reasons.
  void slit_tails()
  {
    if (!std::isfinite(policies_.repair.wanted_stretch) || !(bound_.stretch_share < 1) ||
        execution_.is_cancelled())
      return;
    const auto flatten = [this](Chart chart) { return flatten_chart(std::move(chart)); };
    const auto lay_flat = [this](Chart& chart) { return this->lay_flat(chart); };
    const double wanted = policies_.repair.wanted_stretch;
    Cut_zipper(surface_, segmentation_, wanted, flatten, lay_flat, execution_).run(charts_);
    const auto flatten_slit = [this](Chart chart, const Flattening_record& record) {
      return this->flatten_slit(std::move(chart), record);
    };
    Tail_slitter(surface_, segmentation_, wanted, bound_.stretch_share, flatten_slit, lay_flat, execution_)
        .run(charts_);
  }

  /// \param chart   with coordinates from before it was slit
  /// \param record  of that
  Flattened_chart flatten_slit(Chart chart, const Flattening_record& record) const
  {
    if (is_optimized_after_slit(chart)) {
      Flattened_chart result{std::move(chart), {}, record, {}};
      result.record.is_optimized = true;
      scale_to_area(result.chart, texel_);
      result.verdict = policies_.validator.validate(result.chart, execution_);
      return result;
    }
    chart.uv.clear();
    return flatten_chart(std::move(chart));
  }

  bool is_optimized_after_slit(Chart& chart) const
  {
    const std::optional<Any_optimizer>& optimizer = policies_.repair.slit_optimizer;
    return optimizer && optimizer->optimize(chart, execution_) == Chart_status::valid;
  }

  /// For trials. A chart that has coordinates already is one that was changed a little.
  Chart_status lay_flat(Chart& chart) const
  {
    if (!chart.uv.empty() && is_optimized_after_slit(chart))
      return Chart_status::valid;
    chart.uv.clear();
    Flattening_record record;
    const Chart_status status = policies_.parameterizer.parameterize(chart, execution_, record);
    return status == Chart_status::valid ? policies_.optimizer.optimize(chart, execution_) : status;
  }

  /// Glues cuts that are none in the plane: charts with holes are discs only while they are flattened.
  void close_cuts()
  {
    if (execution_.is_cancelled())
      return;
    std::vector<Index> local(surface_.number_of_triangles());
    Cut_closer closer(surface_, segmentation_);
    for (Flattened_chart& f : charts_)
      if (f.chart.uv.size() == f.chart.points.size())
        closer(f.chart, local);
  }

  /// Gives the parts of a refused chart numbers of their own, and adds all of these to `changed`. False if
  /// the chart is a single face, which cannot be split.
  bool split(Index number, const Flattened_chart& refused, bool is_halved, std::vector<Index>& changed)
  {
    const std::vector<Index>& source = refused.chart.source;
    if (surface_.face[source.front()] == surface_.face[source.back()])
      return false;
    std::vector<Index> parts;
    if (!is_halved)
      parts = whole_face_parts(surface_, source, policies_.splitter.split(refused.chart, refused.verdict));
    if (std::all_of(parts.begin(), parts.end(), [&](Index part) { return part == parts.front(); }))
      parts = halves(surface_, source);
    std::vector<Index> names; // of the parts, in the order of their first triangle
    for (std::size_t i = 0; i < source.size(); ++i) {
      if (names.size() <= parts[i])
        names.resize(parts[i] + 1, no_index);
      Index& name = names[parts[i]];
      if (name == no_index) {
        name = i == 0 ? number : segmentation_.number_of_charts++;
        changed.push_back(name);
        history_.resize(segmentation_.number_of_charts, history_[number]);
      }
      segmentation_.chart[source[i]] = name;
    }
    ++split_charts_;
    return true;
  }

  /// Makes discs of the charts that were split, and tells all numbers that need flattening now.
  std::vector<Index> reopen(const std::vector<Index>& split)
  {
    if (split.empty())
      return {};
    std::vector<Index> open = cut_to_discs(surface_, segmentation_, split, execution_);
    charts_.resize(segmentation_.number_of_charts);
    history_.resize(segmentation_.number_of_charts);
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

  /// The last resort for a face that cannot be split: of all maps, Schnyder's drawing on a grid suffers least
  /// from rounding. False if that has been tried.
  bool draw_on_grid(Flattened_chart& f) const
  {
    Chart drawn = f.chart;
    if (Schnyder_parameterizer().parameterize(drawn, execution_) != Chart_status::valid)
      return false;
    scale_to_area(drawn, texel_);
    if (drawn.uv == f.chart.uv)
      return false;
    f.chart = std::move(drawn);
    f.verdict = policies_.validator.validate(f.chart, execution_);
    return true;
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  const Policies& policies_;
  const Execution& execution_;
  Chart_slitter slitter_;

  double texel_ = 0;
  Distortion_bound bound_;
  /// What tells whether cuts help: the bound, or the mean energy where the validator alone has a bound.
  Distortion_bound yardstick_{Distortion_measure::symmetric_dirichlet, 2};
  std::vector<Flattened_chart> charts_;
  std::vector<Split_history> history_; ///< per chart
  std::vector<std::uint8_t> is_piece_; ///< per chart: whether it came from a refused one
  std::size_t split_charts_ = 0, rejoined_pieces_ = 0;
};

} // namespace Atlas::internal

#endif
