// SPDX-License-Identifier: MIT
// The two ways to write a component of a colour in [0, 1]: as light, and as pictures have it (sRGB, IEC
// 61966-2-1).
#ifndef ATLAS_IMAGE_INTERNAL_SRGB_H
#define ATLAS_IMAGE_INTERNAL_SRGB_H

#include <algorithm>
#include <cmath>

namespace Atlas::internal {

inline double encoded_srgb(double light)
{
  light = std::clamp(light, 0.0, 1.0);
  return light == 1 ? 1 : light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

inline double decoded_srgb(double value)
{
  value = std::clamp(value, 0.0, 1.0);
  return value == 1 ? 1 : value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

} // namespace Atlas::internal

#endif
