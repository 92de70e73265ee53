// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_ADD_ALPHA_H
#define ATLAS_IO_INTERNAL_ADD_ALPHA_H

#include <Atlas/image/Image.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace Atlas::internal {

/// Two pixels that a place between centres of pixels is between, and how near it is to the second.
struct Pixel_pair
{
  std::size_t first, second;
  double share;
};

/// Pixel i of n, of a picture that has `size` along this side.
inline Pixel_pair pixel_pair(std::size_t i, std::size_t n, std::size_t size)
{
  const double x =
      std::clamp((static_cast<double>(i) + .5) * static_cast<double>(size) / static_cast<double>(n) - .5, 0.,
                 static_cast<double>(size - 1));
  const auto first = static_cast<std::size_t>(x);
  return {first, std::min(first + 1, size - 1), x - static_cast<double>(first)};
}

/// The picture with as many pixels, interpolated. \pre it has pixels
inline Image resized(const Image& image, Image_size size)
{
  Image result(size.width, size.height);
  for (std::size_t y = 0; y < size.height; ++y)
    for (std::size_t x = 0; x < size.width; ++x) {
      const Pixel_pair h = pixel_pair(x, size.width, image.width),
                       v = pixel_pair(y, size.height, image.height);
      const auto mean = [&](const auto& value) {
        const double upper = (1 - h.share) * value(h.first, v.first) + h.share * value(h.second, v.first),
                     lower = (1 - h.share) * value(h.first, v.second) + h.share * value(h.second, v.second);
        return static_cast<std::uint8_t>(std::lround((1 - v.share) * upper + v.share * lower));
      };
      for (std::size_t k = 0; k < 3; ++k)
        result.at(x, y)[k] = mean([&](std::size_t i, std::size_t j) { return image.at(i, j)[k]; });
      if (!image.alpha.empty())
        result.alpha.push_back(mean([&](std::size_t i, std::size_t j) { return image.alpha_at(i, j); }));
    }
  return result;
}

/// Gives a picture the transparency that is a picture of its own: its alpha, or its brightness. Of two sizes
/// the larger one counts.
inline void add_alpha(Image& image, Image alpha)
{
  if (alpha.pixels.empty())
    return;
  const Image_size size(std::max(image.width, alpha.width), std::max(image.height, alpha.height));
  for (Image* const either : {&image, &alpha})
    if (either->width != size.width || either->height != size.height)
      *either = resized(*either, size);
  image.alpha.clear();
  for (std::size_t i = 0; i < alpha.pixels.size(); ++i)
    image.alpha.push_back(alpha.alpha.empty() ? alpha.pixels[i][0] : alpha.alpha[i]);
}

} // namespace Atlas::internal

#endif
