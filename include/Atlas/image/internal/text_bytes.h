// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_TEXT_BYTES_H
#define ATLAS_IMAGE_INTERNAL_TEXT_BYTES_H

#include <Atlas/core/errors.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

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

/// UTF-32 as UTF-8; what is no character becomes U+FFFD.
inline std::string utf8_of_utf32(std::string_view bytes, bool is_big_endian)
{
  std::string text;
  text.reserve(bytes.size() / 4);
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
    unsigned long code = 0;
    for (std::size_t k = 0; k < 4; ++k)
      code = code << 8 | static_cast<unsigned char>(bytes[i + (is_big_endian ? k : 3 - k)]);
    append_character(text, code >= 0x110000 || (code >= 0xD800 && code < 0xE000) ? 0xFFFD : code);
  }
  return text;
}

/// Bytes in UTF-16 or UTF-32, with a byte order mark or begun with a character of ASCII, as UTF-8; others
/// stay.
inline std::string utf8_of_any(std::string bytes)
{
  using namespace std::string_view_literals;
  const auto ascii_at = [&](std::size_t place, std::size_t width) { // all other bytes are zero
    for (std::size_t i = 0; i < 4; ++i)
      if ((bytes[i] != '\0') != (i % width == place))
        return false;
    return true;
  };
  if (bytes.size() < 4)
    return bytes;
  for (const bool is_big : {false, true})
    if (bytes.starts_with(is_big ? "\0\0\xFE\xFF"sv : "\xFF\xFE\0\0"sv))
      return utf8_of_utf32(std::string_view(bytes).substr(4), is_big);
    else if (ascii_at(is_big ? 3 : 0, 4))
      return utf8_of_utf32(bytes, is_big);
  for (const bool is_big : {false, true})
    if (bytes.starts_with(is_big ? "\xFE\xFF"sv : "\xFF\xFE"sv))
      return utf8_of_utf16(std::string_view(bytes).substr(2), is_big);
    else if (ascii_at(is_big ? 1 : 0, 2))
      return utf8_of_utf16(bytes, is_big);
  return bytes;
}

/// Zero bytes with which some programs pad, at the ends of lines or in runs, become blanks.
inline void blank_padding(std::string& bytes)
{
  const auto is_line_end = [](char c) { return c == '\n' || c == '\r'; };
  for (std::size_t begin = bytes.find('\0'); begin != std::string::npos; begin = bytes.find('\0', begin)) {
    const std::size_t end = std::min(bytes.find_first_not_of('\0', begin), bytes.size());
    if (begin == 0 || end == bytes.size() || is_line_end(bytes[begin - 1]) || is_line_end(bytes[end]))
      std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                bytes.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    begin = end;
  }
}

/// \brief The text of a file in UTF-8. See `utf8_of_any()` and `blank_padding()`; other zero bytes become
/// blanks, too, and so does the old mark of the end.
///
/// \throw IO_error naming line and byte, if more than one byte of a hundred is a control character, as no
/// text has them
inline std::string decoded_text(std::string bytes, const std::string& file_name)
{
  bytes = utf8_of_any(std::move(bytes));
  blank_padding(bytes);
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
  for (char& c : bytes)
    if (c == '\0' || c == '\x1A')
      c = ' ';
  return bytes;
}

} // namespace Atlas::internal

#endif
