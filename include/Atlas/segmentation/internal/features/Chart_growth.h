// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_CHART_GROWTH_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_CHART_GROWTH_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/Feature_segmentation.h>
#include <Atlas/segmentation/internal/features/Chart_boundaries.h>
#include <Atlas/segmentation/internal/features/Feature_distance.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Algorithm 2 of the paper: charts grow from the local maxima of a function, highest places first.
class Chart_growth
{
public:
  /// \param largest  per triangle: the largest distance in its component
  Chart_growth(const Surface& surface, const Submesh& submesh, const std::vector<double>& distance,
               const std::vector<double>& largest, const Growth_options& options)
      : surface_(surface), submesh_(submesh), distance_(distance), largest_(largest), options_(options),
        boundaries_(surface, submesh)
  {}

  Chart_boundaries run()
  {
    for (const Index t : local_maxima())
      if (boundaries_.chart(t) == no_index)
        start_chart(t);
    grow();
    // Values that are no numbers have no maximum.
    for (Index t = 0; t < distance_.size(); ++t)
      if (boundaries_.chart(t) == no_index) {
        start_chart(t);
        grow();
      }
    return std::move(boundaries_);
  }

private:
  struct Entry
  {
    double distance;
    Index order;
    Index halfedge;
    /// Highest first; on level ground those that came first, so that charts grow evenly.
    bool operator<(const Entry& other) const
    {
      return distance != other.distance ? distance < other.distance : order > other.order;
    }
  };

  /// The first triangle of each local maximum; level ground is one place.
  std::vector<Index> local_maxima() const
  {
    Union_find plateaus(distance_.size());
    for (Index h = 0; h < submesh_.opposite.size(); ++h)
      if (const Index o = submesh_.opposite[h]; o != no_index && distance_[h / 3] == distance_[o / 3])
        plateaus.unite(h / 3, o / 3);
    std::vector<std::uint8_t> is_maximum(distance_.size(), 1);
    for (Index h = 0; h < submesh_.opposite.size(); ++h)
      if (const Index o = submesh_.opposite[h]; o != no_index && distance_[o / 3] > distance_[h / 3])
        is_maximum[plateaus.find(h / 3)] = 0;
    std::vector<Index> result;
    for (Index t = 0; t < distance_.size(); ++t)
      if (is_maximum[t] && plateaus.find(t) == t)
        result.push_back(t);
    return result;
  }

  void start_chart(Index t)
  {
    const Index c = boundaries_.new_chart();
    summit_.push_back(distance_[t]);
    boundaries_.put(t, c);
    push_with_fixed_neighbors(t);
  }

  void push(Index t)
  {
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (submesh_.opposite[h] != no_index && boundaries_.is_boundary(h))
        queue_.push({distance_[t], order_++, h});
  }

  /// Across diagonals, and edges that must not be seams, the chart goes on at once. (Not flood_fill(): edges
  /// are pushed and opened on the way, in an order that decides ties.)
  void push_with_fixed_neighbors(Index start)
  {
    stack_.assign(1, start);
    while (!stack_.empty()) {
      const Index t = stack_.back();
      stack_.pop_back();
      push(t);
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        const Index o = submesh_.opposite[h];
        if (o != no_index && must_not_be_seam(surface_, h) && boundaries_.chart(o / 3) == no_index) {
          boundaries_.put(o / 3, boundaries_.chart(t));
          boundaries_.open(h);
          stack_.push_back(o / 3);
        }
      }
    }
  }

  void grow()
  {
    while (!queue_.empty()) {
      const Entry top = queue_.top();
      queue_.pop();
      const Index h = top.halfedge, o = submesh_.opposite[h];
      if (!boundaries_.is_boundary(h))
        continue;
      const Index here = boundaries_.chart(h / 3), there = boundaries_.chart(o / 3);
      if (there == no_index) {
        boundaries_.put(o / 3, here);
        boundaries_.open(h);
        push_with_fixed_neighbors(o / 3);
      } else if (here != there && should_merge(here, there, h / 3)) {
        const double summit = std::max(summit_[here], summit_[there]);
        summit_[boundaries_.unite(here, there)] = summit;
        boundaries_.open(h);
      }
    }
  }

  /// Whether charts that meet at a triangle merge: both rise little above it, or one of them hardly at all.
  bool should_merge(Index c, Index d, Index t) const
  {
    const auto [low, high] = std::minmax(summit_[c], summit_[d]);
    return high - distance_[t] < options_.merge_depth * largest_[t] ||
           low - distance_[t] < options_.noise_depth * largest_[t];
  }

  const Surface& surface_;
  const Submesh& submesh_;
  const std::vector<double>& distance_;
  const std::vector<double>& largest_;
  Growth_options options_;
  Chart_boundaries boundaries_;
  std::vector<double> summit_; ///< per chart: max_dist of the paper
  std::priority_queue<Entry> queue_;
  std::vector<Index> stack_;
  Index order_ = 0;
};

/// Per triangle, the largest value in its connected component.
inline std::vector<double> largest_of_component(const Submesh& submesh, const std::vector<double>& distance)
{
  std::vector<Index> component;
  std::vector<double> largest(number_components(submesh, component), 0), result(distance.size());
  const auto component_of = [&](Index t) { return component[submesh.vertex[3 * t]]; };
  for (Index t = 0; t < distance.size(); ++t)
    largest[component_of(t)] = std::max(largest[component_of(t)], distance[t]);
  for (Index t = 0; t < distance.size(); ++t)
    result[t] = largest[component_of(t)];
  return result;
}

} // namespace Atlas::internal

#endif
