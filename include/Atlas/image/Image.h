// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_IMAGE_H
#define ATLAS_IMAGE_IMAGE_H

#include <Atlas/core/errors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace Atlas {

/// Red, green, blue in [0, 255].
using Color = std::array<std::uint8_t, 3>;

/// \brief How large a picture or a page is, in pixels or texels. One number stands for a square.
struct Image_size
{
  /// In pixels.
  std::size_t width = 0, height = 0; ///< in pixels

  /// A square.
  Image_size(std::size_t side) : width(side), height(side) {}
  /// Width and height.
  Image_size(std::size_t w, std::size_t h) : width(w), height(h) {}

  /// The larger of width and height.
  std::size_t longer_side() const { return std::max(width, height); }

  /// The same shape with a longer side of so many pixels; none has less than one.
  Image_size with_longer_side(std::size_t side) const
  {
    const std::size_t longer = std::max<std::size_t>(longer_side(), 1);
    const auto scaled = [&](std::size_t n) {
      return std::max<std::size_t>((2 * n * side + longer) / (2 * longer), 1);
    };
    return {scaled(width), scaled(height)};
  }
};

/// \brief A picture of 8-bit colours; the first row is the top one.
struct Image
{
  /// In pixels.
  std::size_t width = 0, height = 0; ///< in pixels
  std::vector<Color> pixels;         ///< row by row
  std::vector<std::uint8_t> alpha;   ///< per pixel, 0 is transparent; colours are not multiplied by it; or
                                     ///< empty: opaque

  Image() = default;
  /// A picture of one colour.
  Image(std::size_t w, std::size_t h, const Color& background = {255, 255, 255})
      : width(w), height(h), pixels(w * h, background)
  {}

  /// A pixel; the first row is on top.
  Color& at(std::size_t x, std::size_t y) { return pixels[y * width + x]; }
  /// A pixel; the first row is on top.
  const Color& at(std::size_t x, std::size_t y) const { return pixels[y * width + x]; }
  /// The opacity of a pixel, 255 where the picture has none.
  std::uint8_t alpha_at(std::size_t x, std::size_t y) const
  {
    return alpha.empty() ? 255 : alpha[y * width + x];
  }
};

/// The picture at half the size, every pixel the mean of four, weighted by alpha where it is not 0 for all of
/// them. The last row and column of odd sizes are left out; a side of one pixel stays.
inline Image halved(const Image& image)
{
  const auto half = [](std::size_t n) { return n == 1 ? 1 : n / 2; };
  Image result(half(image.width), half(image.height));
  for (std::size_t y = 0; y < result.height; ++y)
    for (std::size_t x = 0; x < result.width; ++x) {
      const std::size_t right = std::min(2 * x + 1, image.width - 1),
                        below = std::min(2 * y + 1, image.height - 1);
      const std::array<std::array<std::size_t, 2>, 4> four = {
          {{2 * x, 2 * y}, {right, 2 * y}, {2 * x, below}, {right, below}}};
      unsigned opacity = 0;
      for (const auto& [i, j] : four)
        opacity += image.alpha_at(i, j);
      const unsigned total = opacity > 0 ? opacity : 4;
      for (std::size_t k = 0; k < 3; ++k) {
        unsigned sum = total / 2;
        for (const auto& [i, j] : four)
          sum += (opacity > 0 ? image.alpha_at(i, j) : 1u) * image.at(i, j)[k];
        result.at(x, y)[k] = static_cast<std::uint8_t>(sum / total);
      }
      if (!image.alpha.empty())
        result.alpha.push_back(static_cast<std::uint8_t>((opacity + 2) / 4));
    }
  return result;
}

/// Copies a picture into another, with its top left corner at (x, y); what sticks out is left out.
inline void paste(const Image& from, Image& to, std::size_t x, std::size_t y)
{
  for (std::size_t j = 0; j < from.height && y + j < to.height; ++j)
    for (std::size_t i = 0; i < from.width && x + i < to.width; ++i)
      to.at(x + i, y + j) = from.at(i, j);
}

/// \brief A texture that shows distortion: squares that alternate between light and dark, whose colour
/// changes slowly over the page, so that charts can be told apart and found on the page.
/// \param squares  number of squares along the longer side, at least 1
Image checkerboard(Image_size size, std::size_t squares = 64);

/// \brief The bytes of a PNG file, with alpha where the picture has it.
/// \throw IO_error the picture is empty or too large for PNG
std::string png_bytes(const Image& image);

/// \brief The bytes of a grey PNG file of 16 bits, linear: for heights and the like.
/// \param pixels  row by row, the top one first; as many as the size has
/// \throw Invalid_argument there are more or less
/// \throw IO_error the picture is empty or too large for PNG
std::string png_bytes(std::span<const std::uint16_t> pixels, Image_size size);

/// \brief Writes a PNG file, whole or not at all.
/// \throw IO_error
void write_png(const std::filesystem::path& path, const Image& image);

/// \brief Decodes a picture: PNG, JPEG, BMP, TGA or GIF.
/// \param name  for the message
/// \throw IO_error
Image decode_image(std::string_view bytes, const std::string& name);

/// \brief Reads a picture. See `decode_image()`. \throw IO_error
Image read_image(const std::filesystem::path& path);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/image/internal/checkerboard_impl.h>
#include <Atlas/image/internal/read_image_impl.h>
#include <Atlas/image/internal/write_png_impl.h>
#endif

#endif
