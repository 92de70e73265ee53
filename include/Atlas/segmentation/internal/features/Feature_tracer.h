// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_FEATURE_TRACER_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_FEATURE_TRACER_H

#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Algorithm 1 of the paper: feature curves grown along the sharpest strings of edges.
class Feature_tracer
{
public:
  Feature_tracer(const Surface& surface, const Submesh& submesh, const std::vector<float>& sharpness,
                 float threshold, int max_string_length, int min_feature_length, int neighborhood_rings)
      : surface_(surface), submesh_(submesh), sharpness_(sharpness), threshold_(threshold),
        max_string_length_(max_string_length), min_feature_length_(min_feature_length),
        neighborhood_rings_(neighborhood_rings), is_feature_(submesh.opposite.size(), 0),
        is_blocked_(submesh.opposite.size(), 0), is_on_curve_(submesh.opposite.size(), 0)
  {
    list_sharpest_edges();
    bound_strings();
  }

  /// Returns the features, per halfedge.
  std::vector<std::uint8_t> run(double hard_angle)
  {
    std::vector<std::pair<float, Index>> starts;
    for (Index h = 0; h < sharpness_.size(); ++h)
      if (submesh_.opposite[h] != no_index && h < submesh_.opposite[h] &&
          sharpness_[h] >= threshold_ * rounding)
        starts.emplace_back(-sharpness_[h], h);
    std::sort(starts.begin(), starts.end());
    for (const auto& [s, h] : starts)
      if (!is_blocked_[h])
        expand_feature_curve(h);
    for (Index h = 0; h < sharpness_.size(); ++h)
      if (sharpness_[h] > hard_angle)
        is_feature_[h] = 1;
    return std::move(is_feature_);
  }

private:
  /// On models where many edges are equally sharp, the threshold is that very angle.
  static constexpr float rounding = 0.999f;
  /// A string goes on along one of so many sharpest edges of a vertex; bounds the search at vertices of high
  /// degree and leaves it complete at all others.
  static constexpr Index max_branches = 10;

  void list_sharpest_edges()
  {
    first_branch_.assign(submesh_.number_of_vertices() + 1, 0);
    branches_.clear();
    std::vector<Index> edges;
    for (Index v = 0; v < submesh_.number_of_vertices(); ++v) {
      edges.clear();
      for (Index k = submesh_.first[v]; k < submesh_.first[v + 1]; ++k)
        if (const Index h = submesh_.outgoing[k]; submesh_.opposite[h] != no_index && sharpness_[h] > 0)
          edges.push_back(h);
      const std::size_t count = std::min<std::size_t>(edges.size(), max_branches);
      std::partial_sort(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(count), edges.end(),
                        [&](Index a, Index b) {
                          return sharpness_[a] != sharpness_[b] ? sharpness_[a] > sharpness_[b] : a < b;
                        });
      branches_.insert(branches_.end(), edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(count));
      first_branch_[v + 1] = static_cast<Index>(branches_.size());
    }
  }

  /// Per number of edges and vertex, how sharp a string of so many edges from there can be at most. It lets
  /// the search leave most branches.
  void bound_strings()
  {
    bound_.assign(static_cast<std::size_t>(std::max(max_string_length_, 1)),
                  std::vector<float>(submesh_.number_of_vertices(), 0));
    for (std::size_t length = 1; length < bound_.size(); ++length)
      for (Index v = 0; v < submesh_.number_of_vertices(); ++v)
        for (Index k = first_branch_[v]; k < first_branch_[v + 1]; ++k) {
          const Index h = branches_[k];
          bound_[length][v] =
              std::max(bound_[length][v], sharpness_[h] + bound_[length - 1][submesh_.head(h)]);
        }
  }

  Vector_3 direction(Index h) const { return surface_.point(next_halfedge(h)) - surface_.point(h); }

  void block(Index h) { is_blocked_[h] = is_blocked_[submesh_.opposite[h]] = 1; }

  void mark_on_curve(Index h, std::uint8_t value)
  {
    is_on_curve_[h] = is_on_curve_[submesh_.opposite[h]] = value;
  }

  void expand_feature_curve(Index start)
  {
    std::vector<Index> curve{start};
    mark_on_curve(start, 1);
    for (const Index side : {start, submesh_.opposite[start]}) {
      float sharpness = 0;
      Index h = side;
      do {
        std::tie(sharpness, h) = sharpest_string(h);
        if (h == no_index || is_on_curve_[h])
          break; // a closed curve ends where it meets itself
        curve.push_back(h);
        mark_on_curve(h, 1);
      } while (sharpness >= static_cast<float>(max_string_length_) * threshold_ * rounding);
    }
    for (const Index h : curve)
      mark_on_curve(h, 0);
    if (static_cast<int>(curve.size()) <= min_feature_length_)
      return;
    for (const Index h : curve) {
      is_feature_[h] = is_feature_[submesh_.opposite[h]] = 1;
      block(h);
    }
    block_neighborhood(curve);
  }

  /// The sharpness of the sharpest string that starts with h, and its second halfedge.
  std::pair<float, Index> sharpest_string(Index h) const
  {
    std::pair<float, Index> best{-1, no_index};
    search(submesh_.head(h), max_string_length_ - 1, sharpness_[h], direction(h), no_index, best);
    return best;
  }

  /// Depth-first search of all ways on from vertex v; a branch is left when the sharpest edge of its vertex
  /// shows that it cannot win.
  void search(Index v, int left, float sum, const Vector_3& forward, Index second,
              std::pair<float, Index>& best) const
  {
    if (second != no_index && sum > best.first)
      best = {sum, second};
    if (left <= 0)
      return;
    for (Index k = first_branch_[v]; k < first_branch_[v + 1]; ++k) {
      const Index h = branches_[k];
      if (sum + sharpness_[h] + bound_[left - 1][submesh_.head(h)] <= best.first)
        continue;
      if (is_blocked_[h] || !(direction(h) * forward > 0))
        continue;
      search(submesh_.head(h), left - 1, sum + sharpness_[h], forward, second == no_index ? h : second, best);
    }
  }

  void block_neighborhood(const std::vector<Index>& curve)
  {
    std::vector<Index> front;
    for (const Index h : curve) {
      front.push_back(submesh_.vertex[h]);
      front.push_back(submesh_.head(h));
    }
    for (int ring = 0; ring < neighborhood_rings_; ++ring) {
      std::vector<Index> beyond;
      for (const Index v : front)
        for (Index k = submesh_.first[v]; k < submesh_.first[v + 1]; ++k) {
          const Index h = submesh_.outgoing[k];
          if (submesh_.opposite[h] == no_index || is_blocked_[h])
            continue;
          block(h);
          beyond.push_back(submesh_.head(h));
        }
      front.swap(beyond);
    }
  }

  const Surface& surface_;
  const Submesh& submesh_;
  const std::vector<float>& sharpness_;
  float threshold_;
  int max_string_length_, min_feature_length_, neighborhood_rings_;
  std::vector<std::vector<float>> bound_;
  std::vector<Index> first_branch_,
      branches_; ///< per vertex: its sharpest outgoing halfedges, sharpest first
  std::vector<std::uint8_t> is_feature_;
  std::vector<std::uint8_t> is_blocked_;  ///< a feature or near one
  std::vector<std::uint8_t> is_on_curve_; ///< on the present curve
};

} // namespace Atlas::internal

#endif
