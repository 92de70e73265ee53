// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_READ_IMAGE_IMPL_H
#define ATLAS_IMAGE_INTERNAL_READ_IMAGE_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/Image.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/image/internal/image_of.h>

#include <tiny_gltf.h>

namespace Atlas {

ATLAS_INLINE Image decode_image(std::string_view bytes, const std::string& name)
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

ATLAS_INLINE Image read_image(const std::filesystem::path& path)
{
  return decode_image(internal::read_whole_file(path), path.string());
}

} // namespace Atlas

#endif
