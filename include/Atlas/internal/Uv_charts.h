// SPDX-License-Identifier: MIT
#ifndef ATLAS_INTERNAL_UV_CHARTS_H
#define ATLAS_INTERNAL_UV_CHARTS_H

#include <Atlas/Execution.h>
#include <Atlas/Surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Disjoint sets with path halving; the smallest member names the set.
class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index(0)); }

  Index find(Index i)
  {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Whether the two were in different sets before.
  bool join(Index i, Index j)
  {
    i = find(i);
    j = find(j);
    if (i == j)
      return false;
    parent_[std::max(i, j)] = std::min(i, j);
    return true;
  }

private:
  std::vector<Index> parent_;
};

/// The charts that coordinates at corners make of a surface: triangles that share an edge in space and have
/// equal coordinates at both of its ends are glued.
class Uv_charts
{
public:
  /// \param uv    per corner of the surface
  /// \param page  per triangle: charts end where it changes; `no_index`: the triangle belongs to no chart
  Uv_charts(const Surface& surface, std::span<const Point_2> uv, const std::vector<Index>& page)
      : surface_(surface), uv_(uv), page_(page), glued_(uv.size(), no_index), is_crowded_(uv.size(), false),
        triangles_(surface.number_of_triangles()), corners_(uv.size())
  {
    std::vector<Index> open;
    for (Index h = 0; h < uv.size(); ++h) {
      const Index o = surface.opposite[h];
      if (o == no_index)
        open.push_back(h);
      else if (h < o)
        glue_pair(h, o);
    }
    glue_open(open);
    number_charts();
    find_topology();
  }

  struct Chart_counts
  {
    Index triangles = 0, border_components = 0;
    long long euler = 0;
    bool is_crowded = false; ///< an edge is glued from more than two triangles
    bool is_disc() const { return euler == 1 && border_components == 1 && !is_crowded; }
  };

  std::size_t number_of_charts() const { return counts_.size(); }
  const Chart_counts& counts(Index chart) const { return counts_[chart]; }
  Index chart(Index triangle) const { return chart_[triangle]; }
  /// The halfedge on the other side, if the edge is glued from exactly two triangles.
  Index glued(Index h) const { return glued_[h]; }
  /// Whether the edge belongs to one triangle only, in the plane.
  bool is_border(Index h) const { return is_used(h / 3) && glued_[h] == no_index && !is_crowded_[h]; }
  double seam_length() const { return seam_length_; }

private:
  bool is_used(Index t) const { return page_[t] != no_index; }

  double length(Index h) const
  {
    return std::sqrt(CGAL::squared_distance(surface_.point(h), surface_.point(next_halfedge(h))));
  }

  void glue_pair(Index h, Index o)
  {
    if (is_used(h / 3) && page_[h / 3] == page_[o / 3] && uv_[h] == uv_[next_halfedge(o)] &&
        uv_[next_halfedge(h)] == uv_[o]) {
      glued_[h] = o;
      glued_[o] = h;
      triangles_.join(h / 3, o / 3);
      corners_.join(h, next_halfedge(o));
      corners_.join(next_halfedge(h), o);
    } else if (is_used(h / 3) || is_used(o / 3)) {
      seam_length_ += length(h);
    }
  }

  /// Edges that are not shared by exactly two consistently oriented triangles: those at the same place in
  /// space are one edge, on which all triangles with equal coordinates are glued, whichever way they run.
  void glue_open(const std::vector<Index>& open)
  {
    struct Edge
    {
      Point_3 a, b; ///< in space, in order
      Point_2 p, q; ///< in the plane
      Index page, halfedge, from, to;
    };
    std::vector<Edge> edges;
    for (const Index h : open) {
      const Index n = next_halfedge(h);
      if (!is_used(h / 3) || surface_.point(h) == surface_.point(n))
        continue;
      if (surface_.point(h) < surface_.point(n))
        edges.push_back({surface_.point(h), surface_.point(n), uv_[h], uv_[n], page_[h / 3], h, h, n});
      else
        edges.push_back({surface_.point(n), surface_.point(h), uv_[n], uv_[h], page_[h / 3], h, n, h});
    }
    const auto place = [](const Edge& e) { return std::tie(e.a, e.b); };
    const auto image = [](const Edge& e) { return std::tie(e.p, e.q, e.page); };
    std::sort(edges.begin(), edges.end(), [&](const Edge& e, const Edge& f) {
      return place(e) != place(f)   ? place(e) < place(f)
             : image(e) != image(f) ? image(e) < image(f)
                                    : e.halfedge < f.halfedge;
    });
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t end = i, sides = 0;
      const std::size_t first = i;
      for (; end < edges.size() && place(edges[end]) == place(edges[first]); ++sides) {
        const std::size_t side = end;
        while (end < edges.size() && place(edges[end]) == place(edges[side]) &&
               image(edges[end]) == image(edges[side]))
          ++end;
        for (std::size_t j = side + 1; j < end; ++j) {
          triangles_.join(edges[side].halfedge / 3, edges[j].halfedge / 3);
          corners_.join(edges[side].from, edges[j].from);
          corners_.join(edges[side].to, edges[j].to);
        }
        if (end - side == 2) {
          glued_[edges[side].halfedge] = edges[side + 1].halfedge;
          glued_[edges[side + 1].halfedge] = edges[side].halfedge;
        }
        // The first of a crowd stands for the edge when edges are counted.
        for (std::size_t j = side; end - side > 2 && j < end; ++j) {
          is_crowded_[edges[j].halfedge] = true;
          glued_[edges[j].halfedge] = no_index;
          if (j > side)
            crowd_followers_.push_back(edges[j].halfedge);
        }
      }
      if (sides > 1)
        seam_length_ += length(edges[first].halfedge);
      i = end;
    }
  }

  /// Charts get numbers in the order of their first triangles. One whose triangles are all collapsed to edges
  /// is none.
  void number_charts()
  {
    const std::size_t n = surface_.number_of_triangles();
    std::vector<Index> number(n, no_index);
    const auto is_collapsed = [&](Index t) {
      return surface_.point(3 * t) == surface_.point(3 * t + 1) ||
             surface_.point(3 * t + 1) == surface_.point(3 * t + 2) ||
             surface_.point(3 * t + 2) == surface_.point(3 * t);
    };
    for (Index t = 0; t < n; ++t)
      if (is_used(t)) {
        Index& name = number[triangles_.find(t)];
        if (name == no_index && !is_collapsed(t))
          name = static_cast<Index>(counts_.size()), counts_.emplace_back();
      }
    chart_.assign(n, no_index);
    for (Index t = 0; t < n; ++t)
      if (is_used(t))
        chart_[t] = number[triangles_.find(t)];
  }

  /// Vertices - edges + triangles, and the number of connected components of the border, per chart.
  void find_topology()
  {
    Disjoint_sets border(uv_.size());
    std::vector<std::uint8_t> is_on_border(uv_.size(), false);
    for (Index h = 0; h < uv_.size(); ++h) {
      const Index c = chart_[h / 3];
      if (c == no_index)
        continue;
      Chart_counts& counts = counts_[c];
      counts.is_crowded = counts.is_crowded || is_crowded_[h];
      counts.triangles += h % 3 == 0;
      counts.euler += (h % 3 == 0) + (corners_.find(h) == h) - (glued_[h] == no_index || h < glued_[h]);
      if (!is_border(h))
        continue;
      const Index ends[2] = {corners_.find(h), corners_.find(next_halfedge(h))};
      for (const Index v : ends) {
        counts.border_components += !is_on_border[v];
        is_on_border[v] = true;
      }
      counts.border_components -= border.join(ends[0], ends[1]);
    }
    for (const Index h : crowd_followers_)
      if (chart_[h / 3] != no_index)
        ++counts_[chart_[h / 3]].euler;
  }

  const Surface& surface_;
  std::span<const Point_2> uv_;
  const std::vector<Index>& page_;
  std::vector<Index> glued_;
  std::vector<std::uint8_t> is_crowded_;
  std::vector<Index> crowd_followers_;
  Disjoint_sets triangles_, corners_;
  std::vector<Index> chart_;
  std::vector<Chart_counts> counts_;
  double seam_length_ = 0;
};

} // namespace Atlas::internal

#endif
