// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_IMAGE_FILES_H
#define ATLAS_IMAGE_IMAGE_FILES_H

#include <Atlas/core/errors.h>
#include <Atlas/image/Image.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace Atlas {

/// \brief The bytes of a PNG file.
/// \throw IO_error the picture is empty or too large for PNG
std::string png_bytes(const Image& image);

/// \brief Writes a PNG file, whole or not at all.
/// \throw IO_error
void write_png(const std::filesystem::path& path, const Image& image);

/// \brief Decodes a picture: PNG, JPEG, BMP, TGA or GIF. Alpha is left out.
/// \param name  for the message
/// \throw IO_error
Image decode_image(std::string_view bytes, const std::string& name);

/// \brief Reads a picture. See `decode_image()`. \throw IO_error
Image read_image(const std::filesystem::path& path);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/image/internal/read_image_impl.h>
#include <Atlas/image/internal/write_png_impl.h>
#endif

#endif
