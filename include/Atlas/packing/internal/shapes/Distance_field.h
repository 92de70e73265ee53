// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SHAPES_DISTANCE_FIELD_H
#define ATLAS_PACKING_INTERNAL_SHAPES_DISTANCE_FIELD_H

#include <Atlas/core/Kernel.h>
#include <Atlas/planar/internal/segments.h>
#include <Atlas/planar/internal/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Segments that bound a chart, with the directions that lead out of it.
struct Segment_set
{
  std::vector<Vec2> points;
  std::vector<std::array<Index, 2>> segments;
  std::vector<Vec2> segment_normals; ///< outwards; none if it is not known where that is
  std::vector<Vec2> point_normals;   ///< sums of those of the segments that meet there

  struct Closest
  {
    Vec2 point, normal;
  };

  Vec2 closest_point(Index s, Vec2 p) const
  {
    return internal::closest_point(p, points[segments[s][0]], points[segments[s][1]]);
  }

  /// The point of the segment closest to `p`, with a normal that tells whether `p` is outside.
  Closest closest(Index s, Vec2 p) const
  {
    const Vec2 a = points[segments[s][0]], b = points[segments[s][1]];
    const double t = closest_position(p, a, b);
    const bool is_oriented = !segment_normals.empty();
    if (t <= 0)
      return {a, is_oriented ? point_normals[segments[s][0]] : Vec2{}};
    if (t >= 1)
      return {b, is_oriented ? point_normals[segments[s][1]] : Vec2{}};
    return {a + t * (b - a), is_oriented ? segment_normals[s] : Vec2{}};
  }

  /// Finds the normals of segments that have the chart on their left (`orientation` 1) or right (-1).
  void orient(int orientation)
  {
    point_normals.assign(points.size(), Vec2{});
    for (const auto& [i, j] : segments) {
      const Vec2 d = points[j] - points[i];
      const double l = length(d);
      const Vec2 n = l > 0 ? (orientation / l) * Vec2{d.y, -d.x} : Vec2{};
      segment_normals.push_back(n);
      point_normals[i] = point_normals[i] + n;
      point_normals[j] = point_normals[j] + n;
    }
  }
};

/// The signed distance from a chart, negative inside, on a grid: in each node also the nearest segment, so
/// that near the chart the distance can be had exactly.
class Distance_field
{
public:
  /// \param pad how far the grid reaches beyond the segments
  void build(const Segment_set& set, std::size_t number_of_border_segments,
             const std::vector<std::array<Vec2, 3>>& triangles, double cell, double pad)
  {
    cell_ = cell;
    nodes_per_unit_ = 1 / cell;
    pad_ = pad;
    Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
    for (const Vec2& p : set.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    origin_ = low - Vec2{pad, pad};
    nx_ = 2 + static_cast<Index>((high.x - low.x + 2 * pad) / cell);
    ny_ = 2 + static_cast<Index>((high.y - low.y + 2 * pad) / cell);
    distance_.assign(std::size_t(nx_) * ny_, HUGE_VALF);
    nearest_.assign(std::size_t(nx_) * ny_, no_index);
    for (Index s = 0; s < set.segments.size(); ++s)
      draw(set, s);
    propagate(set);
    if (triangles.empty())
      negate_inside(set, number_of_border_segments);
    else
      for (const auto& t : triangles)
        negate_triangle(t);
  }

  struct Sample
  {
    double distance; ///< a lower bound of it outside the grid
    bool is_inside_grid;
    std::size_t node; ///< lower left node
    double fx, fy;    ///< position in the cell
  };

  /// The distance between nodes is interpolated.
  Sample sample(Vec2 p) const
  {
    const double gx = (p.x - origin_.x) * nodes_per_unit_, gy = (p.y - origin_.y) * nodes_per_unit_;
    if (!(gx >= 0 && gy >= 0 && gx < nx_ - 1 && gy < ny_ - 1)) {
      const double beyond = std::max({0.0, -gx, gx - (nx_ - 1), -gy, gy - (ny_ - 1)});
      return {pad_ + (beyond - 1) * cell_, false, 0, 0, 0};
    }
    const Index ix = static_cast<Index>(static_cast<int>(gx)), iy = static_cast<Index>(static_cast<int>(gy));
    const double fx = gx - ix, fy = gy - iy;
    const std::size_t k = std::size_t(iy) * nx_ + ix;
    const double d = (1 - fy) * ((1 - fx) * distance_[k] + fx * distance_[k + 1]) +
                     fy * ((1 - fx) * distance_[k + nx_] + fx * distance_[k + nx_ + 1]);
    return {d, true, k, fx, fy};
  }

  /// The distance of `sample(p)` alone, for inner loops.
  double lower_bound(Vec2 p) const
  {
    const double gx = (p.x - origin_.x) * nodes_per_unit_, gy = (p.y - origin_.y) * nodes_per_unit_;
    if (!(gx >= 0 && gy >= 0 && gx < nx_ - 1 && gy < ny_ - 1))
      return sample(p).distance;
    const int ix = static_cast<int>(gx), iy = static_cast<int>(gy);
    const double fx = gx - ix, fy = gy - iy;
    const float *low = distance_.data() + std::size_t(iy) * nx_ + ix, *high = low + nx_;
    return (1 - fy) * ((1 - fx) * low[0] + fx * low[1]) + fy * ((1 - fx) * high[0] + fx * high[1]);
  }

  /// The distance, from above outside the grid.
  double estimate(Vec2 p) const
  {
    const Sample inside = sample(p);
    if (inside.is_inside_grid)
      return inside.distance;
    const Vec2 q{std::clamp(p.x, origin_.x + 0.01 * cell_, origin_.x + (nx_ - 1.01) * cell_),
                 std::clamp(p.y, origin_.y + 0.01 * cell_, origin_.y + (ny_ - 1.01) * cell_)};
    return sample(q).distance + length(p - q);
  }

  /// The direction in which the interpolated distance grows fastest, of length about 1.
  Vec2 gradient(const Sample& s) const
  {
    const double d00 = distance_[s.node], d10 = distance_[s.node + 1], d01 = distance_[s.node + nx_],
                 d11 = distance_[s.node + nx_ + 1];
    return {((1 - s.fy) * (d10 - d00) + s.fy * (d11 - d01)) / cell_,
            ((1 - s.fx) * (d01 - d00) + s.fx * (d11 - d10)) / cell_};
  }

  /// The nearest point of the segments that are nearest to the corners of the cell.
  Segment_set::Closest closest(const Segment_set& set, const Sample& s, Vec2 p) const
  {
    const std::array<Index, 4> ids{nearest_[s.node], nearest_[s.node + 1], nearest_[s.node + nx_],
                                   nearest_[s.node + nx_ + 1]};
    Segment_set::Closest best = set.closest(ids[0], p);
    for (int i = 1; i < 4; ++i) {
      if (std::find(ids.begin(), ids.begin() + i, ids[i]) != ids.begin() + i)
        continue;
      const Segment_set::Closest q = set.closest(ids[i], p);
      if (dot(q.point - p, q.point - p) < dot(best.point - p, best.point - p))
        best = q;
    }
    return best;
  }

  double cell() const { return cell_; }

private:
  Vec2 node(Index ix, Index iy) const { return origin_ + cell_ * Vec2{double(ix), double(iy)}; }

  void offer(const Segment_set& set, Index ix, Index iy, Index s)
  {
    const Vec2 p = node(ix, iy), d = set.closest_point(s, p) - p;
    const float l = static_cast<float>(length(d));
    const std::size_t k = std::size_t(iy) * nx_ + ix;
    if (l < distance_[k]) {
      distance_[k] = l;
      nearest_[k] = s;
    }
  }

  /// Offers the segment to all nodes around the cells it passes.
  void draw(const Segment_set& set, Index s)
  {
    const Vec2 a = set.points[set.segments[s][0]], b = set.points[set.segments[s][1]];
    const Index steps = 1 + static_cast<Index>(2 * length(b - a) / cell_);
    Index last_x = no_index, last_y = no_index;
    for (Index i = 0; i <= steps; ++i) {
      const Vec2 p = (1 / cell_) * (a + (double(i) / steps) * (b - a) - origin_);
      const Index ix = std::min(nx_ - 2, static_cast<Index>(std::max(0.0, p.x)));
      const Index iy = std::min(ny_ - 2, static_cast<Index>(std::max(0.0, p.y)));
      if (ix == last_x && iy == last_y)
        continue;
      last_x = ix;
      last_y = iy;
      for (Index y = iy; y <= iy + 1; ++y)
        for (Index x = ix; x <= ix + 1; ++x)
          offer(set, x, y, s);
    }
  }

  /// Hands nearest segments from node to node, forth and back.
  void propagate(const Segment_set& set)
  {
    const auto take = [&](Index x, Index y, int dx, int dy) {
      const long long i = static_cast<long long>(x) + dx, j = static_cast<long long>(y) + dy;
      if (i < 0 || j < 0 || i >= nx_ || j >= ny_)
        return;
      const Index s = nearest_[static_cast<std::size_t>(j) * nx_ + static_cast<std::size_t>(i)];
      if (s != no_index && s != nearest_[std::size_t(y) * nx_ + x])
        offer(set, x, y, s);
    };
    for (Index y = 0; y < ny_; ++y) {
      for (Index x = 0; x < nx_; ++x)
        take(x, y, -1, 0), take(x, y, 0, -1), take(x, y, -1, -1), take(x, y, 1, -1);
      for (Index x = nx_; x-- > 0;)
        take(x, y, 1, 0);
    }
    for (Index y = ny_; y-- > 0;) {
      for (Index x = nx_; x-- > 0;)
        take(x, y, 1, 0), take(x, y, 0, 1), take(x, y, 1, 1), take(x, y, -1, 1);
      for (Index x = 0; x < nx_; ++x)
        take(x, y, -1, 0);
    }
  }

  /// Nodes with a winding number other than 0, row by row.
  void negate_inside(const Segment_set& set, std::size_t number_of_border_segments)
  {
    std::vector<std::vector<std::pair<double, int>>> crossings(ny_);
    for (std::size_t s = 0; s < number_of_border_segments && s < set.segments.size(); ++s) {
      Vec2 a = set.points[set.segments[s][0]], b = set.points[set.segments[s][1]];
      const int sign = a.y <= b.y ? 1 : -1;
      if (sign < 0)
        std::swap(a, b);
      const double first = std::ceil((a.y - origin_.y) / cell_), last = (b.y - origin_.y) / cell_;
      for (double row = std::max(0.0, first); row < last && row < ny_; ++row) {
        const double t = std::clamp((origin_.y + row * cell_ - a.y) / (b.y - a.y), 0.0, 1.0);
        crossings[static_cast<std::size_t>(row)].emplace_back(a.x + t * (b.x - a.x), sign);
      }
    }
    for (Index y = 0; y < ny_; ++y) {
      auto& row = crossings[y];
      std::sort(row.begin(), row.end());
      int winding = 0;
      std::size_t k = 0;
      for (Index x = 0; x < nx_; ++x) {
        for (; k < row.size() && row[k].first < origin_.x + x * cell_; ++k)
          winding += row[k].second;
        if (winding != 0)
          distance_[std::size_t(y) * nx_ + x] *= -1;
      }
    }
  }

  void negate_triangle(const std::array<Vec2, 3>& t)
  {
    const auto index = [&](double v, Index n) {
      return static_cast<Index>(std::clamp(v / cell_, 0.0, double(n - 1)));
    };
    const Index x0 = index(std::min({t[0].x, t[1].x, t[2].x}) - origin_.x, nx_),
                x1 = index(std::max({t[0].x, t[1].x, t[2].x}) - origin_.x, nx_),
                y0 = index(std::min({t[0].y, t[1].y, t[2].y}) - origin_.y, ny_),
                y1 = index(std::max({t[0].y, t[1].y, t[2].y}) - origin_.y, ny_);
    for (Index y = y0; y <= y1; ++y)
      for (Index x = x0; x <= x1; ++x) {
        const Vec2 p = node(x, y);
        const double a = cross(t[1] - t[0], p - t[0]), b = cross(t[2] - t[1], p - t[1]),
                     c = cross(t[0] - t[2], p - t[2]);
        float& d = distance_[std::size_t(y) * nx_ + x];
        if ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0))
          d = -std::abs(d);
      }
  }

  Vec2 origin_;
  double cell_ = 1, nodes_per_unit_ = 1, pad_ = 0;
  Index nx_ = 0, ny_ = 0;
  std::vector<float> distance_;
  std::vector<Index> nearest_;
};

} // namespace Atlas::internal

#endif
