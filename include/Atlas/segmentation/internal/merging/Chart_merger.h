// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_CHART_MERGER_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_CHART_MERGER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/segmentation/Merge_options.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/merging/layout_quality.h>
#include <Atlas/segmentation/internal/merging/merge_trial.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Which merges go first: those along borders that are long beside ...
enum class Merge_order {
  by_union,              ///< ... the root of the area of the union
  by_mean_perimeter,     ///< ... the geometric mean of both perimeters
  by_perimeter_in_union, ///< ... the perimeter of the smaller chart, small unions still earlier
  by_larger_perimeter,   ///< ... the perimeter of the larger chart, which makes round charts
  by_length,             ///< ... nothing
  by_smaller_area        ///< ... the root of the smaller area
};

/// \brief Merges the charts of a coarse surface along runs of arcs.
///
/// The border of each chart is a cyclic list of sides of arcs. Two discs glued along one run of consecutive
/// arcs are a disc again; arcs that they share elsewhere stay open as slits, which are zipped from their tips
/// later. `Flatten` is `Chart_status(Chart&)`; it is called for several charts at a time.
template <typename Flatten>
class Chart_merger
{
public:
  /// \param weight  per arc: what its length counts
  Chart_merger(const Coarse_surface& surface, const Chart_arcs& arcs, const std::vector<double>& weight,
               Index charts, const Merge_options& options, const Flatten& flatten, const Execution& execution)
      : surface_(surface), options_(options), flatten_(flatten), execution_(execution),
        is_barrier_(arcs.must_be_seam), roots_(charts), local_(surface.triangles.size()),
        place_(surface.triangles.size()), number_of_charts_(charts)
  {
    take_arcs(weight);
    take_parts(charts);
    flatten_parts();
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
  double seam_length() const
  {
    double sum = 0;
    for (Index a = 0; a < is_barrier_.size(); ++a)
      if (!is_glued_[a] && owner_[2 * a] != no_index && owner_[2 * a + 1] != no_index)
        sum += length_[a];
    return sum;
  }
  std::size_t number_of_charts() const { return number_of_charts_; }
  /// Triangles flattened for trial, those of accepted trials among them.
  std::size_t work() const { return work_; }

  Index chart_of(Index chart) { return roots_.find(chart); }
  bool is_glued(Index arc) const { return is_glued_[arc] != 0; }

private:
  struct Part
  {
    std::vector<Index> triangles;
    Chart layout; ///< flat; empty if that failed
    double area = 0, perimeter = 0;
    double solidity = 0;   ///< of the layout
    Index side = no_index; ///< one of its border
    Index version = 0;
  };

  struct Entry
  {
    double priority;
    Index side, version, other_version;
    bool is_single; ///< only this arc, not all of its run
    bool operator<(const Entry& o) const
    {
      return std::tie(priority, o.side, version, other_version, o.is_single) <
             std::tie(o.priority, side, o.version, o.other_version, is_single);
    }
  };

  struct Candidate
  {
    Index part, other;      ///< equal: a slit
    std::vector<Index> run; ///< sides of `part`, in its order
    Chart layout;
    bool is_accepted = false;
  };

  // --- Setting up

  void take_arcs(const std::vector<double>& weight)
  {
    const std::size_t sides = 2 * is_barrier_.size();
    next_.assign(sides, no_index);
    previous_.assign(sides, no_index);
    owner_.assign(sides, no_index);
    first_halfedge_.assign(sides, no_index);
    length_.assign(is_barrier_.size(), 0);
    is_glued_.assign(is_barrier_.size(), 0);
    is_on_trial_.assign(is_barrier_.size(), 0);
    for (Index h = 0; h < surface_.side.size(); ++h) {
      const Index s = surface_.side[h];
      if (s == no_index)
        continue;
      owner_[s] = surface_.chart[h / 3];
      if (s % 2 == 0)
        length_[s / 2] += std::sqrt(CGAL::squared_distance(point(h), point(next_halfedge(h))));
      if (is_last_on_side(h)) {
        const Index g = next_on_side(h), r = surface_.side[g];
        next_[s] = r;
        previous_[r] = s;
        first_halfedge_[r] = g;
      }
    }
    for (Index a = 0; a < length_.size(); ++a)
      length_[a] *= weight[a];
  }

  const Point_3& point(Index h) const { return surface_.points[surface_.triangles[h / 3][h % 3]]; }

  void take_parts(Index charts)
  {
    parts_.resize(charts);
    for (Index t = 0; t < surface_.chart.size(); ++t) {
      Part& part = parts_[surface_.chart[t]];
      part.triangles.push_back(t);
      part.area += std::sqrt(CGAL::squared_area(point(3 * t), point(3 * t + 1), point(3 * t + 2)));
    }
    for (Index s = 0; s < owner_.size(); ++s)
      if (owner_[s] != no_index) {
        Part& part = parts_[owner_[s]];
        part.side = std::min(part.side, s);
        part.perimeter += length_[s / 2];
      }
    for (const Part& part : parts_)
      whole_area_ += part.area;
  }

  /// Parts too large for any trial have no layout.
  void flatten_parts()
  {
    execution_.for_each(parts_.size(), [&](std::size_t p) {
      if (parts_[p].triangles.size() > options_.max_trial_triangles)
        return;
      Chart chart = extract(parts_[p].triangles);
      if (flatten_(chart) == Chart_status::valid)
        keep_layout(parts_[p], std::move(chart));
    });
  }

  // --- Trials

  bool is_open(Index h) const
  {
    const Index s = surface_.side[h];
    return s == no_index ? false : !is_glued_[s / 2] && !is_on_trial_[s / 2];
  }

  /// Copies triangles out as `extract_chart()` does.
  Chart extract(const std::vector<Index>& triangles)
  {
    Chart chart;
    chart.source = triangles;
    chart.triangles.assign(triangles.size(), {no_index, no_index, no_index});
    for (Index i = 0; i < triangles.size(); ++i)
      local_[triangles[i]] = i;
    const auto slot = [&](Index h) -> Index& { return chart.triangles[local_[h / 3]][h % 3]; };
    for (const Index t : triangles)
      for (Index start = 3 * t; start < 3 * t + 3; ++start) {
        if (slot(start) != no_index)
          continue;
        const Index vertex = static_cast<Index>(chart.points.size());
        chart.points.push_back(point(start));
        bool closed = false;
        for (Index h = start; !closed;) {
          slot(h) = vertex;
          const Index before = previous_halfedge(h);
          if (is_open(before))
            break;
          h = surface_.opposite[before];
          closed = h == start;
        }
        for (Index h = start; !closed && !is_open(h);) {
          h = next_halfedge(surface_.opposite[h]);
          slot(h) = vertex;
        }
      }
    return chart;
  }

  void keep_layout(Part& part, Chart layout)
  {
    for (Index i = 0; i < part.triangles.size(); ++i)
      place_[part.triangles[i]] = i;
    part.solidity = internal::solidity(layout);
    part.layout = std::move(layout);
  }

  /// Where the halfedge starts in the layout of its part.
  const Point_2& uv(const Chart& layout, Index h) const
  {
    return layout.uv[layout.triangles[place_[h / 3]][h % 3]];
  }

  /// Whether the borders of the two layouts differ too much along the run to be glued.
  bool fits(const Candidate& c) const
  {
    const Chart &a = parts_[c.part].layout, &b = parts_[c.other].layout;
    if (a.uv.empty() || b.uv.empty())
      return true;
    std::vector<Point_2> p, q;
    for (const Index s : c.run)
      for (Index h = first_halfedge_[s];; h = next_on_side(h)) {
        const Index o = surface_.opposite[h];
        p.push_back(uv(a, h));
        q.push_back(uv(b, next_halfedge(o)));
        if (is_last_on_side(h)) {
          if (s == c.run.back()) {
            p.push_back(uv(a, next_halfedge(h)));
            q.push_back(uv(b, o));
          }
          break;
        }
      }
    const double size = std::sqrt(parts_[c.part].area + parts_[c.other].area);
    return chain_misfit(p, q) <= options_.max_misfit * size;
  }

  Index next_on_side(Index h) const
  {
    return next_on_border(surface_.opposite, h, [&](Index g) { return surface_.side[g] != no_index; });
  }
  bool is_last_on_side(Index h) const
  {
    const Index g = next_halfedge(h);
    return surface_.is_fixed[surface_.triangles[g / 3][g % 3]];
  }

  /// What can be told without flattening.
  bool is_promising(const Candidate& c) const
  {
    const Part &a = parts_[c.part], &b = parts_[c.other];
    if (a.triangles.size() + b.triangles.size() > options_.max_trial_triangles)
      return false;
    // Gluing hardly fills more of the hull than both fill of theirs.
    if (is_past_bound())
      return true;
    const double area = a.area + b.area, filled = (a.solidity * a.area + b.solidity * b.area) / area;
    return !(area > options_.max_area_share * whole_area_ &&
             filled < 0.85 * options_.solidity_of_large_charts) &&
           fits(c);
  }

  void attempt(Candidate& c)
  {
    std::vector<Index> triangles = parts_[c.part].triangles;
    if (c.part != c.other)
      triangles.insert(triangles.end(), parts_[c.other].triangles.begin(), parts_[c.other].triangles.end());
    c.layout = extract(triangles);
    c.is_accepted = triangles.size() <= options_.max_trial_triangles &&
                    flatten_(c.layout) == Chart_status::valid && is_acceptable(c);
  }

  bool is_acceptable(const Candidate& c) const
  {
    const Chart& chart = c.layout;
    if (!is_within_bound(chart, options_, past_bound_))
      return false;
    if (is_past_bound())
      return true;
    std::vector<Border_edge> border;
    for (Index i = 0; i < chart.triangles.size(); ++i) {
      for (Index k = 0; k < 3; ++k)
        if (is_open(3 * chart.source[i] + k)) {
          const Index a = chart.triangles[i][k], b = chart.triangles[i][(k + 1) % 3];
          border.push_back({chart.uv[a], chart.uv[b], a, b});
        }
    }
    const double filled = solidity(chart);
    const double share = (parts_[c.part].area + (c.part != c.other ? parts_[c.other].area : 0)) / whole_area_;
    if (c.part != c.other && share > options_.max_area_share && filled < options_.solidity_of_large_charts)
      return false;
    return (c.part == c.other || filled >= options_.min_solidity) &&
           is_clear(std::move(border), options_.min_gap);
  }

  // --- Runs of arcs

  Index part_of_side(Index s) { return owner_[s] == no_index ? no_index : roots_.find(owner_[s]); }

  bool is_mergeable(Index s)
  {
    return !is_barrier_[s / 2] && !is_glued_[s / 2] && owner_[s] != no_index && owner_[s ^ 1] != no_index &&
           part_of_side(s) != part_of_side(s ^ 1);
  }

  /// The longest run of consecutive arcs around s that lie between the same two parts; only s if that is the
  /// whole border of both, and nothing if s is.
  std::vector<Index> run_of(Index s)
  {
    std::vector<Index> run{s};
    for (;;) {
      const Index last = run.back(), n = next_[last];
      if (n == s && previous_[last ^ 1] == (n ^ 1))
        return run.size() > 1 ? std::vector<Index>{s} : std::vector<Index>{};
      if (n == s || previous_[last ^ 1] != (n ^ 1) || is_barrier_[n / 2])
        break;
      run.push_back(n);
    }
    std::vector<Index> before;
    for (Index first = s;;) {
      const Index p = previous_[first];
      if (p == run.back() || next_[first ^ 1] != (p ^ 1) || is_barrier_[p / 2])
        break;
      before.push_back(first = p);
    }
    run.insert(run.begin(), before.rbegin(), before.rend());
    return run;
  }

  double length_of(const std::vector<Index>& run) const
  {
    double sum = 0;
    for (const Index s : run)
      sum += length_[s / 2];
    return sum;
  }

  void push(Index s, const std::vector<Index>& run, bool is_single)
  {
    const Part &a = parts_[part_of_side(s)], &b = parts_[part_of_side(s ^ 1)];
    if (is_past_bound() && !is_wanted_past_bound(a, b))
      return;
    const double yardstick = yardstick_of(a, b);
    const double priority = yardstick > 0 ? length_of(run) / yardstick : 1;
    queue_.push({priority, s, a.version, b.version, is_single});
  }

  double yardstick_of(const Part& a, const Part& b) const
  {
    switch (order_) {
    case Merge_order::by_union:
      return std::sqrt(a.area + b.area);
    case Merge_order::by_mean_perimeter:
      return std::sqrt(a.perimeter * b.perimeter);
    case Merge_order::by_perimeter_in_union:
      return std::min(a.perimeter, b.perimeter) * std::sqrt(std::sqrt(a.area + b.area));
    case Merge_order::by_larger_perimeter:
      return std::max(a.perimeter, b.perimeter);
    case Merge_order::by_length:
      return 1;
    case Merge_order::by_smaller_area:
      return std::sqrt(std::min(a.area, b.area));
    }
    return 0;
  }

  /// A run that must not be glued as a whole may still be along its longest arc: what stays open is a slit.
  void push_longest_arc(const std::vector<Index>& run)
  {
    if (run.size() > 1)
      if (const Index s = *std::max_element(
              run.begin(), run.end(),
              [&](Index a, Index b) { return std::tie(length_[a / 2], b) < std::tie(length_[b / 2], a); });
          !is_refused_alone_[s / 2])
        push(s, {s}, true);
  }

  /// Puts the runs of the part's border into the queue, each once.
  void push_runs(Index part)
  {
    const Index start = parts_[part].side;
    if (start == no_index)
      return;
    Index s = start;
    do {
      const Index p = previous_[s];
      const bool goes_on = p != s && is_mergeable(p) && next_[s ^ 1] == (p ^ 1);
      if (is_mergeable(s) && (!goes_on || s == start))
        if (const std::vector<Index> run = run_of(s); run.size() > 0)
          push(s, run, false);
      s = next_[s];
    } while (s != start);
  }

  // --- Merging

  void sweep()
  {
    is_refused_.assign(is_barrier_.size(), 0);
    is_refused_alone_.assign(is_barrier_.size(), 0);
    for (Index p = 0; p < parts_.size(); ++p)
      if (roots_.find(p) == p)
        push_runs(p);
    merge();
  }

  bool is_past_bound() const { return past_bound_ > 1; }

  bool has_too_many_charts() const
  {
    return options_.max_charts > 0 && number_of_charts_ > options_.max_charts;
  }

  bool is_wanted_past_bound(const Part& a, const Part& b) const
  {
    return has_too_many_charts() || std::min(a.area, b.area) < options_.min_chart_area * whole_area_;
  }

  /// Goes on while there are too many charts or too small ones: past the bound, but no farther than needed.
  void merge_past_bound()
  {
    if (options_.max_charts == 0 && !(options_.min_chart_area > 0))
      return;
    constexpr double step = 4, enough = 1e9;
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

  /// Takes promising candidates whose parts are all different from the queue. Their number does not depend on
  /// the number of threads, so neither does the result.
  std::vector<Candidate> take_batch()
  {
    std::vector<Candidate> batch;
    std::vector<Entry> later;
    std::vector<Index> busy;
    const auto is_busy = [&](Index p) { return std::find(busy.begin(), busy.end(), p) != busy.end(); };
    while (!queue_.empty() && batch.size() < batch_size() && later.size() < 4 * options_.batch) {
      const Entry entry = queue_.top();
      queue_.pop();
      const Index s = entry.side;
      if (!is_mergeable(s))
        continue;
      Candidate c{part_of_side(s), part_of_side(s ^ 1), {}, {}, false};
      if (parts_[c.part].version != entry.version || parts_[c.other].version != entry.other_version)
        continue; // pushed anew when the part changed
      if (is_past_bound() && !is_wanted_past_bound(parts_[c.part], parts_[c.other]))
        continue;
      if (is_busy(c.part) || is_busy(c.other)) {
        later.push_back(entry);
        continue;
      }
      c.run = entry.is_single ? std::vector<Index>{s} : run_of(s);
      if (!entry.is_single && is_mostly_refused(c.run))
        continue;
      if (!is_promising(c)) {
        refuse(c.run);
        continue;
      }
      busy.push_back(c.part);
      busy.push_back(c.other);
      batch.push_back(std::move(c));
    }
    for (const Entry& entry : later)
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
      refused += is_refused_[s / 2] ? length_[s / 2] : 0;
    return refused > 0.5 * length_of(run);
  }

  void refuse(const std::vector<Index>& run)
  {
    if (run.size() == 1)
      is_refused_alone_[run.front() / 2] = 1;
    for (const Index s : run)
      is_refused_[s / 2] = 1;
    push_longest_arc(run);
  }

  void attempt_all(std::vector<Candidate>& batch)
  {
    for (const Candidate& c : batch) {
      for (const Index s : c.run)
        is_on_trial_[s / 2] = 1;
      work_ += parts_[c.part].triangles.size();
      if (c.part != c.other)
        work_ += parts_[c.other].triangles.size();
    }
    execution_.for_each(batch.size(), [&](std::size_t i) { attempt(batch[i]); });
    for (const Candidate& c : batch)
      for (const Index s : c.run)
        is_on_trial_[s / 2] = 0;
  }

  void merge()
  {
    while (execution_.proceed(0.5)) {
      std::vector<Candidate> batch = take_batch();
      if (batch.empty())
        break;
      attempt_all(batch);
      for (Candidate& c : batch)
        if (c.is_accepted)
          push_runs(accept(c));
        else
          refuse(c.run);
    }
    queue_ = {};
  }

  /// Joins the two parts, or closes the slit; returns the part.
  Index accept(Candidate& c)
  {
    for (const Index s : c.run)
      glue(s);
    const Index part = c.part == c.other ? c.part : std::min(c.part, c.other);
    Part merged;
    merged.triangles = c.layout.source;
    merged.area = parts_[c.part].area;
    merged.perimeter = parts_[c.part].perimeter - 2 * length_of(c.run);
    merged.side = remaining_side_;
    merged.version = parts_[part].version + 1;
    if (c.part != c.other) {
      merged.area += parts_[c.other].area;
      merged.perimeter += parts_[c.other].perimeter;
      merged.version += parts_[c.part == part ? c.other : c.part].version;
      parts_[c.part] = parts_[c.other] = Part();
      roots_.unite(c.part, c.other);
      --number_of_charts_;
    }
    parts_[part] = std::move(merged);
    keep_layout(parts_[part], std::move(c.layout));
    return part;
  }

  /// Takes both sides of an arc out of the borders. Either they are on different borders, which become one,
  /// or they follow each other.
  void glue(Index s)
  {
    const Index t = s ^ 1;
    const auto link = [&](Index p, Index n) {
      next_[p] = n;
      previous_[n] = p;
      remaining_side_ = n;
    };
    const Index p = previous_[s], n = next_[s], q = previous_[t], m = next_[t];
    if (n == t)
      link(p, m);
    else if (m == s)
      link(q, n);
    else if (t == m)
      link(p, n);
    else if (s == n)
      link(q, m);
    else {
      link(p, m);
      link(q, n);
    }
    is_glued_[s / 2] = 1;
  }

  // --- Slits

  /// Closes slits from their tips while the bound allows it.
  void zip()
  {
    std::vector<std::uint8_t> is_stuck(is_barrier_.size(), 0);
    while (execution_.proceed(0.6)) {
      std::vector<Candidate> batch;
      std::vector<std::uint8_t> has_one(parts_.size(), 0);
      for (Index s = 0; s < next_.size(); ++s) {
        if (owner_[s] == no_index || owner_[s ^ 1] == no_index || is_glued_[s / 2] || is_barrier_[s / 2] ||
            is_stuck[s / 2] || next_[s] != (s ^ 1) || next_[s ^ 1] == s)
          continue;
        const Index p = part_of_side(s);
        if (has_one[p])
          continue;
        has_one[p] = 1;
        batch.push_back({p, p, {s}, {}, false});
      }
      if (batch.empty())
        break;
      attempt_all(batch);
      for (Candidate& c : batch)
        if (c.is_accepted)
          accept(c);
        else
          is_stuck[c.run.front() / 2] = 1;
    }
  }

  const Coarse_surface& surface_;
  const Merge_options& options_;
  const Flatten& flatten_;
  const Execution& execution_;

  std::vector<std::uint8_t> is_barrier_, is_glued_, is_on_trial_, is_refused_, is_refused_alone_; ///< per arc
  std::vector<double> length_;                                                                    ///< per arc
  std::vector<Index> next_, previous_; ///< per side: along the border of its part
  std::vector<Index> owner_;           ///< per side: the chart it was found at
  std::vector<Index> first_halfedge_;  ///< per side
  std::vector<Part> parts_;            ///< per chart; of merged ones the one with the least number
  Union_find roots_;
  std::vector<Index> local_; ///< per triangle: scratch of trials
  std::vector<Index> place_; ///< per triangle: its number in the layout of its part
  std::priority_queue<Entry> queue_;
  double whole_area_ = 0;
  Index remaining_side_ = no_index;
  std::size_t number_of_charts_ = 0, work_ = 0;
  Merge_order order_ = Merge_order::by_union;
  double past_bound_ = 1; ///< how many times the distortion beyond 1 may exceed that of the bound
};

} // namespace Atlas::internal

#endif
