// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_CUTTING_CHART_CUT_FINDER_H
#define ATLAS_PACKING_INTERNAL_CUTTING_CHART_CUT_FINDER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/packing/internal/cutting/Room_estimate.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// A way to cut a chart in pieces that need less room on a page.
struct Chart_cut
{
  std::vector<Index> parts;  ///< per triangle: its piece
  Index number_of_parts = 0; ///< 0: there is no such cut
  double cost = 0;           ///< of the new seams
  double length = 0;         ///< of the new seams, in space
  double gain = 0;           ///< room that is saved
  double rate = 0;           ///< what the cut is chosen by: gain over cost
};

/// \brief Finds the cut of a chart along edges that saves most room for its cost.
///
/// A cut is a shortest path from one place of the outer border to another, where edges cost what they are
/// said to, and borders of holes nothing. Cuts begin where the border is farthest inside of the convex hull,
/// and at some places all around. Their worth is estimated for straight chords first, and for the pieces
/// themselves then, for the best few. O(sources x n log n) for n triangles.
class Chart_cut_finder
{
public:
  /// Places of the border at which cuts may end, and places at which they begin.
  static constexpr std::size_t most_samples = 96, most_sources = 24;
  /// Cuts of which the pieces are looked at.
  static constexpr std::size_t most_candidates = 8, most_per_source = 2;
  /// Each cut costs at least this share of the page's side: more charts are worth less to the user too.
  static constexpr double least_cost = 0.02;

  /// \param chart  with coordinates; outlives this object
  /// \param cost   per halfedge, the same on both sides: of a seam there; infinite where none may be
  /// \param most_cost  of a cut
  Chart_cut_finder(const Chart& chart, std::span<const double> cost, const Room_estimate& room,
                   double most_cost)
      : chart_(chart), cost_(cost), room_(room), most_cost_(most_cost),
        opposite_(opposite_halfedges(chart.triangles))
  {
    find_outer_border();
    link_vertices();
    take_samples();
  }

  Chart_cut best(const Execution& execution) const
  {
    Chart_cut result;
    const std::vector<std::size_t> sources = choose_sources();
    std::vector<std::vector<Candidate>> found(sources.size());
    execution.for_each(sources.size(), [&](std::size_t i) { found[i] = candidates_from(sources[i]); });
    std::vector<Candidate> candidates;
    for (auto& list : found)
      candidates.insert(candidates.end(), list.begin(), list.end());
    keep_best(candidates, most_candidates);
    std::vector<Vec2> border;
    for (const Index v : outer_)
      border.push_back(uv(v));
    const double before = room_(std::move(border));
    for (const Candidate& candidate : candidates)
      if (Chart_cut cut = cut_along(candidate.path, before); cut.rate > result.rate)
        result = std::move(cut);
    return result;
  }

private:
  struct Candidate
  {
    std::vector<Index> path; ///< halfedges
    double rate = 0;
  };

  struct Link
  {
    Index to, halfedge;
    double cost;
  };

  Vec2 uv(Index v) const { return {chart_.uv[v].x(), chart_.uv[v].y()}; }

  /// The border loop with the largest area in the plane.
  void find_outer_border()
  {
    const std::size_t n = chart_.number_of_vertices();
    on_outer_.assign(n, false);
    double most = -1;
    for (const std::vector<Index>& loop : border_loops(opposite_)) {
      std::vector<Index> vertices;
      double twice_area = 0;
      for (const Index h : loop)
        vertices.push_back(tail(h));
      for (std::size_t i = 0; i < vertices.size(); ++i)
        twice_area += cross(uv(vertices[i]), uv(vertices[(i + 1) % vertices.size()]));
      if (std::abs(twice_area) > most) {
        most = std::abs(twice_area);
        outer_ = std::move(vertices);
      }
    }
    for (const Index v : outer_)
      on_outer_[v] = true;
  }

  Index tail(Index h) const { return chart_.triangles[h / 3][h % 3]; }

  /// The graph of the edges along which cuts may run.
  void link_vertices()
  {
    first_.assign(chart_.number_of_vertices() + 1, 0);
    std::vector<std::pair<Index, double>> edges;
    for (Index h = 0; h < opposite_.size(); ++h) {
      const bool is_border = opposite_[h] == no_index;
      const Index a = tail(h), b = tail(next_halfedge(h));
      if ((!is_border && opposite_[h] < h) || (is_border && (on_outer_[a] || on_outer_[b])))
        continue;
      if (const double c = is_border ? 0 : cost_[h]; std::isfinite(c)) {
        edges.emplace_back(h, c);
        ++first_[a + 1];
        ++first_[b + 1];
      }
    }
    for (std::size_t v = 1; v < first_.size(); ++v)
      first_[v] += first_[v - 1];
    links_.resize(first_.back());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (const auto& edge : edges) {
      const Index a = tail(edge.first), b = tail(next_halfedge(edge.first));
      links_[next[a]++] = {b, edge.first, edge.second};
      links_[next[b]++] = {a, edge.first, edge.second};
    }
  }

  /// Of each stretch of the outer border, the vertex that lies deepest inside of the hull.
  void take_samples()
  {
    const std::size_t n = outer_.size();
    std::vector<Vec2> points;
    for (const Index v : outer_)
      points.push_back(uv(v));
    const std::vector<Vec2> hull = convex_hull(points);
    double perimeter = 0;
    for (std::size_t i = 0; i < n; ++i)
      perimeter += length(points[(i + 1) % n] - points[i]);
    const double stretch = n > most_samples ? perimeter / most_samples : 0;
    double passed = 0, end = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double depth = depth_in(hull, points[i]);
      if (samples_.empty() || passed >= end) {
        samples_.push_back({outer_[i], points[i], depth});
        end = std::max(end + stretch, passed);
      } else if (depth > samples_.back().depth) {
        samples_.back() = {outer_[i], points[i], depth};
      }
      passed += length(points[(i + 1) % n] - points[i]);
    }
  }

  static double depth_in(const std::vector<Vec2>& hull, Vec2 p)
  {
    double depth = HUGE_VAL;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
      if (const double l = length(edge); l > 0)
        depth = std::min(depth, cross(edge, p - hull[i]) / l);
    }
    return std::isfinite(depth) ? depth : 0;
  }

  /// The samples that lie deeper than their neighbours, deepest first, and some all around.
  std::vector<std::size_t> choose_sources() const
  {
    const std::size_t n = samples_.size();
    std::vector<std::size_t> sources;
    for (std::size_t i = 0; i < n; ++i)
      if (samples_[i].depth > 0 && samples_[i].depth >= samples_[(i + 1) % n].depth &&
          samples_[i].depth >= samples_[(i + n - 1) % n].depth)
        sources.push_back(i);
    std::stable_sort(sources.begin(), sources.end(),
                     [&](std::size_t i, std::size_t j) { return samples_[i].depth > samples_[j].depth; });
    sources.resize(std::min(sources.size(), 2 * most_sources / 3));
    const std::size_t others = std::min(n, most_sources - sources.size());
    for (std::size_t k = 0; k < others; ++k)
      sources.push_back(k * n / others);
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    return sources;
  }

  /// Shortest paths from a vertex that do not pass the outer border. \see Dijkstra 1959
  void find_paths(Index source, std::vector<double>& distance, std::vector<Index>& last) const
  {
    distance.assign(chart_.number_of_vertices(), HUGE_VAL);
    last.assign(chart_.number_of_vertices(), no_index);
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance[source] = 0;
    queue.emplace(0, source);
    while (!queue.empty()) {
      const auto [d, v] = queue.top();
      queue.pop();
      if (d > distance[v] || (on_outer_[v] && v != source))
        continue;
      for (Index i = first_[v]; i < first_[v + 1]; ++i)
        if (const Link& link = links_[i]; d + link.cost < distance[link.to] && d + link.cost <= most_cost_) {
          distance[link.to] = d + link.cost;
          last[link.to] = i;
          queue.emplace(distance[link.to], link.to);
        }
    }
  }

  std::vector<Candidate> candidates_from(std::size_t source) const
  {
    std::vector<double> distance;
    std::vector<Index> last;
    find_paths(samples_[source].vertex, distance, last);
    std::vector<std::pair<double, std::size_t>> ends;
    const double before = room_(points_between(0, samples_.size() - 1));
    for (std::size_t j = 0; j < samples_.size(); ++j) {
      const double cost = distance[samples_[j].vertex];
      if (j == source || !(cost > 0 && std::isfinite(cost)))
        continue;
      const double after = room_(points_between(source, j)) + room_(points_between(j, source));
      if (after < before)
        ends.emplace_back((before - after) / (cost + least_cost * room_.side), j);
    }
    std::sort(ends.begin(), ends.end(), std::greater<>());
    std::vector<Candidate> result;
    for (std::size_t k = 0; k < ends.size() && k < most_per_source; ++k) {
      Candidate candidate{{}, ends[k].first};
      for (Index v = samples_[ends[k].second].vertex; last[v] != no_index;) {
        const Index h = links_[last[v]].halfedge;
        candidate.path.push_back(h);
        v = tail(h) == v ? tail(next_halfedge(h)) : tail(h);
      }
      result.push_back(std::move(candidate));
    }
    return result;
  }

  /// The samples from one to another, both included, along the border.
  std::vector<Vec2> points_between(std::size_t i, std::size_t j) const
  {
    std::vector<Vec2> points{samples_[i].point};
    while (i != j) {
      i = (i + 1) % samples_.size();
      points.push_back(samples_[i].point);
    }
    return points;
  }

  static void keep_best(std::vector<Candidate>& candidates, std::size_t number)
  {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.rate > b.rate; });
    candidates.resize(std::min(candidates.size(), number));
  }

  /// Per piece, the points of its border.
  std::vector<std::vector<Vec2>> borders_of(const Components& pieces) const
  {
    std::vector<std::vector<Vec2>> borders(pieces.count);
    for (Index h = 0; h < opposite_.size(); ++h)
      if (const Index o = opposite_[h];
          o == no_index || pieces.of_triangle[o / 3] != pieces.of_triangle[h / 3])
        for (const Index v : {tail(h), tail(next_halfedge(h))})
          borders[pieces.of_triangle[h / 3]].push_back(uv(v));
    return borders;
  }

  /// What a cut along a path does: the pieces are those that the path parts.
  Chart_cut cut_along(const std::vector<Index>& path, double before) const
  {
    std::vector<bool> is_cut(opposite_.size(), false);
    for (const Index h : path) {
      is_cut[h] = true;
      if (opposite_[h] != no_index)
        is_cut[opposite_[h]] = true;
    }
    Components pieces = connected_components(
        opposite_, [](Index) { return true; }, [&](Index h) { return !is_cut[h]; });
    Chart_cut cut;
    if (pieces.count < 2)
      return cut;
    cut.gain = before;
    for (std::vector<Vec2>& border : borders_of(pieces))
      cut.gain -= room_(std::move(border));
    for (Index h = 0; h < opposite_.size(); ++h)
      if (const Index o = opposite_[h];
          o != no_index && o < h && pieces.of_triangle[h / 3] != pieces.of_triangle[o / 3]) {
        cut.cost += cost_[h];
        cut.length +=
            std::sqrt(CGAL::squared_distance(chart_.points[tail(h)], chart_.points[tail(next_halfedge(h))]));
      }
    cut.rate = cut.gain / (cut.cost + least_cost * room_.side * (pieces.count - 1));
    cut.parts = std::move(pieces.of_triangle);
    cut.number_of_parts = pieces.count;
    return cut;
  }

  struct Sample
  {
    Index vertex;
    Vec2 point;
    double depth; ///< how far inside of the convex hull
  };

  const Chart& chart_;
  std::span<const double> cost_;
  Room_estimate room_;
  double most_cost_;
  std::vector<Index> opposite_;
  std::vector<Index> outer_; ///< vertices of the outer border in their order
  std::vector<bool> on_outer_;
  std::vector<Index> first_; ///< per vertex: its first link
  std::vector<Link> links_;
  std::vector<Sample> samples_;
};

} // namespace Atlas::internal

#endif
