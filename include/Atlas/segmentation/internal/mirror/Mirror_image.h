// SPDX-License-Identifier: MIT
// Before the guard: where there is no library, that header includes its definitions, and they need all of
// this one.
#include <Atlas/segmentation/Merged_segmentation.h>

#ifndef ATLAS_SEGMENTATION_INTERNAL_MIRROR_MIRROR_IMAGE_H
#define ATLAS_SEGMENTATION_INTERNAL_MIRROR_MIRROR_IMAGE_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/mirror/Half_surface.h>
#include <Atlas/segmentation/internal/mirror/Triangle_tree.h>
#include <Atlas/segmentation/internal/surface/part_of_surface.h>
#include <Atlas/segmentation/smooth_borders.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Carries the charts of one half of a surface over to the other half.
///
/// Each polygon of the other half takes the chart that is at the image of its centre. So the charts of a
/// symmetric mesh are exact images; on other meshes borders are smoothed within a ring of triangles, and what
/// has come apart is given to its neighbours. Cuts inside charts become shortest paths between the vertices
/// nearest to the images of their ends. O(n log n).
class Mirror_image
{
public:
  /// \param of_half   charts of the half
  /// \param is_glued  per halfedge of the half: whether its chart goes on beyond the plane there
  Mirror_image(const Surface& surface, const Mirror_plane& plane, const Half_surface& half,
               const Segmentation& of_half, const std::vector<std::uint8_t>& is_glued,
               const Execution& execution)
      : surface_(surface), plane_(plane), half_(half), of_half_(of_half), is_glued_(is_glued),
        execution_(execution), number_of_charts_(of_half.number_of_charts)
  {}

  Segmentation operator()()
  {
    result_.chart.assign(surface_.number_of_triangles(), no_index);
    result_.cut.assign(surface_.opposite.size(), 0);
    result_.number_of_charts = 2 * number_of_charts_;
    take_half();
    take_image();
    join_fragments();
    if (!is_one_to_one_ && !execution_.is_cancelled())
      smooth();
    cut_at_plane();
    cut_image();
    return std::move(result_);
  }

private:
  /// If so many polygons have images of their own, the mesh is taken for symmetric.
  static constexpr double nearly_all = 0.95;

  void take_half()
  {
    std::vector<std::uint8_t> is_across(number_of_charts_, 0);
    for (Index h = 0; h < is_glued_.size(); ++h)
      if (is_glued_[h])
        is_across[of_half_.chart[h / 3]] = 1;
    for (Index c = 0; c < number_of_charts_; ++c)
      image_.push_back(is_across[c] ? c : number_of_charts_ + c);
    for (Index t = 0; t < half_.global.size(); ++t)
      result_.chart[half_.global[t]] = of_half_.chart[t];
    for (Index h = 0; h < of_half_.cut.size(); ++h)
      if (half_.part.opposite[h] != no_index)
        result_.cut[half_.global_halfedge(h)] = of_half_.cut[h];
  }

  void take_image()
  {
    const std::vector<Point_3> centre = centres_of_faces(surface_);
    const Triangle_tree tree(surface_, half_.global);
    std::vector<Index> faces, first(surface_.number_of_faces, no_index);
    for (Index t = 0; t < surface_.number_of_triangles(); ++t)
      if (!half_.is_in[t] && first[surface_.face[t]] == no_index) {
        first[surface_.face[t]] = t;
        faces.push_back(surface_.face[t]);
      }
    std::vector<Index> hit(surface_.number_of_faces, no_index); // a triangle of the half
    execution_.for_each(faces.size(), [&](std::size_t i) {
      hit[faces[i]] = tree.nearest(plane_.image(centre[faces[i]])).triangle;
    });
    std::vector<std::uint8_t> is_hit(surface_.number_of_faces, 0);
    std::size_t hits = 0;
    for (const Index f : faces)
      if (hit[f] != no_index)
        hits += !std::exchange(is_hit[surface_.face[hit[f]]], 1);
    is_one_to_one_ = static_cast<double>(hits) >= nearly_all * static_cast<double>(faces.size());
    for (Index t = 0; t < surface_.number_of_triangles(); ++t)
      if (!half_.is_in[t]) {
        const Index h = hit[surface_.face[t]]; // none once cancelled
        result_.chart[t] = h == no_index ? 0 : image_[result_.chart[h]];
      }
  }

  /// Of the parts of each chart that hang together the one with most triangles stays; the others join the
  /// neighbour with which they share most border, if that is a different chart.
  void join_fragments()
  {
    const auto is_same = [&](Index h) {
      return may_cross(surface_, h) && result_.chart[h / 3] == result_.chart[surface_.opposite[h] / 3];
    };
    const Components parts = connected_components(
        surface_.opposite, [](Index) { return true; }, is_same);
    std::vector<std::size_t> size(parts.count, 0);
    std::vector<std::uint8_t> is_movable(parts.count, 1);
    std::vector<Index> largest(result_.number_of_charts, no_index);
    for (Index t = 0; t < parts.of_triangle.size(); ++t) {
      ++size[parts.of_triangle[t]];
      is_movable[parts.of_triangle[t]] &= !half_.is_in[t];
    }
    for (Index t = 0; t < parts.of_triangle.size(); ++t)
      if (Index& l = largest[result_.chart[t]]; l == no_index || size[parts.of_triangle[t]] > size[l])
        l = parts.of_triangle[t];
    for (Index t = 0; t < parts.of_triangle.size(); ++t)
      if (const Index p = parts.of_triangle[t]; largest[result_.chart[t]] == p)
        is_movable[p] = 0;
    std::vector<std::map<Index, double>> shared(parts.count);
    for (Index h = 0; h < surface_.opposite.size(); ++h)
      if (const Index p = parts.of_triangle[h / 3]; is_movable[p] && may_cross(surface_, h))
        if (const Index o = surface_.opposite[h] / 3; !is_movable[parts.of_triangle[o]] && !half_.is_in[o])
          shared[p][result_.chart[o]] += edge_length(surface_, h);
    for (Index t = 0; t < parts.of_triangle.size(); ++t)
      if (const auto& s = shared[parts.of_triangle[t]]; !s.empty())
        result_.chart[t] = std::max_element(s.begin(), s.end(), [](const auto& a, const auto& b) {
                             return a.second < b.second;
                           })->first;
  }

  void smooth()
  {
    std::vector<Index> global;
    const Surface part = part_of_surface(
        surface_, [&](Index t) { return !half_.is_in[t]; }, global);
    Segmentation segmentation{{}, std::vector<std::uint8_t>(part.opposite.size(), 0), 2 * number_of_charts_};
    for (const Index t : global)
      segmentation.chart.push_back(result_.chart[t]);
    Smoothing_options options;
    options.rings = options.rounds = 1; // an image stays about where it is
    smooth_borders(part, segmentation, options, execution_);
    for (Index t = 0; t < global.size(); ++t)
      result_.chart[global[t]] = segmentation.chart[t];
  }

  /// Charts that go on beyond the plane are glued along one piece of it only.
  void cut_at_plane()
  {
    for (Index h = 0; h < is_glued_.size(); ++h)
      if (half_.is_at_plane(surface_, h) && !is_glued_[h]) {
        const Index g = half_.global_halfedge(h);
        result_.cut[g] = result_.cut[surface_.opposite[g]] = 1;
      }
  }

  // --- Cuts inside charts

  void cut_image()
  {
    std::vector<Index> cuts;
    for (Index h = 0; h < of_half_.cut.size(); ++h)
      if (const Index o = half_.part.opposite[h];
          o != no_index && h < o && of_half_.cut[h] && of_half_.chart[h / 3] == of_half_.chart[o / 3])
        cuts.push_back(h);
    if (cuts.empty() || execution_.is_cancelled())
      return;
    std::vector<Index> others;
    leaving_.resize(surface_.points.size());
    for (Index h = 0; h < surface_.opposite.size(); ++h)
      if (!half_.is_in[h / 3]) {
        leaving_[surface_.triangles[h / 3][h % 3]].push_back(h);
        leaving_[surface_.triangles[h / 3][next_halfedge(h) % 3]].push_back(h);
        if (h % 3 == 0)
          others.push_back(h / 3);
      }
    const Triangle_tree tree(surface_, std::move(others));
    for (const Index h : cuts) {
      const Index g = half_.global_halfedge(h);
      const Index a = image_of(tree, surface_.point(g)), b = image_of(tree, surface_.point(next_halfedge(g)));
      cut_path(a, b, image_[of_half_.chart[h / 3]]);
    }
  }

  /// The vertex of the other half that is nearest to the image of a point, about.
  Index image_of(const Triangle_tree& tree, const Point_3& p) const
  {
    const Point_3 q = plane_.image(p);
    const auto& triangle = surface_.triangles[tree.nearest(q).triangle];
    return *std::min_element(triangle.begin(), triangle.end(), [&](Index u, Index v) {
      return std::pair(CGAL::squared_distance(surface_.points[u], q), u) <
             std::pair(CGAL::squared_distance(surface_.points[v], q), v);
    });
  }

  /// Cuts a chart along the shortest path of edges between two vertices that are near each other.
  void cut_path(Index from, Index to, Index chart)
  {
    constexpr std::size_t most_vertices = 200;
    std::map<Index, std::pair<double, Index>> best{{from, {0, no_index}}}; // length, the last halfedge
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>>
        queue;
    queue.emplace(0, from);
    std::size_t visited = 0;
    while (!queue.empty() && queue.top().second != to && ++visited < most_vertices) {
      const auto [length, v] = queue.top();
      queue.pop();
      if (length > best[v].first)
        continue;
      for (const Index h : leaving_[v]) {
        const Index u = other_end(h, v);
        const double l = length + edge_length(surface_, h);
        if (must_not_be_seam(surface_, h))
          continue;
        const auto [it, is_new] = best.try_emplace(u, std::pair(l, h));
        if (!is_new && !(l < it->second.first))
          continue;
        it->second = {l, h};
        queue.emplace(l, u);
      }
    }
    if (best.count(to) == 0)
      return;
    for (Index v = to; v != from;) {
      const Index h = best[v].second, o = surface_.opposite[h];
      if (o != no_index && result_.chart[h / 3] == chart && result_.chart[o / 3] == chart)
        result_.cut[h] = result_.cut[o] = 1;
      v = other_end(h, v);
    }
  }

  Index other_end(Index h, Index v) const
  {
    const Index a = surface_.triangles[h / 3][h % 3];
    return a == v ? surface_.triangles[h / 3][next_halfedge(h) % 3] : a;
  }

  const Surface& surface_;
  const Mirror_plane& plane_;
  const Half_surface& half_;
  const Segmentation& of_half_;
  const std::vector<std::uint8_t>& is_glued_;
  const Execution& execution_;
  Index number_of_charts_;                  ///< of the half
  std::vector<Index> image_;                ///< per chart of the half: its image, perhaps the chart itself
  bool is_one_to_one_ = false;              ///< whether the mesh is symmetric
  std::vector<std::vector<Index>> leaving_; ///< per vertex: halfedges of the other half next to it
  Segmentation result_;
};

} // namespace Atlas::internal

#endif
