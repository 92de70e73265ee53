// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_TEXT_BYTES_H
#define ATLAS_IMAGE_INTERNAL_TEXT_BYTES_H

#include <Atlas/core/errors.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace Atlas::internal {

/// How many bytes the UTF-8 character at the front has; 0 if the bytes are none, or a control character.
inline std::size_t length_of_character(std::string_view bytes)
{
  const auto first = static_cast<unsigned char>(bytes.front());
  if (first < 0x80)
    return first >= 32 && first != 127 ? 1 : 0;
  const std::size_t length = first >= 0xF0 && first < 0xF5   ? 4
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xC2 && first < 0xE0 ? 2
                                                             : 0;
  if (bytes.size() < length)
    return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(bytes[i]) & 0xC0) != 0x80)
      return 0;
  return length;
}

/// Bytes as they may be shown on a terminal: what is no text is written as \xHH.
inline std::string printable(std::string_view bytes)
{
  constexpr const char* digits = "0123456789ABCDEF";
  std::string result;
  while (!bytes.empty()) {
    const std::size_t length = length_of_character(bytes);
    const auto byte = static_cast<unsigned char>(bytes.front());
    if (length > 0)
      result += bytes.substr(0, length);
    else
      result += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    bytes.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

/// Appends a character as UTF-8.
inline void append_character(std::string& text, unsigned long code)
{
  const auto put = [&](unsigned long byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (code < 0x80) {
    put(code);
    return;
  }
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  put((more == 1 ? 0xC0u : more == 2 ? 0xE0u : 0xF0u) | code >> (6 * more));
  for (int i = more - 1; i >= 0; --i)
    put(0x80u | (code >> (6 * i) & 0x3F));
}

/// UTF-16 as UTF-8; halves of pairs that stand alone become U+FFFD.
inline std::string utf8_of_utf16(std::string_view bytes, bool is_big_endian)
{
  std::string text;
  text.reserve(bytes.size() / 2);
  const auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]), b = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<unsigned long>(is_big_endian ? a << 8 | b : b << 8 | a);
  };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    unsigned long code = unit(i);
    if (code >= 0xD800 && code < 0xDC00 && i + 3 < bytes.size() && (unit(i + 2) & 0xFC00) == 0xDC00) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(i + 2) - 0xDC00);
      i += 2;
    }
    append_character(text, code >= 0xD800 && code < 0xE000 ? 0xFFFD : code);
  }
  return text;
}

/// \brief The text of a file in UTF-8: UTF-16, with a byte order mark or begun with a character of ASCII, is
/// converted; zero bytes, with which some programs pad, become blanks.
///
/// \throw IO_error naming line and byte, if more than one byte of a hundred is a control character, as no
/// text has them
inline std::string decoded_text(std::string bytes, const std::string& file_name)
{
  const auto is_zero = [&](std::size_t i) { return i < bytes.size() && bytes[i] == '\0'; };
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    bytes = utf8_of_utf16(std::string_view(bytes).substr(2), bytes[0] == '\xFE');
  else if (bytes.size() >= 4 && is_zero(0) != is_zero(1) && is_zero(0) == is_zero(2) &&
           is_zero(1) == is_zero(3))
    bytes = utf8_of_utf16(bytes, is_zero(0));
  while (!bytes.empty() && bytes.back() == '\0')
    bytes.pop_back();
  const auto is_control = [](char c) {
    return static_cast<unsigned char>(c) < 32 && !(c >= '\t' && c <= '\r') && c != '\x1A'; // the old end mark
  };
  const auto count = std::count_if(bytes.begin(), bytes.end(), is_control);
  if (static_cast<std::size_t>(count) > 2 + bytes.size() / 100) {
    const auto at = std::find_if(bytes.begin(), bytes.end(), is_control);
    throw IO_error(file_name + ":" + std::to_string(1 + std::count(bytes.begin(), at, '\n')) +
                   ": not a text file (byte " + std::to_string(static_cast<unsigned char>(*at)) +
                   " at offset " + std::to_string(at - bytes.begin()) + ")");
  }
  std::replace(bytes.begin(), bytes.end(), '\0', ' ');
  return bytes;
}

} // namespace Atlas::internal

#endif
