// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_REJOINING_TRIAL_MERGE_H
#define ATLAS_SEGMENTATION_INTERNAL_REJOINING_TRIAL_MERGE_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/cuts.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/core/internal/halfedges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Makes one chart of two neighbours, on trial.
///
/// Two discs are glued along one run of their common border, so that they are one disc; where they touch
/// elsewhere, a cut remains. Edges that have to be seams and borders of patches are never glued.
class Trial_merge
{
public:
  Trial_merge(const Surface& surface, Segmentation& segmentation)
      : surface_(surface), segmentation_(segmentation)
  {}

  /// The charts beside a disc with runs along which it may be glued, the longest first. O(n log n).
  std::vector<Index> neighbours(const Chart& disc) const
  {
    std::map<Index, double> longest;
    for (const Run& run : runs(disc)) {
      double& length = longest[run.other];
      length = std::max(length, run.length);
    }
    std::vector<std::pair<double, Index>> order;
    for (const auto& [chart, length] : longest)
      order.emplace_back(-length, chart);
    std::sort(order.begin(), order.end());
    std::vector<Index> result;
    for (const auto& entry : order)
      result.push_back(entry.second);
    return result;
  }

  /// Gives the triangles of `disc` to the chart `other`, one of its `neighbours()`.
  void merge(const Chart& disc, Index other)
  {
    const std::vector<Run> all = runs(disc);
    const Run* best = nullptr;
    for (const Run& run : all)
      if (run.other == other && (!best || run.length > best->length))
        best = &run;
    if (!best)
      throw std::logic_error("Trial_merge: no border that may be glued");
    Before& before = before_[disc.source.front()];
    before = {segmentation_.chart[disc.source.front()], {}};
    const auto change_cut = [&](Index h, bool is_cut) {
      before.cuts.emplace_back(h, segmentation_.cut[h]);
      set_cut(surface_, segmentation_, h, is_cut);
    };
    for (const Index t : disc.source) {
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (const Index o = surface_.opposite[h]; o != no_index && segmentation_.chart[o / 3] == other)
          change_cut(h, true);
    }
    for (const Index h : best->halfedges)
      change_cut(h, false);
    for (const Index t : disc.source)
      segmentation_.chart[t] = other;
  }

  /// Takes back the last `merge()` of the disc.
  void undo(const Chart& disc)
  {
    const Before& before = before_.at(disc.source.front());
    for (const Index t : disc.source)
      segmentation_.chart[t] = before.chart;
    for (auto it = before.cuts.rbegin(); it != before.cuts.rend(); ++it)
      set_cut(surface_, segmentation_, it->first, it->second);
  }

private:
  struct Before
  {
    Index chart = no_index;
    std::vector<std::pair<Index, std::uint8_t>> cuts; ///< in the order in which they were set
  };

  struct Run
  {
    Index other;
    double length = 0;
    std::vector<Index> halfedges;
  };

  /// The maximal runs of border halfedges that face one other chart, consecutive on both sides.
  std::vector<Run> runs(const Chart& disc) const
  {
    std::vector<Run> result;
    for (std::vector<Index> loop : border_loops(opposite_halfedges(disc.triangles))) {
      for (Index& h : loop)
        h = 3 * disc.source[h / 3] + h % 3;
      const std::size_t n = loop.size();
      std::size_t start = 0; // where a run begins, or anywhere
      while (start < n && goes_on(loop[(start + n - 1) % n], loop[start]))
        ++start;
      start = start == n ? 0 : start;
      for (std::size_t k = 0; k < n; ++k) {
        const Index h = loop[(start + k) % n], other = other_of(h);
        if (other == no_index)
          continue;
        if (k == 0 || !goes_on(loop[(start + k - 1) % n], h))
          result.push_back({other, 0, {}});
        result.back().halfedges.push_back(h);
        result.back().length +=
            std::sqrt(CGAL::squared_distance(surface_.point(h), surface_.point(next_halfedge(h))));
      }
    }
    return result;
  }

  /// The chart that may be glued there.
  Index other_of(Index h) const
  {
    const Index o = surface_.opposite[h];
    if (must_be_seam(surface_, h) || segmentation_.chart[o / 3] == segmentation_.chart[h / 3])
      return no_index;
    return segmentation_.chart[o / 3];
  }

  /// Whether two consecutive border halfedges face the same chart, and follow each other on its border.
  bool goes_on(Index h, Index next) const
  {
    const Index other = other_of(next);
    if (other == no_index || other_of(h) != other)
      return false;
    const auto is_seam = [&](Index g) { return !segmentation_.is_glued(surface_, g); };
    return next_on_border(surface_.opposite, surface_.opposite[next], is_seam) == surface_.opposite[h];
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  std::map<Index, Before> before_; ///< per first triangle of what was merged
};

} // namespace Atlas::internal

#endif
