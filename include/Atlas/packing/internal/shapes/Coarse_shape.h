// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_COARSE_SHAPE_H
#define ATLAS_PACKING_INTERNAL_SHAPES_COARSE_SHAPE_H

#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/Packing_shape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// A shape as the search for places sees it: a few discs that fill it and the corners of its border, and the
/// distance from it on a coarse grid. Discs of one shape in the distances of another tell how deep the two
/// are in each other.
struct Coarse_shape
{
  struct Disc
  {
    float x, y, radius;
    float weight; ///< of its depth
  };
  /// A circle around consecutive discs.
  struct Cluster
  {
    float x, y, radius;
    std::size_t begin, end;
  };
  static constexpr int directions = 256;

  std::vector<Disc> discs;                  ///< by clusters
  std::vector<Cluster> clusters;            ///< that of the largest disc first
  std::array<double, directions> support{}; ///< extent of the shape in these directions
  double radius = 0;
  Chart_rotation rotation = Chart_rotation::any;

  /// The signed distance from the shape, negative inside, interpolated.
  float distance(float x, float y) const
  {
    const float gx = (x - left_) * nodes_per_unit_, gy = (y - bottom_) * nodes_per_unit_;
    if (gx >= 0 && gy >= 0 && gx < right_limit_ && gy < top_limit_)
      return interpolated(gx, gy);
    const float cx = std::clamp(gx, 0.0f, right_limit_), cy = std::clamp(gy, 0.0f, top_limit_);
    return interpolated(cx, cy) + std::sqrt((gx - cx) * (gx - cx) + (gy - cy) * (gy - cy)) / nodes_per_unit_;
  }

  /// A distance and how it changes along x and y.
  struct Slope
  {
    float distance, x, y;
  };

  /// The distance and its slope, which is given as 0 outside the grid.
  Slope slope(float x, float y) const
  {
    const float gx = (x - left_) * nodes_per_unit_, gy = (y - bottom_) * nodes_per_unit_;
    if (!(gx >= 0 && gy >= 0 && gx < right_limit_ && gy < top_limit_))
      return {distance(x, y), 0, 0};
    const int ix = static_cast<int>(gx), iy = static_cast<int>(gy);
    const float fx = gx - static_cast<float>(ix), fy = gy - static_cast<float>(iy);
    const float* d = distance_.data() + iy * nx_ + ix;
    const float bottom = d[1] - d[0], top = d[nx_ + 1] - d[nx_];
    const float low = d[0] + fx * bottom, high = d[nx_] + fx * top;
    return {low + fy * (high - low), nodes_per_unit_ * (bottom + fy * (top - bottom)),
            nodes_per_unit_ * (high - low)};
  }

  /// The extent in the direction of angle `turns`, a fraction of a full turn.
  double extent(double turns) const
  {
    const double t = (turns - std::floor(turns)) * directions;
    const int k = static_cast<int>(t) % directions;
    return support[k] + (t - std::floor(t)) * (support[(k + 1) % directions] - support[k]);
  }

  /// The shape in another unit.
  Coarse_shape scaled(double factor) const
  {
    Coarse_shape result = *this;
    const float f = static_cast<float>(factor);
    for (Disc& d : result.discs)
      d = {f * d.x, f * d.y, f * d.radius, f * d.weight};
    for (Cluster& c : result.clusters)
      c = {f * c.x, f * c.y, f * c.radius, c.begin, c.end};
    for (double& s : result.support)
      s *= factor;
    result.radius *= factor;
    result.left_ *= f;
    result.bottom_ *= f;
    result.nodes_per_unit_ /= f;
    for (float& d : result.distance_)
      d *= f;
    return result;
  }

  /// \param detail  discs smaller than that are left out, and corners flatter than that
  /// \param pad     how far distances are wanted, outside
  void build(const Packing_shape& shape, double detail, double pad, std::size_t most_discs)
  {
    radius = shape.radius;
    rotation = shape.rotation;
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * M_PI * k / directions;
      double& s = support[k];
      s = -HUGE_VAL;
      for (const Vec2& p : shape.hull)
        s = std::max(s, dot(p, Vec2{std::cos(angle), std::sin(angle)}));
    }
    build_grid(shape, detail, pad);
    add_discs(detail, most_discs);
    add_corners(shape, detail, most_discs);
    make_clusters();
  }

private:
  static constexpr int nodes_across = 48;

  float interpolated(float gx, float gy) const
  {
    const int ix = static_cast<int>(gx), iy = static_cast<int>(gy);
    const float fx = gx - static_cast<float>(ix), fy = gy - static_cast<float>(iy);
    const float* d = distance_.data() + iy * nx_ + ix;
    const float low = d[0] + fx * (d[1] - d[0]), high = d[nx_] + fx * (d[nx_ + 1] - d[nx_]);
    return low + fy * (high - low);
  }

  Vec2 node(int x, int y) const
  {
    return {left_ + double(x) / nodes_per_unit_, bottom_ + double(y) / nodes_per_unit_};
  }

  void build_grid(const Packing_shape& shape, double detail, double pad)
  {
    Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
    for (const Vec2& p : shape.hull) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double cell = std::max(
        {(high.x - low.x) / nodes_across, (high.y - low.y) / nodes_across, 0.5 * detail, 1e-6 * pad});
    pad = std::min(pad, 12 * cell);
    left_ = static_cast<float>(low.x - pad);
    bottom_ = static_cast<float>(low.y - pad);
    nodes_per_unit_ = static_cast<float>(1 / cell);
    nx_ = 3 + static_cast<int>((high.x - low.x + 2 * pad) / cell);
    ny_ = 3 + static_cast<int>((high.y - low.y + 2 * pad) / cell);
    right_limit_ = static_cast<float>(nx_) - 1.01f;
    top_limit_ = static_cast<float>(ny_) - 1.01f;
    std::vector<Vec2> samples;
    for (const Vec2& p : shape.samples)
      if (samples.empty() || length(p - samples.back()) > 0.4 * cell)
        samples.push_back(p);
    for (int y = 0; y < ny_; ++y)
      for (int x = 0; x < nx_; ++x) {
        const Vec2 p = node(x, y);
        const Distance_field::Sample fine = shape.field.sample(p);
        double d = fine.distance;
        if (!fine.is_inside_grid) {
          double least = HUGE_VAL;
          for (const Vec2& q : samples)
            least = std::min(least, dot(p - q, p - q));
          d = std::sqrt(least);
        }
        distance_.push_back(static_cast<float>(d));
      }
  }

  /// Discs inside the shape, each where most is left that no other covers.
  void add_discs(double detail, std::size_t most)
  {
    std::vector<double> gap(distance_.size(), HUGE_VAL); // distance from the discs so far
    while (discs.size() < most) {
      std::size_t best = 0;
      double gain = 0;
      for (std::size_t k = 0; k < gap.size(); ++k)
        if (const double g = std::min(gap[k], -double(distance_[k])); g > gain) {
          gain = g;
          best = k;
        }
      if (gain < 0.5 * detail)
        return;
      const Vec2 c = node(static_cast<int>(best) % nx_, static_cast<int>(best) / nx_);
      const double r = -distance_[best];
      add(c, r, detail);
      for (std::size_t k = 0; k < gap.size(); ++k)
        gap[k] = std::min(gap[k], length(node(static_cast<int>(k) % nx_, static_cast<int>(k) / nx_) - c) - r);
    }
  }

  void add(Vec2 c, double r, double detail)
  {
    discs.push_back({static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(r),
                     static_cast<float>(r + 2 * detail)});
  }

  /// Corners of the border that no disc comes near to.
  void add_corners(const Packing_shape& shape, double detail, std::size_t most)
  {
    const std::size_t first = discs.size();
    for (const Vec2& p : shape.samples) {
      bool is_covered = false;
      for (std::size_t k = 0; k < discs.size() && !is_covered; ++k)
        is_covered =
            length(p - Vec2{discs[k].x, discs[k].y}) < discs[k].radius + (k < first ? 1.0 : 2.0) * detail;
      if (!is_covered && discs.size() < first + most)
        add(p, 0, detail);
    }
  }

  static float square(float x) { return x * x; }

  /// Brings discs that are near to each other together, about eight a cluster: each goes to the nearest of
  /// some discs that are far from each other.
  void make_clusters()
  {
    const std::size_t n = discs.size(), count = (n + 7) / 8;
    std::vector<float> nearest(n, HUGE_VALF); // squared distance of the nearest centre so far
    std::vector<std::size_t> cluster(n, 0);
    std::size_t centre = 0;
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t k = 0; k < n; ++k)
        if (const float d = square(discs[k].x - discs[centre].x) + square(discs[k].y - discs[centre].y);
            d < nearest[k]) {
          nearest[k] = d;
          cluster[k] = c;
        }
      centre = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    }
    std::vector<Disc> sorted;
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t begin = sorted.size();
      for (std::size_t k = 0; k < n; ++k)
        if (cluster[k] == c)
          sorted.push_back(discs[k]);
      if (sorted.size() > begin)
        clusters.push_back(circle_around(sorted, begin));
    }
    discs = std::move(sorted);
  }

  /// A circle around the discs from `begin` on.
  static Cluster circle_around(const std::vector<Disc>& discs, std::size_t begin)
  {
    float left = HUGE_VALF, right = -HUGE_VALF, bottom = HUGE_VALF, top = -HUGE_VALF;
    for (std::size_t k = begin; k < discs.size(); ++k) {
      left = std::min(left, discs[k].x - discs[k].radius);
      right = std::max(right, discs[k].x + discs[k].radius);
      bottom = std::min(bottom, discs[k].y - discs[k].radius);
      top = std::max(top, discs[k].y + discs[k].radius);
    }
    Cluster result{(left + right) / 2, (bottom + top) / 2, 0, begin, discs.size()};
    for (std::size_t k = begin; k < discs.size(); ++k)
      result.radius = std::max(result.radius, discs[k].radius + std::sqrt(square(discs[k].x - result.x) +
                                                                          square(discs[k].y - result.y)));
    return result;
  }

  float left_ = 0, bottom_ = 0, nodes_per_unit_ = 1, right_limit_ = 0, top_limit_ = 0;
  int nx_ = 0, ny_ = 0;
  std::vector<float> distance_;
};

} // namespace Atlas::internal

#endif
