// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_READ_IMAGE_H
#define ATLAS_IMAGE_READ_IMAGE_H

#include <Atlas/image/IO_error.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/internal/Text_scanner.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <tiny_gltf.h>

namespace Atlas {

namespace internal {

/// The colours of a decoded picture; alpha is left out. An empty picture if it is of another kind.
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
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned char* const p = &decoded.image[(i * components + (components < 3 ? 0 : k)) * bytes];
      std::uint16_t wide = 0;
      if (bytes == 2)
        std::memcpy(&wide, p, sizeof wide);
      image.pixels[i][k] = bytes == 2 ? static_cast<std::uint8_t>(wide / 257) : *p;
    }
  return image;
}

} // namespace internal

/// \brief Decodes a picture: PNG, JPEG, BMP, TGA or GIF. Needs the library tinygltf, which has a decoder.
/// \param name for the message \throw IO_error
inline Image decode_image(std::string_view bytes, const std::string& name)
{
  tinygltf::Image decoded;
  std::string error, warning;
  Image image;
  if (tinygltf::LoadImageData(&decoded, 0, &error, &warning, 0, 0,
                              reinterpret_cast<const unsigned char*>(bytes.data()),
                              static_cast<int>(bytes.size()), nullptr))
    image = internal::image_of(decoded);
  if (image.pixels.empty())
    throw IO_error(name + ": not a picture that can be read (PNG, JPEG, BMP, TGA, GIF)");
  return image;
}

/// \brief Reads a picture. See `decode_image()`. \throw IO_error
inline Image read_image(const std::filesystem::path& path)
{
  return decode_image(internal::read_whole_file(path), path.string());
}

} // namespace Atlas

#endif
