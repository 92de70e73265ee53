// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_CHECKERBOARD_IMPL_H
#define ATLAS_IMAGE_INTERNAL_CHECKERBOARD_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/internal/hue.h>

#include <cstddef>
#include <vector>

namespace Atlas {

ATLAS_INLINE Image checkerboard(Image_size size, std::size_t squares)
{
  Image image(size.width, size.height);
  const std::size_t side = size.longer_side();
  std::vector<Color> colors; // of the squares of each diagonal
  for (std::size_t k = 0; k <= 2 * squares; ++k) {
    const double hue = 0.08 + 0.85 * static_cast<double>(k) / static_cast<double>(2 * squares);
    colors.push_back(k % 2 ? internal::color_of_hue(hue, 0.10, 0.98)
                           : internal::color_of_hue(hue, 0.60, 0.72));
  }
  for (std::size_t y = 0; y < size.height; ++y)
    for (std::size_t x = 0; x < size.width; ++x)
      image.at(x, y) = colors[x * squares / side + y * squares / side];
  return image;
}

} // namespace Atlas

#endif
