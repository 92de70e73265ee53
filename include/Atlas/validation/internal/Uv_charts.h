// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_UV_CHARTS_H
#define ATLAS_VALIDATION_INTERNAL_UV_CHARTS_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Union_find.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

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
    glue();
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

  /// Glues edges with an opposite one by one; those without, and those of vertices that are not alone at
  /// their place in space, place by place: there may be more triangles at the same edge. The place of an edge
  /// without length tells nothing.
  void glue()
  {
    const std::vector<bool> has_twin = find_twins();
    const auto vertex = [&](Index h) { return surface_.triangles[h / 3][h % 3]; };
    std::vector<Index> others;
    for (Index h = 0; h < uv_.size(); ++h) {
      const Index o = surface_.opposite[h], n = next_halfedge(h);
      const bool has_length = surface_.point(h) != surface_.point(n);
      const bool is_simple = o != no_index && (!has_length || (!has_twin[vertex(h)] && !has_twin[vertex(n)]));
      if (is_simple && h < o)
        glue_pair(h, o);
      else if (!is_simple && has_length && is_used(h / 3))
        others.push_back(h);
    }
    glue_places(others);
  }

  /// Per vertex, whether (nearly always: only if) another one is at the same place.
  std::vector<bool> find_twins() const
  {
    std::vector<std::pair<std::uint64_t, Index>> hashes(surface_.points.size());
    for (Index v = 0; v < hashes.size(); ++v)
      hashes[v] = {hash_of(surface_.points[v]), v};
    std::sort(hashes.begin(), hashes.end());
    std::vector<bool> has_twin(hashes.size(), false);
    for (std::size_t i = 1; i < hashes.size(); ++i)
      if (hashes[i].first == hashes[i - 1].first)
        has_twin[hashes[i].second] = has_twin[hashes[i - 1].second] = true;
    return has_twin;
  }

  void glue_pair(Index h, Index o)
  {
    if (is_used(h / 3) && page_[h / 3] == page_[o / 3] && uv_[h] == uv_[next_halfedge(o)] &&
        uv_[next_halfedge(h)] == uv_[o]) {
      glued_[h] = o;
      glued_[o] = h;
      triangles_.unite(h / 3, o / 3);
      corners_.unite(h, next_halfedge(o));
      corners_.unite(next_halfedge(h), o);
    } else if (is_used(h / 3) || is_used(o / 3)) {
      seam_length_ += length(h);
    }
  }

  /// An edge of one triangle, with its ends in the order of their places in space.
  struct Edge
  {
    Point_3 a, b; ///< in space
    Point_2 p, q; ///< in the plane
    Index page, halfedge, from, to;

    auto place() const { return std::tie(a, b); }
    auto image() const { return std::tie(p, q, page); }
    bool operator<(const Edge& e) const
    {
      return place() != e.place()   ? place() < e.place()
             : image() != e.image() ? image() < e.image()
                                    : halfedge < e.halfedge;
    }
  };

  Edge edge(Index h) const
  {
    const Index n = next_halfedge(h);
    const bool is_forward = surface_.point(h) < surface_.point(n);
    const Index from = is_forward ? h : n, to = is_forward ? n : h;
    return {surface_.point(from), surface_.point(to), uv_[from], uv_[to], page_[h / 3], h, from, to};
  }

  /// The same for equal points. Zero has two signs that compare equal.
  static std::uint64_t hash_of(const Point_3& p)
  {
    std::uint64_t sum = 0;
    for (int i = 0; i < 3; ++i)
      sum = (sum ^ std::bit_cast<std::uint64_t>(p[i] + 0.0)) * 0x9e3779b97f4a7c15u, sum ^= sum >> 29;
    return sum;
  }

  /// Edges at the same place in space are one edge, on which all triangles with equal coordinates are glued,
  /// whichever way they run.
  void glue_places(const std::vector<Index>& halfedges)
  {
    std::vector<std::pair<std::uint64_t, Index>> hashes;
    hashes.reserve(halfedges.size());
    for (const Index h : halfedges)
      hashes.emplace_back(hash_of(surface_.point(h)) + hash_of(surface_.point(next_halfedge(h))), h);
    std::sort(hashes.begin(), hashes.end());
    std::vector<Edge> edges;
    for (std::size_t i = 0, end = 0; i < hashes.size(); i = end) {
      edges.clear();
      for (; end < hashes.size() && hashes[end].first == hashes[i].first; ++end)
        if (end > i || (end + 1 < hashes.size() && hashes[end + 1].first == hashes[i].first))
          edges.push_back(edge(hashes[end].second));
      std::sort(edges.begin(), edges.end());
      for (std::size_t first = 0; first < edges.size();)
        first = glue_place(edges, first);
    }
  }

  /// Glues the edges at the same place as the first one. Returns the next at another place.
  std::size_t glue_place(const std::vector<Edge>& edges, std::size_t first)
  {
    std::size_t end = first, images = 0;
    for (; end < edges.size() && edges[end].place() == edges[first].place(); ++images) {
      const std::size_t side = end;
      while (end < edges.size() && edges[end].place() == edges[side].place() &&
             edges[end].image() == edges[side].image())
        ++end;
      glue_image(std::span(edges).subspan(side, end - side));
    }
    if (images > 1)
      seam_length_ += length(edges[first].halfedge);
    return end;
  }

  /// Glues edges that are equal in space and in the plane.
  void glue_image(std::span<const Edge> edges)
  {
    for (std::size_t j = 1; j < edges.size(); ++j) {
      triangles_.unite(edges[0].halfedge / 3, edges[j].halfedge / 3);
      corners_.unite(edges[0].from, edges[j].from);
      corners_.unite(edges[0].to, edges[j].to);
    }
    if (edges.size() == 2) {
      glued_[edges[0].halfedge] = edges[1].halfedge;
      glued_[edges[1].halfedge] = edges[0].halfedge;
    }
    for (std::size_t j = 0; edges.size() > 2 && j < edges.size(); ++j) {
      is_crowded_[edges[j].halfedge] = true;
      if (j > 0) // the first of a crowd stands for the edge when edges are counted
        crowd_followers_.push_back(edges[j].halfedge);
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
    Union_find border(uv_.size());
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
      counts.border_components -= border.unite(ends[0], ends[1]);
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
  Union_find triangles_, corners_;
  std::vector<Index> chart_;
  std::vector<Chart_counts> counts_;
  double seam_length_ = 0;
};

} // namespace Atlas::internal

#endif
