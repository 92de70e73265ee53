// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_EXPAND_CHARTS_H
#define ATLAS_SEGMENTATION_EXPAND_CHARTS_H

#include <Atlas/Surface.h>
#include <Atlas/segmentation/distance_to_features.h>
#include <Atlas/segmentation/internal/Chart_boundaries.h>
#include <Atlas/segmentation/internal/Piece.h>
#include <Atlas/segmentation/internal/whole_surface.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

namespace Atlas {

namespace internal {

/// \brief Algorithm 2 of the paper: charts grow from the local maxima of a function, highest places first.
class Chart_growth
{
public:
  /// \param epsilon  per triangle: charts that meet there merge if both rise less than that above it
  Chart_growth(const Surface& surface, const Piece& piece, const std::vector<double>& distance,
               const std::vector<double>& epsilon)
      : surface_(surface), piece_(piece), distance_(distance), epsilon_(epsilon), boundaries_(surface, piece)
  {}

  Chart_boundaries run()
  {
    for (Index t = 0; t < distance_.size(); ++t)
      if (is_local_maximum(t) && boundaries_.chart(t) == no_index)
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

  /// On plateaus the number decides; if there are several maxima then, their charts merge at once.
  bool is_local_maximum(Index t) const
  {
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (const Index o = piece_.opposite[h]; o != no_index) {
        const double d = distance_[o / 3];
        if (d > distance_[t] || (d == distance_[t] && o / 3 > t))
          return false;
      }
    return true;
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
      if (piece_.opposite[h] != no_index)
        queue_.push({distance_[t], order_++, h});
  }

  /// Across diagonals, and edges that must not be seams, the chart goes on at once.
  void push_with_fixed_neighbors(Index start)
  {
    stack_.assign(1, start);
    while (!stack_.empty()) {
      const Index t = stack_.back();
      stack_.pop_back();
      push(t);
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        const Index o = piece_.opposite[h];
        if (o != no_index && must_not_cut(surface_, h) && boundaries_.chart(o / 3) == no_index) {
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
      const Index h = top.halfedge, o = piece_.opposite[h];
      if (!boundaries_.is_boundary(h))
        continue;
      const Index here = boundaries_.chart(h / 3), there = boundaries_.chart(o / 3);
      if (there == no_index) {
        boundaries_.put(o / 3, here);
        boundaries_.open(h);
        push_with_fixed_neighbors(o / 3);
      } else if (here != there && is_shallow(here, h / 3) && is_shallow(there, h / 3)) {
        const double summit = std::max(summit_[here], summit_[there]);
        summit_[boundaries_.unite(here, there)] = summit;
        boundaries_.open(h);
      }
    }
  }

  bool is_shallow(Index c, Index t) const { return summit_[c] - distance_[t] < epsilon_[t]; }

  const Surface& surface_;
  const Piece& piece_;
  const std::vector<double>& distance_;
  const std::vector<double>& epsilon_;
  Chart_boundaries boundaries_;
  std::vector<double> summit_; ///< per chart: max_dist of the paper
  std::priority_queue<Entry> queue_;
  std::vector<Index> stack_;
  Index order_ = 0;
};

/// Per triangle, the given share of the largest value in its connected component.
inline std::vector<double> merge_depths(const Piece& piece, const std::vector<double>& distance, double share)
{
  std::vector<Index> component;
  std::vector<double> largest(number_components(piece, component), 0), result(distance.size());
  const auto component_of = [&](Index t) { return component[piece.vertex[3 * t]]; };
  for (Index t = 0; t < distance.size(); ++t)
    largest[component_of(t)] = std::max(largest[component_of(t)], distance[t]);
  for (Index t = 0; t < distance.size(); ++t)
    result[t] = share * largest[component_of(t)];
  return result;
}

} // namespace internal

/// \brief Grows charts from the local maxima of a function on the triangles until they cover the surface.
///
/// Algorithm 2 of the LSCM paper. The highest triangles grow first, so that charts meet in the valleys, the
/// features. Charts that meet less than `merge_depth` times the largest value (of the connected component)
/// below the tops of both merge. All edges are boundaries at first; those that a chart grows across are
/// removed, and so are loose ends, over and over: a chart that meets itself around a cylinder keeps a cut
/// along which it borders itself, and remains a disc. Charts are numbered by their first triangles. O(n log
/// n).
///
/// \param distance     per triangle, the same for all triangles of a face; see distance_to_features()
/// \param merge_depth  in [0, 1]; a quarter in the paper
inline Segmentation expand_charts(const Surface& surface, const std::vector<double>& distance,
                                  double merge_depth = 0.25)
{
  const internal::Piece piece = internal::whole_surface(surface);
  return internal::Chart_growth(surface, piece, distance,
                                internal::merge_depths(piece, distance, merge_depth))
      .run()
      .segmentation();
}

} // namespace Atlas

#endif
