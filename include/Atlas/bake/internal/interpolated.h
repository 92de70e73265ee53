// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_INTERPOLATED_H
#define ATLAS_BAKE_INTERNAL_INTERPOLATED_H

#include <Atlas/IO/read_polygon_soup.h>
#include <Atlas/core/Kernel.h>
#include <Atlas/image/Image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace Atlas::internal {

/// The pixel that a place on an axis shows.
inline std::size_t wrapped(double i, std::size_t size, Texture_wrap wrap)
{
  const auto n = static_cast<double>(size);
  switch (wrap) {
  case Texture_wrap::repeat:
    i -= n * std::floor(i / n);
    break;
  case Texture_wrap::mirror:
    i -= 2 * n * std::floor(i / (2 * n));
    i = i < n ? i : 2 * n - 1 - i;
    break;
  case Texture_wrap::clamp:
    break;
  }
  return static_cast<std::size_t>(std::clamp(i, 0.0, n - 1));
}

/// The colour and alpha of a picture between its pixels, interpolated from the four around; components in
/// [0, 255]. What cannot be seen has no share in the colour. \pre the picture is not empty, the place finite
inline std::array<double, 4> interpolated(const Image& image, const Point_2& uv,
                                          Texture_wrap wrap_u = Texture_wrap::repeat,
                                          Texture_wrap wrap_v = Texture_wrap::repeat)
{
  const double x = uv.x() * static_cast<double>(image.width) - 0.5,
               y = (1 - uv.y()) * static_cast<double>(image.height) - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  std::array<double, 4> sum{}, plain{};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double weight = (i ? x - left : left + 1 - x) * (j ? y - top : top + 1 - y);
      const std::size_t column = wrapped(left + i, image.width, wrap_u),
                        row = wrapped(top + j, image.height, wrap_v);
      const Color& color = image.at(column, row);
      const double alpha = image.alpha_at(column, row);
      for (std::size_t k = 0; k < 3; ++k) {
        plain[k] += weight * color[k];
        sum[k] += weight * alpha * color[k];
      }
      sum[3] += weight * alpha;
    }
  for (std::size_t k = 0; k < 3; ++k)
    sum[k] = image.alpha.empty() || sum[3] == 0 ? plain[k] : sum[k] / sum[3];
  return sum;
}

} // namespace Atlas::internal

#endif
