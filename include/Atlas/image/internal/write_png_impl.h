// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_WRITE_PNG_IMPL_H
#define ATLAS_IMAGE_INTERNAL_WRITE_PNG_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/internal/Output_file.h>

#include <cstddef>
#include <cstdint>
#include <png.h>
#include <span>
#include <string>
#include <vector>

namespace Atlas {

namespace internal {

/// \param format  of libpng
inline std::string png_bytes_of(const void* pixels, Image_size size, std::uint32_t format)
{
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(size.width);
  description.height = static_cast<png_uint_32>(size.height);
  description.format = format;
  png_alloc_size_t length = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::string bytes(length, '\0');
  if (!png_image_write_to_memory(&description, bytes.data(), &length, 0, pixels, 0, nullptr))
    throw IO_error(std::string("cannot encode the picture as PNG: ") + description.message);
  bytes.resize(length);
  return bytes;
}

} // namespace internal

ATLAS_INLINE std::string png_bytes(const Image& image)
{
  const Image_size size(image.width, image.height);
  if (image.alpha.empty())
    return internal::png_bytes_of(image.pixels.data(), size, PNG_FORMAT_RGB);
  std::vector<std::uint8_t> mixed;
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    mixed.insert(mixed.end(), image.pixels[i].begin(), image.pixels[i].end());
    mixed.push_back(image.alpha[i]);
  }
  return internal::png_bytes_of(mixed.data(), size, PNG_FORMAT_RGBA);
}

ATLAS_INLINE std::string png_bytes(std::span<const std::uint16_t> pixels, Image_size size)
{
  internal::require(pixels.size() == size.width * size.height, "pixels", "must be as many as the size has");
  return internal::png_bytes_of(pixels.data(), size, PNG_FORMAT_LINEAR_Y);
}

ATLAS_INLINE void write_png(const std::filesystem::path& path, const Image& image)
{
  internal::write_whole_file(path, png_bytes(image));
}

} // namespace Atlas

#endif
