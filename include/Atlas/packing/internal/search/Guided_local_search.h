// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SEARCH_GUIDED_LOCAL_SEARCH_H
#define ATLAS_PACKING_INTERNAL_SEARCH_GUIDED_LOCAL_SEARCH_H

#include <Atlas/packing/internal/raster/Raster_builder.h>
#include <Atlas/packing/internal/shapes/Coarse_shape.h>
#include <Atlas/packing/internal/shapes/Outline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
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
  std::size_t obstacles = 0;    ///< so many of the last shapes stay where they are, at scale 1
};

/// Looks for places of shapes on a page at a given scale by guided local search: shapes may overlap; one by
/// one they move to where they overlap least of many places tried all over the page, in any rotation; pairs
/// that go on overlapping weigh more and more (Egeblad et al. 2007, Umetani et al. 2009, Gardeyn and Wauters
/// 2025).
class Guided_local_search
{
public:
  Guided_local_search(const std::vector<Coarse_shape>& shapes, const Overlap_options& options,
                      std::uint64_t seed)
      : shapes_(&shapes), options_(options), movable_(shapes.size() - options.obstacles),
        obstacles_(options.obstacles), random_(seed), weights_(shapes.size() * shapes.size(), 1.0f),
        poses_(shapes.size())
  {}

  std::uint64_t work() const { return work_; }

  /// Improves a layout until no shapes overlap, or nothing has been gained for `patience` sweeps, or that
  /// much work has been done. Leaves the best layout seen; gives what is left of overlaps in it, in texels
  /// squared.
  double solve(Shape_layout& layout, int patience, std::uint64_t work_limit)
  {
    scale_ = layout.scale;
    for (std::size_t k = 0; k < obstacles_.size(); ++k) // in the unit that the others have at this scale
      obstacles_[k] = (*shapes_)[movable_ + k].scaled(1 / scale_);
    for (Index i = 0; i < poses_.size(); ++i) {
      poses_[i] = {layout.positions[i], layout.turns[i], angle_of(layout.turns[i])};
      if (i < movable_)
        poses_[i] = confined(i, poses_[i]);
    }
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
    for (Index i = 0; i < movable_; ++i) {
      layout.positions[i] = best[i].position;
      layout.turns[i] = best[i].turn;
    }
    return least * scale_ * scale_;
  }

private:
  struct Pose
  {
    Vec2 position, turn;
    double angle; ///< of the turn, as a share of a full one
  };
  /// How one shape lies in the frame of another, in their unit: turned by (c, s), then moved by (x, y).
  struct Relation
  {
    float x, y, c, s;
  };
  /// The weighted overlap of a shape, and how it changes with its place and with its turn, per radian.
  struct Gradient
  {
    double loss = 0;
    Vec2 shift;
    double turn = 0;
  };

  bool may_turn(Index i) const { return shape(i).rotation == Chart_rotation::any; }
  const Coarse_shape& shape(Index i) const { return i < movable_ ? (*shapes_)[i] : obstacles_[i - movable_]; }

  static Vec2 turn_by(double angle) { return {std::cos(2 * M_PI * angle), std::sin(2 * M_PI * angle)}; }
  static double angle_of(Vec2 turn) { return std::atan2(turn.y, turn.x) / (2 * M_PI); }

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  /// The pose moved onto the page, as far as there is room.
  Pose confined(Index i, Pose pose) const
  {
    const Coarse_shape& coarse = shape(i);
    const double angle = pose.angle, b = options_.border;
    const auto fit = [&](double x, double low, double high, double size) {
      const double l = b + scale_ * low, h = size - b - scale_ * high;
      return l <= h ? std::clamp(x, l, h) : 0.5 * (l + h);
    };
    pose.position.x = fit(pose.position.x, coarse.extent(0.5 - angle), coarse.extent(-angle), options_.width);
    pose.position.y =
        fit(pose.position.y, coarse.extent(0.75 - angle), coarse.extent(0.25 - angle), options_.height);
    return pose;
  }

  float gutter() const { return static_cast<float>(options_.gutter / scale_); }

  /// How shape i, at a pose, lies in the frame of shape j; nothing if they are too far apart to overlap.
  std::optional<Relation> relation(Index i, const Pose& pose, Index j)
  {
    const Pose& other = poses_[j];
    const Vec2 between = pose.position - other.position;
    const double reach = (shape(i).radius + shape(j).radius) * scale_ + options_.gutter;
    ++work_;
    if (dot(between, between) >= reach * reach)
      return std::nullopt;
    const Vec2 back{other.turn.x, -other.turn.y};
    const Vec2 shift = rotated((1 / scale_) * back, between), turn = rotated(back, pose.turn);
    return Relation{static_cast<float>(shift.x), static_cast<float>(shift.y), static_cast<float>(turn.x),
                    static_cast<float>(turn.y)};
  }

  /// Calls `f(disc, x, y)` for the discs of shape i that may be in shape j, with their places relative to the
  /// centre of shape i in the frame of shape j, until `f` returns false.
  template <typename F>
  void for_each_disc_near(Index i, Index j, const Relation& r, F f)
  {
    const Coarse_shape &a = shape(i), &b = shape(j);
    const float wanted = gutter();
    for (const Coarse_shape::Cluster& cluster : a.clusters) {
      work_ += 5;
      if (b.distance(r.x + r.c * cluster.x - r.s * cluster.y, r.y + r.s * cluster.x + r.c * cluster.y) >
          cluster.radius + wanted)
        continue;
      work_ += 5 * (cluster.end - cluster.begin);
      bool goes_on = true;
      for (std::size_t k = cluster.begin; k < cluster.end; ++k) {
        const Coarse_shape::Disc& disc = a.discs[k];
        goes_on = f(disc, r.c * disc.x - r.s * disc.y, r.s * disc.x + r.c * disc.y);
      }
      if (!goes_on)
        return;
    }
  }

  /// How deep the discs of shape i, at a pose, are in shape j; gives up beyond `limit`.
  float depth(Index i, const Pose& pose, Index j, float limit)
  {
    const std::optional<Relation> r = relation(i, pose, j);
    if (!r)
      return 0;
    const Coarse_shape& b = shape(j);
    const float wanted = gutter();
    float sum = 0;
    for_each_disc_near(i, j, *r, [&](const Coarse_shape::Disc& disc, float x, float y) {
      if (const float d = disc.radius + wanted - b.distance(r->x + x, r->y + y); d > 0)
        sum += disc.weight * d;
      return sum < limit;
    });
    return sum;
  }

  /// Adds the weighted overlap of shape i, at a pose, with shape j.
  void add_gradient(Index i, const Pose& pose, Index j, Gradient& gradient)
  {
    const std::optional<Relation> r = relation(i, pose, j);
    if (!r)
      return;
    const Coarse_shape& b = shape(j);
    const float wanted = gutter();
    float sum = 0, dx = 0, dy = 0, turn = 0;
    for_each_disc_near(i, j, *r, [&](const Coarse_shape::Disc& disc, float x, float y) {
      const Coarse_shape::Slope at = b.slope(r->x + x, r->y + y);
      if (const float d = disc.radius + wanted - at.distance; d > 0) {
        sum += disc.weight * d;
        dx -= disc.weight * at.x;
        dy -= disc.weight * at.y;
        turn -= disc.weight * (x * at.y - y * at.x);
      }
      return true;
    });
    const double w = weights_[i * poses_.size() + j];
    gradient.loss += w * sum;
    gradient.shift = gradient.shift + (w / scale_) * rotated(poses_[j].turn, {dx, dy});
    gradient.turn += w * turn;
  }

  Gradient gradient(Index i, const Pose& pose)
  {
    Gradient result;
    for (Index j = 0; j < poses_.size(); ++j)
      if (j != i)
        add_gradient(i, pose, j, result);
    return result;
  }

  /// The part of the weighted overlap that the largest disc of shape i has. Most poses tried are as bad by
  /// it.
  float core_loss(Index i, const Pose& pose)
  {
    const std::size_t n = poses_.size();
    const Coarse_shape::Disc& disc = shape(i).discs.front();
    const Vec2 centre = pose.position + scale_ * rotated(pose.turn, {disc.x, disc.y});
    const float wanted = disc.radius + gutter();
    float sum = 0;
    work_ += 5 * n;
    for (Index j = 0; j < n; ++j) {
      const Coarse_shape& other = shape(j);
      const Vec2 p = (1 / scale_) * (centre - poses_[j].position), turn = poses_[j].turn;
      const double reach = other.radius + wanted;
      if (j == i || dot(p, p) >= reach * reach)
        continue;
      const Vec2 q = rotated({turn.x, -turn.y}, p);
      if (const float d = wanted - other.distance(static_cast<float>(q.x), static_cast<float>(q.y)); d > 0)
        sum += weights_[i * n + j] * disc.weight * d;
    }
    return sum;
  }

  /// The weighted overlap of shape i at a pose with all others; gives up beyond `limit`.
  float loss(Index i, const Pose& pose, float limit)
  {
    const std::size_t n = poses_.size();
    if (limit < HUGE_VALF && core_loss(i, pose) >= limit)
      return limit;
    float sum = 0;
    for (Index j = 0; j < n && sum < limit; ++j)
      if (j != i)
        sum += weights_[i * n + j] * depth(i, pose, j, (limit - sum) / weights_[i * n + j]);
    return sum;
  }

  Pose random_pose(Index i)
  {
    Pose pose{{uniform() * options_.width, uniform() * options_.height}, {}, 0};
    if (may_turn(i)) {
      pose.angle = uniform();
      pose.turn = turn_by(pose.angle);
    } else {
      const std::vector<Vec2>& turns = shape(i).rotation == Chart_rotation::none ? no_turn_ : quarter_turns_;
      pose.turn = turns[random_() % turns.size()];
      pose.angle = angle_of(pose.turn);
    }
    return confined(i, pose);
  }

  /// A pose at most half the radius of the shape away, and half a radian.
  Pose nearby(Index i, const Pose& pose)
  {
    const double reach = 0.5 * shape(i).radius * scale_;
    Pose next = pose;
    next.position = next.position + reach * Vec2{2 * uniform() - 1, 2 * uniform() - 1};
    if (may_turn(i)) {
      next.angle += 0.08 * (2 * uniform() - 1);
      next.turn = turn_by(next.angle);
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
    for (int k = 0; k < 12 && best.first > 0; ++k)
      offer(nearby(i, poses_[i]));
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

  /// Descends from a pose: each step would end the overlap if that went on to change as it does there (Polyak
  /// 1969); steps are shorter after one that gained nothing.
  void refine(Index i, std::pair<float, Pose>& best)
  {
    const double arm = 0.7 * shape(i).radius * scale_; // turning by a radian is as far as moving by that
    const double longest = 0.06 * std::max(options_.width, options_.height);
    double share = 1;
    Gradient at = gradient(i, best.second);
    for (int k = 0; k < 8 && best.first > 0 && share > 0.1; ++k) {
      const double turn = may_turn(i) ? at.turn / arm : 0;
      const double square = dot(at.shift, at.shift) + turn * turn;
      if (!(square > 0))
        return;
      const double step = share * std::min(at.loss / square, longest / std::sqrt(square));
      Pose pose = best.second;
      pose.position = pose.position - step * at.shift;
      if (may_turn(i)) {
        pose.angle -= step * turn / (2 * M_PI * arm);
        pose.turn = turn_by(pose.angle);
      }
      pose = confined(i, pose);
      const Gradient next = gradient(i, pose);
      if (next.loss < best.first) {
        best = {static_cast<float>(next.loss), pose};
        at = next;
        share = std::min(1.0, 1.5 * share);
      } else
        share *= 0.5;
    }
  }

  void sweep()
  {
    order_.resize(movable_);
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
      for (Index j = 0; j < std::min<std::size_t>(i, movable_); ++j) {
        const float d = depth(i, poses_[i], j, HUGE_VALF) + depth(j, poses_[j], i, HUGE_VALF);
        depths_[i * n + j] = d;
        most = std::max(most, d);
        sum += d;
      }
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < std::min<std::size_t>(i, movable_); ++j) {
        const float d = depths_[i * n + j];
        float& w = weights_[i * n + j];
        w = d > 0 ? std::min(1e6f, w * (1.2f + 0.8f * d / most)) : std::max(1.0f, 0.95f * w);
        weights_[j * n + i] = w;
      }
    return sum;
  }

  const std::vector<Coarse_shape>* shapes_;
  Overlap_options options_;
  std::vector<Vec2> quarter_turns_ = rotations(4), no_turn_ = rotations(1);
  std::size_t movable_;                 ///< shapes; the others are obstacles
  std::vector<Coarse_shape> obstacles_; ///< in the unit of the shapes
  std::mt19937_64 random_;
  std::vector<float> weights_, depths_; ///< per pair
  std::vector<Pose> poses_;
  std::vector<Index> order_;
  double scale_ = 1;
  std::uint64_t work_ = 0;
};

} // namespace Atlas::internal

#endif
