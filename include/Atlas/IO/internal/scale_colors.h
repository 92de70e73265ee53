// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_SCALE_COLORS_H
#define ATLAS_IO_INTERNAL_SCALE_COLORS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// Stands for a colour that the file does not tell, and the number for an alpha that it does not tell.
inline constexpr float untold = -1;
inline constexpr std::array<float, 4> untold_color{untold, untold, untold, untold};

/// Brings the colours of a file into [0, 1]. They are in [0, 255] where one number is larger than 1; an alpha
/// of [0, 1] is one beside such numbers, too. Colours that the file does not tell become white, alphas 1.
inline void scale_colors(std::vector<std::array<float, 4>>& colors)
{
  float largest = 0;
  for (const auto& [r, g, b, a] : colors)
    largest = std::max({largest, r, g, b, a});
  for (auto& color : colors) {
    if (color == untold_color)
      color = {1, 1, 1, 1};
    else
      for (std::size_t k = 0; k < 4 && largest > 1; ++k)
        color[k] = k < 3 || color[k] > 1 ? color[k] / 255 : color[k];
    if (color[3] == untold)
      color[3] = 1;
  }
}

} // namespace Atlas::internal

#endif
