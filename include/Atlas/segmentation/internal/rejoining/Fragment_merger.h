// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_REJOINING_FRAGMENT_MERGER_H
#define ATLAS_SEGMENTATION_INTERNAL_REJOINING_FRAGMENT_MERGER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/segmentation/internal/rejoining/Trial_merge.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Takes charts without triangles out of the numbering. `charts` are those of the segmentation.
inline void close_gaps(Segmentation& segmentation, std::vector<Flattened_chart>& charts)
{
  std::vector<Index> number(charts.size(), no_index);
  Index kept = 0;
  for (Index c = 0; c < charts.size(); ++c)
    if (!charts[c].chart.source.empty()) {
      number[c] = kept;
      if (c != kept)
        charts[kept] = std::move(charts[c]);
      ++kept;
    }
  charts.resize(kept);
  segmentation.number_of_charts = kept;
  for (Index& c : segmentation.chart)
    c = number[c];
}

/// \brief Gives fragments of refused charts to other charts that are accepted with them.
///
/// A chart that is split where one corner of it is too much for the bound leaves fragments that often fit
/// somewhere else, or with each other. Smallest first, each tries the neighbours with which it shares most
/// border; what is accepted is the flattening at full resolution.
class Fragment_merger
{
public:
  /// Flattens a chart; may be called from several threads.
  using Flatten = std::function<Flattened_chart(Chart)>;
  /// Whether a chart may take the place of the two it was made of.
  using Accept =
      std::function<bool(const Flattened_chart& merged, const Flattened_chart& a, const Flattened_chart& b)>;

  /// \param work  how many times as many triangles as the surface has may be flattened in vain
  Fragment_merger(const Surface& surface, Segmentation& segmentation, std::vector<Flattened_chart>& charts,
                  Flatten flatten, Accept accept, std::size_t work, const Execution& execution)
      : surface_(surface), segmentation_(segmentation), charts_(charts), flatten_(std::move(flatten)),
        accept_(std::move(accept)), execution_(execution), trial_merge_(surface, segmentation),
        local_(surface.number_of_triangles()), budget_(work * surface.number_of_triangles())
  {}

  /// Returns how many fragments found another chart. Charts that are gone keep their numbers, without
  /// triangles.
  std::size_t run(const std::vector<Index>& fragments)
  {
    std::size_t merged = 0, before = no_index;
    // A neighbour that has grown may take what it refused.
    for (int pass = 0; pass < passes && merged != before; ++pass) {
      before = merged;
      std::vector<Fragment> open;
      for (const Index c : fragments)
        if (size(c) > 0)
          open.push_back({c, {}});
      std::stable_sort(open.begin(), open.end(),
                       [&](const Fragment& a, const Fragment& b) { return size(a.chart) < size(b.chart); });
      while (!open.empty() && execution_.proceed())
        merged += merge_some(open);
    }
    return merged;
  }

private:
  static constexpr int passes = 2;
  /// How many neighbours a fragment tries.
  static constexpr std::size_t tries = 4;
  /// Pairs that are tried at a time, among so many fragments. Part of the result: not a number of threads.
  static constexpr std::size_t batch = 8, window = 4 * batch;

  struct Fragment
  {
    Index chart;
    std::vector<Index> tried;
  };
  struct Trial
  {
    Index fragment, other;
    Flattened_chart merged;
  };

  /// A fragment and another chart as they are now. Charts only grow: a triangle and their size tell which.
  /// The order counts: who is given away decides along which border the two are glued.
  using Pair = std::array<std::pair<Index, std::size_t>, 2>;
  Pair pair_of(Index fragment, Index other) const
  {
    return {std::pair(charts_[fragment].chart.source.front(), size(fragment)),
            std::pair(charts_[other].chart.source.front(), size(other))};
  }

  std::size_t size(Index c) const { return charts_[c].chart.number_of_triangles(); }

  /// One batch of disjoint pairs. Fragments that are merged or have nothing more to try leave `open`.
  std::size_t merge_some(std::vector<Fragment>& open)
  {
    std::vector<Trial> trials = take_trials(open);
    for (const Trial& trial : trials)
      trial_merge_.merge(charts_[trial.fragment].chart, trial.other);
    execution_.for_each(trials.size(), [&](std::size_t i) { attempt(trials[i]); });
    std::size_t merged = 0;
    for (Trial& trial : trials)
      merged += settle(trial);
    std::erase_if(open, [&](const Fragment& fragment) { return size(fragment.chart) == 0; });
    return merged;
  }

  std::vector<Trial> take_trials(std::vector<Fragment>& open)
  {
    std::vector<Trial> trials;
    std::vector<Index> busy;
    const auto is_busy = [&](Index c) { return std::find(busy.begin(), busy.end(), c) != busy.end(); };
    std::vector<std::uint8_t> is_done(std::min(open.size(), window), 0);
    for (std::size_t i = 0; i < is_done.size() && trials.size() < batch; ++i) {
      Fragment& fragment = open[i];
      if (is_busy(fragment.chart))
        continue;
      const Index other = next_neighbour(fragment);
      is_done[i] = other == no_index;
      if (is_done[i] || is_busy(other))
        continue;
      fragment.tried.push_back(other);
      const std::size_t triangles = size(fragment.chart) + size(other);
      if (triangles > budget_)
        continue;
      budget_ -= triangles;
      trials.push_back({fragment.chart, other, {}});
      busy.push_back(fragment.chart);
      busy.push_back(other);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < open.size(); ++i)
      if (i >= is_done.size() || !is_done[i]) {
        if (kept != i)
          open[kept] = std::move(open[i]);
        ++kept;
      }
    open.resize(kept);
    return trials;
  }

  /// One that it has not tried, nor in an earlier pass when the two were as they are now.
  Index next_neighbour(Fragment& fragment) const
  {
    for (const Index other : trial_merge_.neighbours(charts_[fragment.chart].chart)) {
      if (fragment.tried.size() >= tries)
        break;
      if (std::find(fragment.tried.begin(), fragment.tried.end(), other) != fragment.tried.end())
        continue;
      if (!refused_.contains(pair_of(fragment.chart, other)))
        return other;
      fragment.tried.push_back(other);
    }
    return no_index;
  }

  void attempt(Trial& trial)
  {
    const std::vector<Index>&a = charts_[trial.fragment].chart.source, &b = charts_[trial.other].chart.source;
    std::vector<Index> triangles;
    std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(triangles));
    Chart chart = extract_chart(surface_, segmentation_, triangles, local_);
    if (topology(chart).is_disc())
      trial.merged = flatten_(std::move(chart));
  }

  bool settle(Trial& trial)
  {
    Flattened_chart &fragment = charts_[trial.fragment], &other = charts_[trial.other];
    const bool is_accepted = !trial.merged.chart.source.empty() && accept_(trial.merged, fragment, other);
    if (is_accepted) {
      budget_ += trial.merged.chart.number_of_triangles(); // only failures are counted
      other = std::move(trial.merged);
      fragment = Flattened_chart();
    } else {
      trial_merge_.undo(fragment.chart);
      refused_.insert(pair_of(trial.fragment, trial.other));
    }
    return is_accepted;
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  std::vector<Flattened_chart>& charts_;
  Flatten flatten_;
  Accept accept_;
  const Execution& execution_;
  Trial_merge trial_merge_;
  std::vector<Index> local_; ///< scratch: charts are disjoint, each writes its own entries
  std::size_t budget_;
  std::set<Pair> refused_; ///< what need not be tried again
};

} // namespace Atlas::internal

#endif
