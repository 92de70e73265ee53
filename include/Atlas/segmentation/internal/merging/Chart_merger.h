// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_CHART_MERGER_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_CHART_MERGER_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/segmentation/internal/merging/Arc_borders.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/merging/Merge_queue.h>
#include <Atlas/segmentation/internal/merging/Merge_trials.h>
#include <Atlas/segmentation/merge_charts.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The charts of a coarse surface, before any has been merged.
inline std::vector<Mergeable_chart> mergeable_charts(const Coarse_surface& surface,
                                                     const Arc_borders& borders, Index number)
{
  std::vector<Mergeable_chart> charts(number);
  for (Index t = 0; t < surface.chart.size(); ++t) {
    Mergeable_chart& chart = charts[surface.chart[t]];
    chart.triangles.push_back(t);
    chart.area += std::sqrt(
        CGAL::squared_area(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2)));
  }
  for (Index s = 0; s < borders.number_of_sides(); ++s)
    if (borders.owner(s) != no_index) {
      Mergeable_chart& chart = charts[borders.owner(s)];
      chart.side = std::min(chart.side, s);
      chart.perimeter += borders.plain_length(s / 2);
    }
  return charts;
}

inline double total_area(const std::vector<Mergeable_chart>& charts)
{
  double sum = 0;
  for (const Mergeable_chart& chart : charts)
    sum += chart.area;
  return sum;
}

/// \brief Merges the charts of a coarse surface along runs of arcs.
///
/// Candidates wait in a queue. They are tried in batches, and what is accepted changes the borders. What is
/// refused as a whole is tried along its longest arc alone; slits that remain are zipped from their tips.
class Chart_merger
{
public:
  /// \param weight  per arc: what its length counts
  Chart_merger(const Coarse_surface& surface, const Chart_arcs& arcs, const std::vector<double>& weight,
               Index charts, const Merge_options& options, const Trial_flattening& flatten,
               const Execution& execution)
      : options_(options), execution_(execution), borders_(surface, arcs.must_be_seam, weight),
        charts_(mergeable_charts(surface, borders_, charts)), whole_area_(total_area(charts_)),
        trials_(surface, options, flatten, whole_area_, arcs.number_of_arcs()), sets_(charts),
        number_of_charts_(charts)
  {
    trials_.flatten_all(borders_, charts_, execution);
  }

  void run(Merge_order order)
  {
    order_ = order;
    // One sweep, the slits, and once more what was refused while charts were other ones.
    for (int k = 0; k < 2 && execution_.proceed(0.2 + 0.3 * k); ++k) {
      sweep();
      zip();
    }
    merge_past_bound();
  }

  /// The length of all seams inside the surface, as it counts.
  double seam_length() const { return borders_.seam_length(); }
  std::size_t number_of_charts() const { return number_of_charts_; }
  /// Triangles flattened for trial, those of accepted trials among them.
  std::size_t work() const { return trials_.work(); }

  Index chart_of(Index chart) { return sets_.find(chart); }
  bool is_glued(Index arc) const { return borders_.is_glued(arc); }

private:
  // --- Candidates

  Index chart_of_side(Index s) { return sets_.find(borders_.owner(s)); }

  bool is_mergeable(Index s) { return borders_.is_open(s) && chart_of_side(s) != chart_of_side(s ^ 1); }

  void push(Index s, const std::vector<Index>& run, bool is_single)
  {
    const Mergeable_chart &a = charts_[chart_of_side(s)], &b = charts_[chart_of_side(s ^ 1)];
    if (is_past_bound() && !is_wanted_past_bound(a, b))
      return;
    const double size = yardstick(order_, a, b);
    const double priority = size > 0 ? borders_.length_of(run) / size : 1;
    queue_.push({priority, s, a.version, b.version, is_single});
  }

  /// A run that must not be glued as a whole may still be along its longest arc: what stays open is a slit.
  void push_longest_arc(const std::vector<Index>& run)
  {
    if (run.size() < 2)
      return;
    const Index s = *std::max_element(run.begin(), run.end(), [&](Index a, Index b) {
      const double length = borders_.length(a / 2), other = borders_.length(b / 2);
      return std::tie(length, b) < std::tie(other, a);
    });
    if (!is_refused_alone_[s / 2])
      push(s, {s}, true);
  }

  /// Puts the runs of the chart's border into the queue, each once.
  void push_runs(Index chart)
  {
    const Index start = charts_[chart].side;
    if (start == no_index)
      return;
    Index s = start;
    do {
      const Index p = borders_.previous(s);
      const bool goes_on = p != s && is_mergeable(p) && borders_.next(s ^ 1) == (p ^ 1);
      if (is_mergeable(s) && (!goes_on || s == start))
        if (const std::vector<Index> run = borders_.run_of(s); run.size() > 0)
          push(s, run, false);
      s = borders_.next(s);
    } while (s != start);
  }

  /// Takes promising candidates whose charts are all different from the queue. Their number does not depend
  /// on the number of threads, so neither does the result.
  std::vector<Merge_candidate> take_batch()
  {
    std::vector<Merge_candidate> batch;
    std::vector<Queued_merge> later;
    const std::size_t most_later = 4 * options_.batch; // or the search for a full batch could take the queue
    std::vector<Index> busy;
    const auto is_busy = [&](Index c) { return std::find(busy.begin(), busy.end(), c) != busy.end(); };
    while (!queue_.empty() && batch.size() < batch_size() && later.size() < most_later) {
      const Queued_merge entry = queue_.top();
      queue_.pop();
      const Index s = entry.side;
      if (!is_mergeable(s))
        continue;
      Merge_candidate c{chart_of_side(s), chart_of_side(s ^ 1), {}, {}, false};
      const Mergeable_chart &a = charts_[c.chart], &b = charts_[c.other];
      if (a.version != entry.version || b.version != entry.other_version)
        continue; // pushed anew when the chart changed
      if (is_past_bound() && !is_wanted_past_bound(a, b))
        continue;
      if (is_busy(c.chart) || is_busy(c.other)) {
        later.push_back(entry);
        continue;
      }
      c.run = entry.is_single ? std::vector<Index>{s} : borders_.run_of(s);
      if (!entry.is_single && is_mostly_refused(c.run))
        continue;
      if (!trials_.is_promising(borders_, a, b, c.run, past_bound_)) {
        refuse(c.run);
        continue;
      }
      busy.push_back(c.chart);
      busy.push_back(c.other);
      batch.push_back(std::move(c));
    }
    for (const Queued_merge& entry : later)
      queue_.push(entry);
    return batch;
  }

  /// Once there are few charts enough, no more of them merge for that reason.
  std::size_t batch_size() const
  {
    return is_past_bound() && has_too_many_charts() && !(options_.min_chart_area > 0)
               ? std::min(options_.batch, number_of_charts_ - options_.max_charts)
               : options_.batch;
  }

  bool is_mostly_refused(const std::vector<Index>& run) const
  {
    double refused = 0;
    for (const Index s : run)
      refused += is_refused_[s / 2] ? borders_.length(s / 2) : 0;
    return refused > 0.5 * borders_.length_of(run);
  }

  void refuse(const std::vector<Index>& run)
  {
    if (run.size() == 1)
      is_refused_alone_[run.front() / 2] = 1;
    for (const Index s : run)
      is_refused_[s / 2] = 1;
    push_longest_arc(run);
  }

  // --- Merging

  /// Tries what there is, from the best to the worst.
  void sweep()
  {
    is_refused_.assign(borders_.number_of_arcs(), 0);
    is_refused_alone_.assign(borders_.number_of_arcs(), 0);
    for (Index c = 0; c < charts_.size(); ++c)
      if (sets_.find(c) == c)
        push_runs(c);
    while (execution_.proceed(0.5)) {
      std::vector<Merge_candidate> batch = take_batch();
      if (batch.empty())
        break;
      trials_.attempt_all(borders_, charts_, batch, past_bound_, execution_);
      for (Merge_candidate& c : batch)
        if (c.is_accepted)
          push_runs(accept(c));
        else
          refuse(c.run);
    }
    queue_ = {};
  }

  /// Closes slits from their tips while the bound allows it.
  void zip()
  {
    std::vector<std::uint8_t> is_stuck(borders_.number_of_arcs(), 0);
    while (execution_.proceed(0.6)) {
      std::vector<Merge_candidate> batch;
      std::vector<std::uint8_t> has_one(charts_.size(), 0);
      for (Index s = 0; s < borders_.number_of_sides(); ++s) {
        if (is_stuck[s / 2] || !borders_.is_tip_of_slit(s))
          continue;
        const Index c = chart_of_side(s);
        if (!has_one[c])
          batch.push_back({c, c, {s}, {}, false});
        has_one[c] = 1;
      }
      if (batch.empty())
        break;
      trials_.attempt_all(borders_, charts_, batch, past_bound_, execution_);
      for (Merge_candidate& c : batch)
        if (c.is_accepted)
          accept(c);
        else
          is_stuck[c.run.front() / 2] = 1;
    }
  }

  /// Joins the two charts, or closes the slit; returns the chart.
  Index accept(Merge_candidate& c)
  {
    Mergeable_chart merged;
    for (const Index s : c.run)
      merged.side = borders_.glue(s);
    const Index chart = std::min(c.chart, c.other);
    merged.triangles = c.layout.source;
    merged.area = charts_[c.chart].area;
    double glued = 0;
    for (const Index s : c.run)
      glued += borders_.plain_length(s / 2);
    merged.perimeter = charts_[c.chart].perimeter - 2 * glued;
    merged.version = charts_[chart].version + 1;
    if (!c.is_slit()) {
      merged.area += charts_[c.other].area;
      merged.perimeter += charts_[c.other].perimeter;
      merged.version += charts_[std::max(c.chart, c.other)].version;
      charts_[c.chart] = charts_[c.other] = Mergeable_chart();
      sets_.unite(c.chart, c.other);
      --number_of_charts_;
    }
    charts_[chart] = std::move(merged);
    trials_.keep_layout(charts_[chart], std::move(c.layout));
    return chart;
  }

  // --- Past the bound

  bool is_past_bound() const { return past_bound_ > 1; }

  bool has_too_many_charts() const
  {
    return options_.max_charts > 0 && number_of_charts_ > options_.max_charts;
  }

  bool is_wanted_past_bound(const Mergeable_chart& a, const Mergeable_chart& b) const
  {
    return has_too_many_charts() || std::min(a.area, b.area) < options_.min_chart_area * whole_area_;
  }

  /// Goes on while there are too many charts or too small ones: past the bound, but no farther than needed.
  void merge_past_bound()
  {
    if (options_.max_charts == 0 && !(options_.min_chart_area > 0))
      return;
    constexpr double step = 4, enough = 1e9; // times the distortion of the bound; then any will do
    const auto has_wish = [&] { return has_too_many_charts() || options_.min_chart_area > 0; };
    for (past_bound_ = step; has_wish() && past_bound_ < enough && execution_.proceed(0.8);
         past_bound_ *= step) {
      sweep();
      zip();
    }
    past_bound_ = std::numeric_limits<double>::infinity();
    if (has_wish())
      sweep();
    past_bound_ = 1;
  }

  const Merge_options& options_;
  const Execution& execution_;
  Arc_borders borders_;
  std::vector<Mergeable_chart> charts_; ///< of merged ones the one with the least number
  double whole_area_;
  Merge_trials trials_;
  Union_find sets_; ///< of charts that have become one
  Merge_queue queue_;
  std::vector<std::uint8_t> is_refused_, is_refused_alone_; ///< per arc: in this sweep
  std::size_t number_of_charts_;
  Merge_order order_ = Merge_order::by_union;
  double past_bound_ = 1; ///< how many times the distortion beyond 1 may exceed that of the bound
};

} // namespace Atlas::internal

#endif
