// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_DISCS_DISC_CUTTER_H
#define ATLAS_SEGMENTATION_INTERNAL_DISCS_DISC_CUTTER_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The angle between normals from which on a cut is cheapest: that of a box.
inline constexpr double sharp_angle_of_cuts = std::numbers::pi / 2;
/// How much cheaper a cut is there than in flat land.
inline constexpr double sharp_discount_of_cuts = 0.75;

/// What cutting along an edge costs: its length times the user's factor, less where it is sharp, much more
/// where there should be no seam.
inline double cut_cost(const Surface& surface, Index h)
{
  const double angle =
      angle_between(unit_normal(surface, h / 3), unit_normal(surface, surface.opposite[h] / 3));
  const double sharp = std::min(1., angle / sharp_angle_of_cuts);
  return edge_length(surface, h) * wanted_cost(surface, h) * (1 - sharp_discount_of_cuts * sharp) *
         (is_unwanted_seam(surface, h) ? penalty_of_unwanted_seams : 1);
}

/// \brief Opens one connected submesh until it is a disc, along short cuts.
///
/// Tree and cotree (D. Eppstein, Dynamic generators of topologically embedded graphs, SODA 2003; J. Erickson,
/// K. Whittlesey, Greedy optimal homotopy and homology generators, SODA 2005): shortest paths grow from the
/// whole border over the edges; a spanning tree of the faces crosses the edges that would make the longest
/// cuts; each edge in neither is the middle of a shortest cut, 2 genus + border loops - 1 in all. Half of
/// them is cut, and the rest sought anew from the border that has grown, so that later cuts join earlier ones
/// on the way. O(n log n) a round, and the number of rounds is the logarithm of the number of cuts.
class Disc_cutter
{
public:
  Disc_cutter(const Surface& surface, Submesh& submesh) : surface_(surface), submesh_(submesh) {}

  /// Unglues edges of the submesh; every one is told to `cut` as a halfedge of the surface.
  template <typename Cut>
  void run(Cut cut)
  {
    const std::size_t loops = submesh_.number_of_border_loops();
    const long long euler = submesh_.euler();
    if (loops == 1 && euler == 1 && !is_border_one_slit())
      return;
    find_costs();
    if (loops == 0)
      chosen_ = euler == 2 ? longest_path() : shortest_loop();
    else
      chosen_.clear();
    for (unglue(cut);; unglue(cut)) {
      grow_paths_from_border();
      const std::vector<Index> generators = find_generators();
      chosen_.clear();
      if (generators.empty())
        break;
      for (std::size_t i = 0; i < (generators.size() + 1) / 2; ++i) {
        chosen_.push_back(generators[i]);
        append_path(submesh_.vertex[generators[i]]);
        append_path(submesh_.head(generators[i]));
      }
    }
    if (is_border_one_slit()) {
      append_path(farthest_vertex());
      unglue(cut);
    }
  }

private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  bool is_passable(Index h) const { return submesh_.opposite[h] != no_index && !is_diagonal_[h]; }

  /// A sphere with a slit along one edge is a disc, but both sides of the slit have the same two vertices.
  bool is_border_one_slit() const
  {
    return std::count(submesh_.opposite.begin(), submesh_.opposite.end(), no_index) == 2;
  }

  void find_costs()
  {
    cost_.assign(submesh_.opposite.size(), 0);
    is_diagonal_.assign(submesh_.opposite.size(), 0);
    for (Index h = 0; h < submesh_.opposite.size(); ++h) {
      const Index o = submesh_.opposite[h];
      if (o == no_index || o < h)
        continue;
      cost_[h] = cost_[o] = cut_cost(surface_, submesh_.global(h));
      is_diagonal_[h] = is_diagonal_[o] = surface_.is_diagonal(submesh_.global(h));
    }
  }

  /// Dijkstra's shortest paths over the glued edges from the given vertices.
  void grow_paths(const std::vector<Index>& sources)
  {
    using Entry = std::pair<double, Index>;
    distance_.assign(submesh_.number_of_vertices(), infinity);
    arrival_.assign(submesh_.number_of_vertices(), no_index);
    std::vector<std::uint8_t> done(submesh_.number_of_vertices(), 0);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Index v : sources) {
      distance_[v] = 0;
      queue.emplace(0, v);
    }
    while (!queue.empty()) {
      const Index v = queue.top().second;
      queue.pop();
      if (done[v])
        continue;
      done[v] = 1;
      for (Index k = submesh_.first[v]; k < submesh_.first[v + 1]; ++k) {
        const Index h = submesh_.outgoing[k], w = submesh_.head(h);
        const double d = distance_[v] + cost_[h];
        // The second condition is for coordinates near the end of the range, where lengths overflow.
        const bool is_better = d < distance_[w] || (arrival_[w] == no_index && distance_[w] == infinity);
        if (!is_passable(h) || done[w] || !is_better)
          continue;
        distance_[w] = d;
        arrival_[w] = h;
        queue.emplace(d, w);
      }
    }
  }

  void grow_paths_from_border()
  {
    std::vector<Index> sources;
    for (Index v = 0; v < submesh_.number_of_vertices(); ++v)
      if (submesh_.is_on_border[v])
        sources.push_back(v);
    grow_paths(sources);
  }

  /// The edges neither in the forest of paths nor crossed by the tree of faces, those that make the shortest
  /// cuts first.
  std::vector<Index> find_generators() const
  {
    std::vector<std::pair<double, Index>> edges;
    Union_find faces(submesh_.triangles.size());
    for (Index h = 0; h < submesh_.opposite.size(); ++h) {
      const Index o = submesh_.opposite[h];
      if (o == no_index || o < h)
        continue;
      if (is_diagonal_[h])
        faces.unite(h / 3, o / 3);
      else if (arrival_[submesh_.head(h)] != h && arrival_[submesh_.head(o)] != o)
        edges.emplace_back(-(distance_[submesh_.vertex[h]] + cost_[h] + distance_[submesh_.head(h)]), h);
    }
    std::sort(edges.begin(), edges.end());
    std::vector<Index> generators;
    for (const auto& [length, h] : edges)
      if (!faces.unite(h / 3, submesh_.opposite[h] / 3))
        generators.push_back(h);
    std::reverse(generators.begin(), generators.end());
    return generators;
  }

  void append_path(Index v)
  {
    while (arrival_[v] != no_index) {
      chosen_.push_back(arrival_[v]);
      v = submesh_.vertex[arrival_[v]];
    }
  }

  Index farthest_vertex() const
  {
    return static_cast<Index>(std::max_element(distance_.begin(), distance_.end()) - distance_.begin());
  }

  /// A sphere is opened between the ends of a diameter: they are the tips of what sticks out, where curvature
  /// gathers, and the user's chart stays one chart.
  std::vector<Index> longest_path()
  {
    grow_paths({0});
    const Index start = farthest_vertex();
    grow_paths({start});
    chosen_.clear();
    Index end = farthest_vertex();
    append_path(end);
    // Along a single edge nothing opens: both sides would have the same two vertices.
    for (Index k = submesh_.first[end]; k < submesh_.first[end + 1] && chosen_.size() < 2; ++k) {
      const Index h = submesh_.outgoing[k];
      if (is_passable(h) && submesh_.head(h) != start && submesh_.head(h) != end)
        chosen_.push_back(h);
    }
    return chosen_;
  }

  /// A closed surface with handles is opened along a shortest loop that does not separate it. The first loop
  /// is the best through some vertex, the second through a vertex of the first.
  std::vector<Index> shortest_loop()
  {
    Index base = 0;
    std::vector<Index> loop;
    for (int round = 0; round < 2; ++round) {
      grow_paths({base});
      const std::vector<Index> generators = find_generators();
      if (generators.empty())
        return {};
      const Index middle = generators.front();
      chosen_.clear();
      append_path(submesh_.vertex[middle]);
      std::vector<Index> other = std::exchange(chosen_, {});
      append_path(submesh_.head(middle));
      while (!other.empty() && !chosen_.empty() && other.back() == chosen_.back()) {
        other.pop_back(); // the way from the base to the loop
        chosen_.pop_back();
      }
      chosen_.insert(chosen_.end(), other.begin(), other.end());
      chosen_.push_back(middle);
      loop = chosen_;
      base = submesh_.vertex[middle];
    }
    return loop;
  }

  template <typename Cut>
  void unglue(Cut cut)
  {
    for (const Index h : chosen_) {
      const Index o = submesh_.opposite[h];
      if (o == no_index)
        continue; // paths run together
      cut(submesh_.global(h));
      submesh_.opposite[h] = submesh_.opposite[o] = no_index;
    }
    if (!chosen_.empty())
      submesh_.number_vertices();
  }

  const Surface& surface_;
  Submesh& submesh_;
  std::vector<double> cost_;
  std::vector<std::uint8_t> is_diagonal_;
  std::vector<double> distance_;
  std::vector<Index> arrival_; ///< per vertex: the halfedge by which the shortest path arrives
  std::vector<Index> chosen_;  ///< halfedges to cut
};

} // namespace Atlas::internal

#endif
