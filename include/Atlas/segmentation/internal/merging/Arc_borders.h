// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_MERGING_ARC_BORDERS_H
#define ATLAS_SEGMENTATION_INTERNAL_MERGING_ARC_BORDERS_H

#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The borders of the charts of a coarse surface as cyclic lists of sides of arcs, while charts merge.
///
/// Arc a has the sides 2a and 2a + 1; side s lies opposite to s ^ 1. Two discs glued along one run of
/// consecutive arcs are a disc again; arcs that they share elsewhere stay open as slits inside the chart.
class Arc_borders
{
public:
  /// \param weight  per arc: what its length counts
  Arc_borders(const Coarse_surface& surface, const std::vector<std::uint8_t>& must_be_seam,
              const std::vector<double>& weight)
      : surface_(surface), must_be_seam_(must_be_seam), is_glued_(must_be_seam.size(), 0),
        length_(must_be_seam.size(), 0), next_(2 * must_be_seam.size(), no_index), previous_(next_),
        owner_(next_), first_halfedge_(next_)
  {
    for (Index h = 0; h < surface.side.size(); ++h) {
      const Index s = surface.side[h];
      if (s == no_index)
        continue;
      owner_[s] = surface.chart[h / 3];
      if (s % 2 == 0)
        length_[s / 2] +=
            std::sqrt(CGAL::squared_distance(surface.point(h), surface.point(next_halfedge(h))));
      if (is_last_on_side(h)) {
        const Index g = next_on_arcs(h), r = surface.side[g];
        next_[s] = r;
        previous_[r] = s;
        first_halfedge_[r] = g;
      }
    }
    plain_length_ = length_;
    for (Index a = 0; a < length_.size(); ++a)
      length_[a] *= weight[a];
  }

  Index number_of_arcs() const { return static_cast<Index>(length_.size()); }
  Index number_of_sides() const { return static_cast<Index>(next_.size()); }

  Index next(Index s) const { return next_[s]; }
  Index previous(Index s) const { return previous_[s]; }
  /// The chart that the side was found at; `no_index` where the surface ends.
  Index owner(Index s) const { return owner_[s]; }
  /// Weighted.
  double length(Index arc) const { return length_[arc]; }
  /// Not weighted.
  double plain_length(Index arc) const { return plain_length_[arc]; }
  double length_of(const std::vector<Index>& run) const
  {
    double sum = 0;
    for (const Index s : run)
      sum += length_[s / 2];
    return sum;
  }

  bool is_glued(Index arc) const { return is_glued_[arc] != 0; }
  /// Whether the arc has a chart on both sides, the same one or not, and may be glued.
  bool is_open(Index s) const
  {
    return !must_be_seam_[s / 2] && !is_glued_[s / 2] && owner_[s] != no_index && owner_[s ^ 1] != no_index;
  }
  /// Whether the arc ends a slit: its sides follow each other on one border, and are not all of it.
  bool is_tip_of_slit(Index s) const { return is_open(s) && next_[s] == (s ^ 1) && next_[s ^ 1] != s; }

  /// The length of all seams inside the surface, as it counts.
  double seam_length() const
  {
    double sum = 0;
    for (Index a = 0; a < number_of_arcs(); ++a)
      if (!is_glued_[a] && owner_[2 * a] != no_index && owner_[2 * a + 1] != no_index)
        sum += length_[a];
    return sum;
  }

  /// The longest run of consecutive arcs around s that lie between the same two charts; only s if that is the
  /// whole border of both, and nothing if s is.
  std::vector<Index> run_of(Index s) const
  {
    std::vector<Index> run{s};
    for (;;) {
      const Index last = run.back(), n = next_[last];
      if (n == s && previous_[last ^ 1] == (n ^ 1))
        return run.size() > 1 ? std::vector<Index>{s} : std::vector<Index>{};
      if (n == s || previous_[last ^ 1] != (n ^ 1) || must_be_seam_[n / 2])
        break;
      run.push_back(n);
    }
    std::vector<Index> before;
    for (Index first = s;;) {
      const Index p = previous_[first];
      if (p == run.back() || next_[first ^ 1] != (p ^ 1) || must_be_seam_[p / 2])
        break;
      before.push_back(first = p);
    }
    run.insert(run.begin(), before.rbegin(), before.rend());
    return run;
  }

  /// Takes both sides of an arc out of the borders. Either they are on different borders, which become one,
  /// or they follow each other. Returns a side of the border that is left.
  Index glue(Index s)
  {
    const Index t = s ^ 1;
    Index remaining = no_index;
    const auto link = [&](Index p, Index n) {
      next_[p] = n;
      previous_[n] = p;
      remaining = n;
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
    return remaining;
  }

  /// Calls `visit(h)` for the halfedges of a side, in order.
  template <typename Visit>
  void for_each_halfedge(Index s, Visit visit) const
  {
    for (Index h = first_halfedge_[s];; h = next_on_arcs(h)) {
      visit(h);
      if (is_last_on_side(h))
        break;
    }
  }

private:
  Index next_on_arcs(Index h) const
  {
    return next_on_border(surface_.opposite, h, [&](Index g) { return surface_.side[g] != no_index; });
  }
  bool is_last_on_side(Index h) const
  {
    const Index g = next_halfedge(h);
    return surface_.is_fixed[surface_.triangles[g / 3][g % 3]];
  }

  const Coarse_surface& surface_;
  std::vector<std::uint8_t> must_be_seam_, is_glued_; ///< per arc
  std::vector<double> length_, plain_length_;         ///< per arc, weighted and not
  std::vector<Index> next_, previous_;                ///< per side: along the border of its chart
  std::vector<Index> owner_;                          ///< per side
  std::vector<Index> first_halfedge_;                 ///< per side
};

} // namespace Atlas::internal

#endif
