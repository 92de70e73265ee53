// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_BASE64_H
#define ATLAS_IMAGE_INTERNAL_BASE64_H

#include <cstddef>
#include <string>
#include <string_view>

namespace Atlas::internal {

/// Bytes as text, RFC 4648.
inline std::string base64(std::string_view bytes)
{
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned block = 0;
    for (std::size_t k = 0; k < 3; ++k)
      block = block << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= bytes.size() - i ? letters[block >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

} // namespace Atlas::internal

#endif
