// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_OVERLAP_SEARCH_H
#define ATLAS_PACKING_INTERNAL_OVERLAP_SEARCH_H

#include <Atlas/packing/internal/Coarse_shape.h>
#include <Atlas/packing/internal/Outline.h>
#include <Atlas/packing/internal/Raster_builder.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The page and what shapes may do on it, for the search for places.
struct Overlap_options
{
  double width = 0, height = 0; ///< of the page in texels
  double gutter = 0;            ///< wanted between shapes, in texels
  double border = 0;            ///< kept to the border of the page
  std::vector<Vec2> turns = {}; ///< those allowed; empty: any
};

/// Looks for places of shapes on a page at a given scale by guided local search: shapes may overlap; one by
/// one they move to where they overlap least of many places tried all over the page, in any rotation; pairs
/// that go on overlapping weigh more and more (Egeblad et al. 2007, Umetani et al. 2009, Gardeyn and Wauters
/// 2025).
class Overlap_search
{
public:
  Overlap_search(const std::vector<Coarse_shape>& shapes, const Overlap_options& options, std::uint64_t seed)
      : shapes_(&shapes), options_(options), random_(seed), weights_(shapes.size() * shapes.size(), 1.0f),
        poses_(shapes.size())
  {}

  std::uint64_t work() const { return work_; }

  /// Improves a layout until no shapes overlap, or nothing has been gained for `patience` sweeps, or that
  /// much work has been done. Leaves the best layout seen; gives what is left of overlaps in it, in texels
  /// squared.
  double solve(Shape_layout& layout, int patience, std::uint64_t work_limit)
  {
    scale_ = layout.scale;
    for (Index i = 0; i < poses_.size(); ++i)
      poses_[i] = confined(i, {layout.positions[i], layout.turns[i]});
    std::fill(weights_.begin(), weights_.end(), 1.0f);
    double least = update_weights();
    std::vector<Pose> best = poses_;
    for (int idle = 0; least > 0 && idle < patience && work_ < work_limit; ++idle) {
      sweep();
      const double loss = update_weights();
      if (loss < least) {
        if (loss < 0.97 * least)
          idle = 0;
        least = loss;
        best = poses_;
      }
    }
    for (Index i = 0; i < best.size(); ++i) {
      layout.positions[i] = best[i].position;
      layout.turns[i] = best[i].turn;
    }
    return least * scale_ * scale_;
  }

private:
  struct Pose
  {
    Vec2 position, turn;
  };

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  /// The pose moved onto the page, as far as there is room.
  Pose confined(Index i, Pose pose) const
  {
    const Coarse_shape& shape = (*shapes_)[i];
    const double angle = std::atan2(pose.turn.y, pose.turn.x) / (2 * M_PI), b = options_.border;
    const auto fit = [&](double x, double low, double high, double size) {
      const double l = b + scale_ * low, h = size - b - scale_ * high;
      return l <= h ? std::clamp(x, l, h) : 0.5 * (l + h);
    };
    pose.position.x = fit(pose.position.x, shape.extent(0.5 - angle), shape.extent(-angle), options_.width);
    pose.position.y =
        fit(pose.position.y, shape.extent(0.75 - angle), shape.extent(0.25 - angle), options_.height);
    return pose;
  }

  /// How deep the discs of shape i, at a pose, are in shape j; gives up beyond `limit`.
  float depth(Index i, const Pose& pose, Index j, float limit)
  {
    const Coarse_shape &a = (*shapes_)[i], &b = (*shapes_)[j];
    const Pose& other = poses_[j];
    const Vec2 between = pose.position - other.position;
    const double reach = (a.radius + b.radius) * scale_ + options_.gutter;
    ++work_;
    if (dot(between, between) >= reach * reach)
      return 0;
    const Vec2 back{other.turn.x, -other.turn.y};
    const Vec2 shift = rotated((1 / scale_) * back, between), turn = rotated(back, pose.turn);
    const float sx = static_cast<float>(shift.x), sy = static_cast<float>(shift.y),
                c = static_cast<float>(turn.x), s = static_cast<float>(turn.y),
                gutter = static_cast<float>(options_.gutter / scale_);
    const auto distance = [&](float x, float y) {
      return b.distance(sx + c * x - s * y, sy + s * x + c * y);
    };
    float sum = 0;
    for (const Coarse_shape::Cluster& cluster : a.clusters) {
      if (sum >= limit)
        return sum;
      work_ += 5;
      if (distance(cluster.x, cluster.y) > cluster.radius + gutter)
        continue;
      work_ += 5 * (cluster.end - cluster.begin);
      for (std::size_t k = cluster.begin; k < cluster.end; ++k) {
        const Coarse_shape::Disc& disc = a.discs[k];
        const float d = disc.radius + gutter - distance(disc.x, disc.y);
        if (d > 0)
          sum += disc.weight * d;
      }
    }
    return sum;
  }

  /// The weighted overlap of shape i at a pose with all others; gives up beyond `limit`.
  float loss(Index i, const Pose& pose, float limit)
  {
    const std::size_t n = poses_.size();
    float sum = 0;
    for (Index j = 0; j < n && sum < limit; ++j)
      if (j != i)
        sum += weights_[i * n + j] * depth(i, pose, j, (limit - sum) / weights_[i * n + j]);
    return sum;
  }

  Pose random_pose(Index i)
  {
    Pose pose{{uniform() * options_.width, uniform() * options_.height}, random_turn()};
    return confined(i, pose);
  }

  Vec2 random_turn()
  {
    if (!options_.turns.empty())
      return options_.turns[random_() % options_.turns.size()];
    const double angle = 2 * M_PI * uniform();
    return {std::cos(angle), std::sin(angle)};
  }

  Pose nearby(Index i, const Pose& pose, double reach, double angle)
  {
    Pose next = pose;
    next.position = next.position + reach * Vec2{2 * uniform() - 1, 2 * uniform() - 1};
    if (options_.turns.empty()) {
      const double a = angle * (2 * uniform() - 1);
      next.turn = rotated({std::cos(a), std::sin(a)}, next.turn);
    }
    return confined(i, next);
  }

  /// Moves shape i to the best of many places.
  void move(Index i)
  {
    const float before = loss(i, poses_[i], HUGE_VALF);
    if (!(before > 0))
      return;
    std::pair<float, Pose> best{before, poses_[i]}, second{HUGE_VALF, poses_[i]};
    const auto offer = [&](const Pose& pose) {
      const float l = loss(i, pose, second.first);
      if (l < best.first) {
        second = std::exchange(best, {l, pose});
      } else if (l < second.first)
        second = {l, pose};
    };
    const double reach = 0.5 * (*shapes_)[i].radius * scale_;
    for (int k = 0; k < 12 && best.first > 0; ++k)
      offer(nearby(i, poses_[i], reach, 0.5));
    for (int k = 0; k < 48 && best.first > 0; ++k)
      offer(random_pose(i));
    refine(i, best);
    if (best.first > 0 && second.first < HUGE_VALF) {
      refine(i, second);
      if (second.first < best.first)
        best = second;
    }
    poses_[i] = best.second;
  }

  /// Descends from a pose in ever smaller random steps.
  void refine(Index i, std::pair<float, Pose>& best)
  {
    const double size = std::max(options_.width, options_.height);
    double reach = 0.06 * size;
    for (int failures = 0; best.first > 0 && reach > 0.002 * size;) {
      const Pose pose = nearby(i, best.second, reach, reach / ((*shapes_)[i].radius * scale_ + reach));
      const float l = loss(i, pose, best.first);
      if (l < best.first) {
        best = {l, pose};
        failures = 0;
      } else if (++failures == 5) {
        reach *= 0.5;
        failures = 0;
      }
    }
  }

  void sweep()
  {
    order_.resize(poses_.size());
    for (Index i = 0; i < order_.size(); ++i)
      order_[i] = i;
    for (std::size_t k = order_.size(); k > 1; --k)
      std::swap(order_[k - 1], order_[random_() % k]);
    for (const Index i : order_)
      move(i);
  }

  /// Pairs that overlap become heavier, others lighter. Gives the sum of overlaps without weights.
  double update_weights()
  {
    const std::size_t n = poses_.size();
    depths_.assign(n * n, 0.0f);
    float most = 0;
    double sum = 0;
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < i; ++j) {
        const float d = depth(i, poses_[i], j, HUGE_VALF) + depth(j, poses_[j], i, HUGE_VALF);
        depths_[i * n + j] = d;
        most = std::max(most, d);
        sum += d;
      }
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < i; ++j) {
        const float d = depths_[i * n + j];
        float& w = weights_[i * n + j];
        w = d > 0 ? std::min(1e6f, w * (1.2f + 0.8f * d / most)) : std::max(1.0f, 0.95f * w);
        weights_[j * n + i] = w;
      }
    return sum;
  }

  const std::vector<Coarse_shape>* shapes_;
  Overlap_options options_;
  std::mt19937_64 random_;
  std::vector<float> weights_, depths_; ///< per pair
  std::vector<Pose> poses_;
  std::vector<Index> order_;
  double scale_ = 1;
  std::uint64_t work_ = 0;
};

} // namespace Atlas::internal

#endif
