// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_IMAGE_OF_H
#define ATLAS_IMAGE_INTERNAL_IMAGE_OF_H

#include <Atlas/image/Image.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tiny_gltf.h>

namespace Atlas::internal {

/// A decoded picture; without alpha if all of it is opaque. An empty picture if it is of another kind.
inline Image image_of(const tinygltf::Image& decoded)
{
  if (decoded.width <= 0 || decoded.height <= 0 || decoded.component <= 0 ||
      (decoded.bits != 8 && decoded.bits != 16))
    return Image();
  Image image(static_cast<std::size_t>(decoded.width), static_cast<std::size_t>(decoded.height));
  const auto components = static_cast<std::size_t>(decoded.component);
  const std::size_t bytes = static_cast<std::size_t>(decoded.bits) / 8;
  if (decoded.image.size() < image.pixels.size() * components * bytes)
    return Image();
  const auto value = [&](std::size_t pixel, std::size_t component) {
    const unsigned char* const p = &decoded.image[(pixel * components + component) * bytes];
    std::uint16_t wide = 0;
    if (bytes == 2)
      std::memcpy(&wide, p, sizeof wide);
    return bytes == 2 ? static_cast<std::uint8_t>(wide / 257) : *p;
  };
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      image.pixels[i][k] = value(i, components < 3 ? 0 : k);
  if (components % 2 == 0) // grey or colours, with alpha
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      image.alpha.push_back(value(i, components - 1));
  if (std::all_of(image.alpha.begin(), image.alpha.end(), [](std::uint8_t a) { return a == 255; }))
    image.alpha.clear();
  return image;
}

} // namespace Atlas::internal

#endif
