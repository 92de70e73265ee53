// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_CHECKERBOARD_H
#define ATLAS_IMAGE_CHECKERBOARD_H

#include <Atlas/image/Image.h>
#include <Atlas/image/internal/hue.h>

#include <cstddef>

namespace Atlas {

/// \brief A texture that shows distortion: squares that alternate between light and dark, whose colour
/// changes slowly over the page, so that charts can be told apart and found on the page. \param squares
/// number of squares along the longer side
inline Image checkerboard(Image_size size, std::size_t squares = 64)
{
  Image image(size.width, size.height);
  const std::size_t side = size.longer_side();
  for (std::size_t y = 0; y < size.height; ++y)
    for (std::size_t x = 0; x < size.width; ++x) {
      const std::size_t i = x * squares / side, j = y * squares / side;
      const double hue =
          0.08 + 0.85 * (static_cast<double>(i) + static_cast<double>(j)) / static_cast<double>(2 * squares);
      image.at(x, y) =
          (i + j) % 2 ? internal::color_of_hue(hue, 0.10, 0.98) : internal::color_of_hue(hue, 0.60, 0.72);
    }
  return image;
}

} // namespace Atlas

#endif
