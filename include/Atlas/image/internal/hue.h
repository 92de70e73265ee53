// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_HUE_H
#define ATLAS_IMAGE_INTERNAL_HUE_H

#include <Atlas/image/Image.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace Atlas::internal {

/// The colour of a hue (periodic with period 1), saturation and value in [0, 1].
inline Color color_of_hue(double hue, double saturation, double value)
{
  Color color;
  for (int k = 0; k < 3; ++k) {
    const double phase = std::fmod(hue + (3 - k) / 3.0, 1.0) * 6;
    const double c = std::clamp(std::abs(phase - 3) - 1, 0.0, 1.0);
    color[k] = static_cast<std::uint8_t>(std::lround(255 * value * (1 - saturation * (1 - c))));
  }
  return color;
}

/// A colour for the i-th chart: neighbours in number are far apart in hue.
inline Color color_of_chart(std::size_t i)
{
  const double step = static_cast<double>(i);
  return color_of_hue(std::fmod(0.58 + 0.61803398874989485 * step, 1.0),
                      0.34 + 0.10 * static_cast<double>(i % 3), 0.93 - 0.09 * static_cast<double>(i / 3 % 3));
}

} // namespace Atlas::internal

#endif
