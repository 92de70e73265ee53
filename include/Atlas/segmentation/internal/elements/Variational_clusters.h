// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_VARIATIONAL_CLUSTERS_H
#define ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_VARIATIONAL_CLUSTERS_H

#include <Atlas/core/Execution.h>
#include <Atlas/segmentation/internal/elements/Element_graph.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <vector>

namespace Atlas::internal {

/// The planes that stand for the clusters, and the clusters themselves.
class Variational_clusters
{
public:
  Variational_clusters(const Element_graph& graph, double compactness)
      : graph_(&graph), compactness_(compactness)
  {
    double length = 0, cost = 0;
    for (const Element_graph::Link& link : graph.links) {
      length += link.length;
      cost += link.cost;
    }
    mean_cost_ = length > 0 ? cost / length : 1;
  }

  std::size_t size() const { return seed_.size(); }
  const std::vector<Index>& clusters() const { return cluster_; }
  const std::vector<Index>& seeds() const { return seed_; }

  /// Adds a cluster that grows from `element`, standing for itself until the next fit.
  void add_seed(Index element)
  {
    seed_.push_back(element);
    normal_.push_back(unit(graph_->area_vector[element]));
    center_.push_back(graph_->centroid(element));
  }

  /// Takes the clusters of a coarser graph: element e is in coarse element `group[e]`.
  void assign(const std::vector<Index>& coarse, const std::vector<Index>& group)
  {
    cluster_.resize(group.size());
    for (Index e = 0; e < group.size(); ++e)
      cluster_[e] = coarse[group[e]];
  }

  /// Grows all clusters from their seeds, cheapest element first (Cohen-Steiner et al. 2004, section 3.3).
  /// O(n log n).
  void flood()
  {
    struct Entry
    {
      double cost;
      Index element, cluster;
      double reluctance; ///< part of the cost: that of the way there
      bool operator<(const Entry& o) const
      {
        return std::tie(cost, element, cluster) > std::tie(o.cost, o.element, o.cluster);
      }
    };
    set_radius();
    cluster_.assign(graph_->size(), no_index);
    std::vector<double> best(graph_->size(), std::numeric_limits<double>::infinity());
    std::priority_queue<Entry> queue;
    for (Index c = 0; c < size(); ++c)
      queue.push({-1, seed_[c], c, 0}); // before everything else, so that no cluster loses its seed
    while (!queue.empty()) {
      const auto [cost_now, e, c, reluctance_now] = queue.top();
      queue.pop();
      if (cluster_[e] != no_index)
        continue;
      cluster_[e] = c;
      for (std::size_t k = graph_->first[e]; k < graph_->first[e + 1]; ++k) {
        const Index o = graph_->links[k].element;
        if (cluster_[o] != no_index)
          continue;
        const double reluctance_o = reluctance_now + reluctance(e, graph_->links[k]);
        const double cost_o = cost(o, c) + reluctance_o;
        if (cost_o < best[o] || best[o] == std::numeric_limits<double>::infinity()) {
          best[o] = std::min(cost_o, std::numeric_limits<double>::max());
          queue.push({best[o], o, c, reluctance_o});
        }
      }
    }
  }

  /// Fits each cluster's plane to its elements and moves the seed to the element closest to it. O(n).
  void fit()
  {
    std::vector<double> area(size(), 0), closest(size(), std::numeric_limits<double>::infinity());
    std::vector<Vector_3> vector(size(), Vector_3(0, 0, 0)), moment(size(), Vector_3(0, 0, 0));
    for (Index e = 0; e < graph_->size(); ++e) {
      const Index c = cluster_[e];
      area[c] += graph_->area[e];
      vector[c] = vector[c] + graph_->area_vector[e];
      moment[c] = moment[c] + graph_->moment[e];
    }
    for (Index c = 0; c < size(); ++c) {
      normal_[c] = unit(vector[c]);
      if (area[c] > 0)
        center_[c] = moment[c] / area[c];
    }
    for (Index e = 0; e < graph_->size(); ++e)
      if (const double d = cost(e, cluster_[e]); d < closest[cluster_[e]]) {
        closest[cluster_[e]] = d;
        seed_[cluster_[e]] = e;
      }
  }

  struct Spread
  {
    double area = 0;
    double energy = 0;      ///< integral of |n - N|^2 over the cluster, but for what is inside the elements
    Index worst = no_index; ///< the element that deviates most, if there is another one than the seed
  };

  /// How badly each plane fits. O(n).
  std::vector<Spread> spreads() const
  {
    std::vector<Spread> result(size());
    std::vector<double> worst(size(), -1);
    for (Index e = 0; e < graph_->size(); ++e) {
      const Index c = cluster_[e];
      const Vector_3& v = graph_->area_vector[e];
      const double length = std::sqrt(v.squared_length());
      const double energy = std::max(0.0, 2 * (length - v * normal_[c]));
      result[c].area += graph_->area[e];
      result[c].energy += energy;
      const double density = length > 0 ? energy / length : 0;
      if (e != seed_[c] && density > worst[c]) {
        worst[c] = density;
        result[c].worst = e;
      }
    }
    return result;
  }

private:
  /// What it costs to cross a cluster's radius of cheapest seams, in units of |n - N|^2.
  static constexpr double weight_of_reluctance = 0.3;

  void set_radius()
  {
    double area = 0;
    for (const double a : graph_->area)
      area += a;
    const double squared_radius =
        area / (std::numbers::pi * static_cast<double>(std::max<std::size_t>(size(), 1)));
    distance_weight_ = squared_radius > 0 ? compactness_ / squared_radius : 0;
    reluctance_weight_ = squared_radius > 0 ? weight_of_reluctance / std::sqrt(squared_radius) : 0;
  }

  /// What it costs a cluster to go on over a link: nothing where seams are dear, more where they are cheap,
  /// so that clusters meet there.
  double reluctance(Index e, const Element_graph::Link& link) const
  {
    const double usual = mean_cost_ * link.length;
    return link.cost < usual
               ? reluctance_weight_ * (1 - link.cost / usual) *
                     std::sqrt((graph_->centroid(e) - graph_->centroid(link.element)).squared_length())
               : 0;
  }

  /// The mean of |n - N|^2 over the element, plus its distance to the cluster's centre.
  double cost(Index e, Index c) const
  {
    const double a = graph_->area[e];
    const double bend = a > 0 ? 2 * (1 - graph_->area_vector[e] * normal_[c] / a) : 0;
    return bend + distance_weight_ * (graph_->centroid(e) - center_[c]).squared_length();
  }

  const Element_graph* graph_;
  double compactness_;
  double distance_weight_ = 0, reluctance_weight_ = 0;
  double mean_cost_ = 1;       ///< of seams, per length
  std::vector<Index> cluster_; ///< per element
  std::vector<Index> seed_;    ///< per cluster: an element
  std::vector<Vector_3> normal_, center_;
};

} // namespace Atlas::internal

#endif
