// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_COLOR_SCALE_H
#define ATLAS_IMAGE_INTERNAL_COLOR_SCALE_H

#include <Atlas/image/Image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace Atlas::internal {

/// A scale from calm blue over yellow to alarming red, for t in [0, 1].
inline Color color_of_heat(double t)
{
  constexpr double stops[][3] = {{54, 92, 168},   {98, 168, 204}, {222, 240, 206},
                                 {252, 202, 104}, {232, 98, 58},  {150, 10, 30}};
  constexpr std::size_t last = std::size(stops) - 1;
  const double x = std::clamp(t, 0.0, 1.0) * static_cast<double>(last);
  const std::size_t i = std::min(static_cast<std::size_t>(x), last - 1);
  Color color;
  for (std::size_t k = 0; k < 3; ++k)
    color[k] = static_cast<std::uint8_t>(
        std::lround(stops[i][k] + (x - static_cast<double>(i)) * (stops[i + 1][k] - stops[i][k])));
  return color;
}

/// The rows, from the top, of 3 x 5 pixels of a digit; a full stop for all other characters.
inline std::array<int, 5> glyph(char c)
{
  constexpr std::array<int, 5> digits[] = {{7, 5, 5, 5, 7}, {2, 6, 2, 2, 7}, {7, 1, 7, 4, 7}, {7, 1, 7, 1, 7},
                                           {5, 5, 7, 1, 1}, {7, 4, 7, 1, 7}, {7, 4, 7, 5, 7}, {7, 1, 1, 1, 1},
                                           {7, 5, 7, 5, 7}, {7, 5, 7, 1, 7}};
  return c >= '0' && c <= '9' ? digits[c - '0'] : std::array<int, 5>{0, 0, 0, 0, 2};
}

/// Writes a number at (x, y), its top left corner, every dot of the glyphs `scale` pixels wide.
inline void draw_number(Image& image, std::string_view text, std::size_t x, std::size_t y, std::size_t scale)
{
  for (const char c : text) {
    const std::array<int, 5> rows = glyph(c);
    for (std::size_t j = 0; j < 5 * scale; ++j)
      for (std::size_t i = 0; i < 3 * scale; ++i)
        if (rows[j / scale] >> (2 - i / scale) & 1 && x + i < image.width && y + j < image.height)
          image.at(x + i, y + j) = {40, 40, 48};
    x += 4 * scale;
  }
}

} // namespace Atlas::internal

#endif
