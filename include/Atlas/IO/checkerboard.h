// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_CHECKERBOARD_H
#define ATLAS_IO_CHECKERBOARD_H

#include <Atlas/IO/Image.h>
#include <Atlas/IO/internal/hue.h>

#include <cstddef>

namespace Atlas {

/// \brief A texture that shows distortion: squares that alternate between light and dark, whose colour
/// changes slowly over the page, so that charts can be told apart and found on the page. \param size pixels a
/// side; \param squares number of squares a side
inline Image checkerboard(std::size_t size, std::size_t squares = 64)
{
  Image image(size, size);
  for (std::size_t y = 0; y < size; ++y)
    for (std::size_t x = 0; x < size; ++x) {
      const std::size_t i = x * squares / size, j = y * squares / size;
      const double hue =
          0.08 + 0.85 * (static_cast<double>(i) + static_cast<double>(j)) / static_cast<double>(2 * squares);
      image.at(x, y) =
          (i + j) % 2 ? internal::color_of_hue(hue, 0.10, 0.98) : internal::color_of_hue(hue, 0.60, 0.72);
    }
  return image;
}

} // namespace Atlas

#endif
