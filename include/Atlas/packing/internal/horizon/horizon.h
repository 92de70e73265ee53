// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_HORIZON_HORIZON_H
#define ATLAS_PACKING_INTERNAL_HORIZON_HORIZON_H

#include <Atlas/packing/internal/shapes/Outline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// What a horizon packer knows of a chart at one scale: for each column of one texel, the least and the
/// largest height of the chart grown by half the gutter. The grown chart starts at column 0 and height 0.
struct Horizon_shape
{
  std::vector<double> bottom, top;
  double height = 0;
  Vec2 origin; ///< where the outline's centre is

  std::size_t width() const { return bottom.size(); }
};

/// Widens the interval of the columns that the segment from `p` to `q` passes.
inline void sweep_segment(Vec2 p, Vec2 q, std::vector<double>& least, std::vector<double>& largest)
{
  if (p.x > q.x)
    std::swap(p, q);
  const double last = static_cast<double>(least.size() - 1);
  const double slope = q.x > p.x ? (q.y - p.y) / (q.x - p.x) : 0;
  const auto height = [&](double x) {
    return x <= p.x   ? p.y
           : x >= q.x ? q.y
                      : std::clamp(p.y + slope * (x - p.x), std::min(p.y, q.y), std::max(p.y, q.y));
  };
  // A point on the line between two columns belongs to both, so that rounding cannot lose it.
  const double begin = std::clamp(std::ceil(p.x) - 1, 0.0, last);
  const double end = std::clamp(std::floor(q.x), 0.0, last);
  for (double c = begin; c <= end; ++c) {
    const std::size_t i = static_cast<std::size_t>(c);
    double a = height(c), b = height(c + 1);
    if (q.x <= p.x)
      a = p.y, b = q.y;
    least[i] = std::min({least[i], a, b});
    largest[i] = std::max({largest[i], a, b});
  }
}

/// Widens the interval of the columns that the circle about `p` passes.
inline void sweep_circle(Vec2 p, double radius, std::vector<double>& least, std::vector<double>& largest)
{
  const double last = static_cast<double>(least.size() - 1);
  const double begin = std::clamp(std::ceil(p.x - radius) - 1, 0.0, last);
  const double end = std::clamp(std::floor(p.x + radius), 0.0, last);
  for (double c = begin; c <= end; ++c) {
    const std::size_t i = static_cast<std::size_t>(c);
    const double dx = std::clamp(p.x, c, c + 1) - p.x;
    const double h = std::sqrt(std::max(0.0, radius * radius - dx * dx));
    least[i] = std::min(least[i], p.y - h);
    largest[i] = std::max(largest[i], p.y + h);
  }
}

/// The horizons of an outline, turned by `turn`, at a scale, grown by `margin`. The boundary of the grown
/// chart consists of parallels of its segments and circles about their ends.
inline Horizon_shape horizon_shape(const Outline& outline, Vec2 turn, double scale, double margin)
{
  std::vector<Vec2> points(outline.points.size());
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = rotated(scale * turn, outline.points[i]);
    low = {std::min(low.x, points[i].x), std::min(low.y, points[i].y)};
    high = {std::max(high.x, points[i].x), std::max(high.y, points[i].y)};
  }
  Horizon_shape shape;
  shape.origin = Vec2{margin, margin} - low;
  shape.height = high.y - low.y + 2 * margin;
  const std::size_t width = static_cast<std::size_t>(std::max(1.0, std::ceil(high.x - low.x + 2 * margin)));
  shape.bottom.assign(width, HUGE_VAL);
  shape.top.assign(width, -HUGE_VAL);
  for (Vec2& p : points)
    p = p + shape.origin;
  for (const auto& [i, j] : outline.segments) {
    const Vec2 d = points[j] - points[i];
    if (!(length(d) > 0))
      continue;
    const Vec2 n = (margin / length(d)) * Vec2{-d.y, d.x};
    sweep_segment(points[i] + n, points[j] + n, shape.bottom, shape.top);
    sweep_segment(points[i] - n, points[j] - n, shape.bottom, shape.top);
  }
  for (const Vec2& p : points)
    sweep_circle(p, margin, shape.bottom, shape.top);
  // Columns between the parts of a chart that is not connected stay under the chart.
  for (std::size_t i = 0; i < width; ++i)
    if (shape.bottom[i] > shape.top[i]) {
      shape.bottom[i] = shape.height;
      shape.top[i] = 0;
    }
  return shape;
}

/// The bounding box of a shape in place of the shape.
inline void flatten_horizons(Horizon_shape& shape)
{
  shape.bottom.assign(shape.width(), 0.0);
  shape.top.assign(shape.width(), shape.height);
}

/// One page and the horizon of what has been put on it.
class Horizon_page
{
public:
  Horizon_page(Index width, Index height) : height_(height), horizon_(width, 0.0), sums_(width + 1, 0.0) {}

  /// Puts the shape where least space is lost below it, the lowest of equals, then the leftmost. Gives the
  /// place of the lower left corner, if there is one on the page. O(columns of page x columns of shape) at
  /// worst; most columns are ruled out by a bound.
  std::optional<Vec2> insert(const Horizon_shape& shape)
  {
    const std::size_t n = horizon_.size(), w = shape.width();
    if (w > n || shape.height > height_)
      return std::nullopt;
    double bottoms = 0, highest_bottom = 0;
    for (const double b : shape.bottom) {
      bottoms += b;
      highest_bottom = std::max(highest_bottom, b);
    }
    update_windows(w);
    double least_loss = HUGE_VAL, best_y = 0;
    std::size_t best = n;
    const double columns = static_cast<double>(w);
    for (std::size_t u = 0; u + w <= n; ++u) {
      const double gap = bottoms - (sums_[u + w] - sums_[u]);
      double y = std::max(0.0, windows_[u] - highest_bottom);
      // No better than the best if both are equal: so most columns of an empty page are not looked at.
      const double bound = columns * y + gap;
      if (bound > least_loss || (bound == least_loss && y >= best_y) || y + shape.height > height_)
        continue;
      for (std::size_t i = 0; i < w && columns * y + gap <= least_loss;)
        for (const std::size_t end = std::min(w, i + columns_between_looks); i < end; ++i)
          y = std::max(y, horizon_[u + i] - shape.bottom[i]);
      const double loss = columns * y + gap;
      if (y + shape.height <= height_ && (loss < least_loss || (loss == least_loss && y < best_y))) {
        least_loss = loss;
        best_y = y;
        best = u;
      }
    }
    if (best == n)
      return std::nullopt;
    for (std::size_t i = 0; i < w; ++i)
      horizon_[best + i] = std::max(horizon_[best + i], best_y + shape.top[i]);
    for (std::size_t i = best; i < n; ++i)
      sums_[i + 1] = sums_[i] + horizon_[i];
    return Vec2{static_cast<double>(best), best_y};
  }

private:
  /// Columns of a shape that are looked at before it is asked whether the place can still be the best.
  static constexpr std::size_t columns_between_looks = 32;

  /// windows_[u] becomes the maximum of the horizon over [u, u + w). O(columns).
  void update_windows(std::size_t w)
  {
    const std::size_t n = horizon_.size();
    windows_.resize(n);
    falling_.resize(n);
    std::size_t begin = 0, end = 0; // of the queue of columns that are higher than all after them
    for (std::size_t i = 0; i < n; ++i) {
      while (end > begin && horizon_[falling_[end - 1]] <= horizon_[i])
        --end;
      falling_[end++] = i;
      if (falling_[begin] + w <= i)
        ++begin;
      if (i + 1 >= w)
        windows_[i + 1 - w] = horizon_[falling_[begin]];
    }
  }

  double height_;
  std::vector<double> horizon_, sums_, windows_;
  std::vector<std::size_t> falling_;
};

/// One page that is filled in rows from left to right, from the bottom to the top.
class Row_page
{
public:
  Row_page(Index width, Index height) : width_(width), height_(height) {}

  /// Puts the shape at the end of the row, or at the beginning of a new one. Gives the place of the lower
  /// left corner, if there is one on the page. O(1).
  std::optional<Vec2> insert(const Horizon_shape& shape)
  {
    const double w = static_cast<double>(shape.width());
    if (end_ + w > width_) {
      bottom_ += highest_;
      end_ = highest_ = 0;
    }
    if (w > width_ || bottom_ + shape.height > height_)
      return std::nullopt;
    const Vec2 corner{end_, bottom_};
    end_ += w;
    highest_ = std::max(highest_, shape.height);
    return corner;
  }

private:
  double width_, height_;
  double bottom_ = 0, end_ = 0, highest_ = 0; ///< of the last row
};

} // namespace Atlas::internal

#endif
