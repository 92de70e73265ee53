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
#include <vector>

namespace Atlas {

ATLAS_INLINE std::string png_bytes(const Image& image)
{
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(image.width);
  description.height = static_cast<png_uint_32>(image.height);
  description.format = image.alpha.empty() ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> mixed;
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    mixed.insert(mixed.end(), image.pixels[i].begin(), image.pixels[i].end());
    mixed.push_back(image.alpha[i]);
  }
  const void* const rows = image.alpha.empty() ? static_cast<const void*>(image.pixels.data()) : mixed.data();
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&description, bytes.data(), &size, 0, rows, 0, nullptr))
    throw IO_error(std::string("cannot encode the picture as PNG: ") + description.message);
  bytes.resize(size);
  return bytes;
}

ATLAS_INLINE void write_png(const std::filesystem::path& path, const Image& image)
{
  internal::write_whole_file(path, png_bytes(image));
}

} // namespace Atlas

#endif
