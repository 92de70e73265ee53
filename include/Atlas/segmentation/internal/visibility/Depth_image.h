// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_VISIBILITY_DEPTH_IMAGE_H
#define ATLAS_SEGMENTATION_INTERNAL_VISIBILITY_DEPTH_IMAGE_H

#include <Atlas/core/Surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace Atlas::internal {

/// \brief What is in front when triangles are seen from one side: a depth buffer.
///
/// Pixels are unit squares; a triangle covers those whose centres are in it. Larger depths are nearer to the
/// viewer.
class Depth_image
{
public:
  using Place = std::array<double, 3>; ///< x and y in pixels, and depth

  explicit Depth_image(int side)
      : side_(side), depth_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                            -std::numeric_limits<float>::infinity())
  {}

  /// Each row of pixels is crossed along one interval: O(rows + pixels).
  void draw(const Place& a, const Place& b, const Place& c)
  {
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (!(std::abs(area) > 0))
      return;
    const double slope_x = ((b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1])) / area,
                 slope_y = ((c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0])) / area;
    const auto [low, high] = std::minmax({a[1], b[1], c[1]});
    for (int row = first_centre(low); row <= last_centre(high); ++row) {
      const double y = row + 0.5;
      double left = std::numeric_limits<double>::infinity(), right = -left;
      for (const auto& [p, q] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
        if (std::min(p[1], q[1]) <= y && y <= std::max(p[1], q[1]) && p[1] != q[1]) {
          const double x = p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
          left = std::min(left, x);
          right = std::max(right, x);
        }
      for (int column = first_centre(left); column <= last_centre(right); ++column) {
        float& depth = depth_[index(column, row)];
        const double x = column + 0.5;
        depth = std::max(depth, static_cast<float>(a[2] + slope_x * (x - a[0]) + slope_y * (y - a[1])));
      }
    }
  }

  /// The depth in the pixel around a place; minus infinity where nothing is.
  float depth_at(const Place& p) const
  {
    const double last = side_;
    if (!(p[0] >= 0 && p[1] >= 0 && p[0] < last && p[1] < last))
      return -std::numeric_limits<float>::infinity();
    return depth_[index(static_cast<int>(p[0]), static_cast<int>(p[1]))];
  }

private:
  /// The pixels of the image whose centres lie between two places.
  int first_centre(double low) const
  {
    return static_cast<int>(std::ceil(std::clamp(low - 0.5, 0., 1. * side_)));
  }
  int last_centre(double high) const
  {
    return static_cast<int>(std::floor(std::clamp(high - 0.5, -1., side_ - 1.)));
  }
  std::size_t index(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(column);
  }

  int side_;
  std::vector<float> depth_;
};

} // namespace Atlas::internal

#endif
