// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_TRIALS_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_MERGE_TRIALS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/internal/extract_triangles.h>
#include <Atlas/segmentation/internal/merging/Arc_borders.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/merging/Trial_memory.h>
#include <Atlas/segmentation/internal/merging/layout_limits.h>
#include <Atlas/segmentation/internal/merging/layout_quality.h>
#include <Atlas/segmentation/merge_charts.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Fills `uv` of a chart, and tells whether it is valid. Called from several threads.
using Trial_flattening = std::function<Chart_status(Chart&)>;

/// \brief A chart on the coarse surface, as it has been merged so far.
struct Mergeable_chart
{
  std::vector<Index> triangles;
  Chart layout;                   ///< flat; empty if that failed
  double area = 0, perimeter = 0; ///< not weighted: where seams are dear, charts merge first
  double solidity = 0;            ///< of the layout
  Index side = no_index;          ///< one of its border
  Index version = 0;              ///< another one after each merge
};

/// \brief Two charts that may be glued along a run of arcs, or a chart and a slit in it that may be closed.
struct Merge_candidate
{
  Index chart, other;     ///< equal: a slit
  std::vector<Index> run; ///< sides of `chart`, in its order
  Chart layout;           ///< of the union
  bool is_accepted = false;

  bool is_slit() const { return chart == other; }
};

/// \brief Flattens unions of charts for trial, and decides whether they stay within the bounds. Copies share
/// what they have found.
class Merge_trials
{
public:
  Merge_trials(const Coarse_surface& surface, const Merge_options& options, const Trial_flattening& flatten,
               double whole_area, std::size_t arcs)
      : surface_(surface), options_(options), flatten_(flatten), whole_area_(whole_area),
        is_on_trial_(arcs, 0), local_(surface.triangles.size()), place_(surface.triangles.size())
  {}

  /// Triangles of all unions that were tried, those of accepted ones among them.
  std::size_t work() const { return work_; }

  /// Flattens charts before any has been merged. Those too large for any trial have no layout.
  void flatten_all(const Arc_borders& borders, std::vector<Mergeable_chart>& charts,
                   const Execution& execution)
  {
    execution.for_each(charts.size(), [&](std::size_t c) {
      if (charts[c].triangles.size() > options_.max_trial_triangles)
        return;
      Chart chart = extract(borders, charts[c].triangles);
      if (flatten_(chart) == Chart_status::valid)
        keep_layout(charts[c], std::move(chart));
    });
  }

  void keep_layout(Mergeable_chart& chart, Chart layout)
  {
    for (Index i = 0; i < chart.triangles.size(); ++i)
      place_[chart.triangles[i]] = i;
    chart.solidity = solidity(layout);
    chart.layout = std::move(layout);
  }

  /// What can be told of two charts without flattening.
  bool is_promising(const Arc_borders& borders, const Mergeable_chart& a, const Mergeable_chart& b,
                    const std::vector<Index>& run, double past_bound) const
  {
    // Gluing hardly fills more of the hull than both fill of theirs: at most by the inverse of this factor.
    constexpr double gain_of_solidity = 0.85;
    if (a.triangles.size() + b.triangles.size() > options_.max_trial_triangles)
      return false;
    if (past_bound > 1)
      return true;
    const double area = a.area + b.area, filled = (a.solidity * a.area + b.solidity * b.area) / area;
    return !(area > options_.max_area_share * whole_area_ &&
             filled < gain_of_solidity * options_.solidity_of_large_charts) &&
           fits(borders, a, b, run);
  }

  /// Flattens all candidates, which have no chart in common, and accepts what stays within the bounds.
  /// \param past_bound  how many times the distortion beyond 1 may exceed that of the bound
  void attempt_all(const Arc_borders& borders, const std::vector<Mergeable_chart>& charts,
                   std::vector<Merge_candidate>& batch, double past_bound, const Execution& execution)
  {
    for (const Merge_candidate& c : batch) {
      mark(c.run, 1);
      work_ += charts[c.chart].triangles.size() + (c.is_slit() ? 0 : charts[c.other].triangles.size());
    }
    execution.for_each(batch.size(), [&](std::size_t i) { attempt(borders, charts, batch[i], past_bound); });
    for (const Merge_candidate& c : batch)
      mark(c.run, 0);
  }

private:
  void mark(const std::vector<Index>& run, std::uint8_t value)
  {
    for (const Index s : run)
      is_on_trial_[s / 2] = value;
  }

  /// Whether charts, or those on trial, are not glued at a halfedge.
  bool is_open(const Arc_borders& borders, Index h) const
  {
    const Index s = surface_.side[h];
    return s != no_index && !borders.is_glued(s / 2) && !is_on_trial_[s / 2];
  }

  Chart extract(const Arc_borders& borders, const std::vector<Index>& triangles)
  {
    return extract_triangles(
        surface_.opposite, triangles, local_, [&](Index h) { return !is_open(borders, h); },
        [&](Index h) -> const Point_3& { return surface_.point(h); });
  }

  void attempt(const Arc_borders& borders, const std::vector<Mergeable_chart>& charts, Merge_candidate& c,
               double past_bound)
  {
    const Mergeable_chart &a = charts[c.chart], &b = charts[c.other];
    // Not remembered: it depends on more than the union.
    if (!c.is_slit() && !(past_bound > 1) && is_ragged(borders, a, b, c.run))
      return;
    std::vector<Index> triangles = a.triangles;
    if (!c.is_slit())
      triangles.insert(triangles.end(), b.triangles.begin(), b.triangles.end());
    c.layout = extract(borders, triangles);
    if (triangles.size() > options_.max_trial_triangles)
      return;
    if (past_bound > 1) {
      c.is_accepted =
          flatten_(c.layout) == Chart_status::valid && is_within_bound(c.layout, options_, past_bound);
      return;
    }
    const Trial_memory::Key key = Trial_memory::key(c.layout, c.is_slit());
    if (std::optional<Trial_memory::Verdict> known = memory_->find(key)) {
      c.is_accepted = known->is_accepted;
      c.layout.uv = std::move(known->uv);
      return;
    }
    c.is_accepted = flatten_(c.layout) == Chart_status::valid && is_within_bound(c.layout, options_) &&
                    has_good_shape(borders, c);
    memory_->remember(key, {c.is_accepted, c.is_accepted ? c.layout.uv : std::vector<Point_2>()});
  }

  /// Closing a slit changes the outline little; so only what it does to the border counts.
  bool has_good_shape(const Arc_borders& borders, const Merge_candidate& c) const
  {
    const Chart& chart = c.layout;
    const bool is_large = area_3d(chart) / whole_area_ > options_.max_area_share;
    if (!c.is_slit() && !fills_hull(chart, is_large, options_))
      return false;
    std::vector<Border_edge> border;
    for (Index i = 0; i < chart.triangles.size(); ++i)
      for (Index k = 0; k < 3; ++k)
        if (is_open(borders, 3 * chart.source[i] + k)) {
          const Index u = chart.triangles[i][k], v = chart.triangles[i][(k + 1) % 3];
          border.push_back({chart.uv[u], chart.uv[v], u, v});
        }
    return is_clear(std::move(border), options_.min_gap);
  }

  /// Where the halfedge starts in the layout of its chart.
  const Point_2& uv(const Chart& layout, Index h) const
  {
    return layout.uv[layout.triangles[place_[h / 3]][h % 3]];
  }

  /// How the layout of `b` comes beside that of `a`, along the run.
  Chain_fit fit(const Arc_borders& borders, const Mergeable_chart& a, const Mergeable_chart& b,
                const std::vector<Index>& run) const
  {
    std::vector<Point_2> p, q;
    Index last = no_index;
    for (const Index s : run)
      borders.for_each_halfedge(s, [&](Index h) {
        p.push_back(uv(a.layout, h));
        q.push_back(uv(b.layout, next_halfedge(surface_.opposite[h])));
        last = h;
      });
    p.push_back(uv(a.layout, next_halfedge(last)));
    q.push_back(uv(b.layout, surface_.opposite[last]));
    return chain_fit(p, q);
  }

  static bool are_flat(const Mergeable_chart& a, const Mergeable_chart& b)
  {
    return !a.layout.uv.empty() && !b.layout.uv.empty();
  }

  /// Whether the borders of the two layouts are alike enough along the run to be glued.
  bool fits(const Arc_borders& borders, const Mergeable_chart& a, const Mergeable_chart& b,
            const std::vector<Index>& run) const
  {
    return !are_flat(a, b) ||
           fit(borders, a, b, run).misfit <= options_.max_misfit * std::sqrt(a.area + b.area);
  }

  /// Whether the two layouts, side by side, fill too little of their hull. The layout of the union fills as
  /// much, within few per cent, or less: of two thousand trials on three models that this leaves out, one
  /// would have been accepted.
  bool is_ragged(const Arc_borders& borders, const Mergeable_chart& a, const Mergeable_chart& b,
                 const std::vector<Index>& run) const
  {
    constexpr double certain_share = 0.97; // of the least solidity
    const bool is_large = a.area + b.area > options_.max_area_share * whole_area_;
    return are_flat(a, b) && solidity_side_by_side(a.layout, b.layout, fit(borders, a, b, run)) <
                                 certain_share * least_solidity(is_large, options_);
  }

  const Coarse_surface& surface_;
  const Merge_options& options_;
  const Trial_flattening& flatten_;
  double whole_area_;
  std::size_t work_ = 0;
  std::shared_ptr<Trial_memory> memory_ = std::make_shared<Trial_memory>();
  std::vector<std::uint8_t> is_on_trial_; ///< per arc
  std::vector<Index> local_;              ///< per triangle: scratch, each trial has its own triangles
  std::vector<Index> place_;              ///< per triangle: its number in the layout of its chart
};

} // namespace Atlas::internal

#endif
