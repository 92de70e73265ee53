// SPDX-License-Identifier: MIT
// The option --texture-size, which the programs share.
#ifndef READ_PAGE_SIZE_H
#define READ_PAGE_SIZE_H

#include <Atlas/core/Packing.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <string>
#include <string_view>

/// The largest side of a page.
inline constexpr Atlas::Index max_page_side = 65536;

/// Reads "1024" or "1024x512", the width first, in texels.
inline void read_page_size(const std::string& text, Atlas::Index& width, Atlas::Index& height)
{
  const auto read_side = [&](std::string_view digits, Atlas::Index& side) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), side);
    if (error != std::errc() || end != digits.data() + digits.size() || side == 0 || side > max_page_side)
      throw CLI::ValidationError("--texture-size", "'" + text + "' is neither a number of texels nor " +
                                                       "WIDTHxHEIGHT, from 1 to " +
                                                       std::to_string(max_page_side));
  };
  const std::size_t x = text.find('x');
  read_side(std::string_view(text).substr(0, x), width);
  height = width;
  if (x != std::string::npos)
    read_side(std::string_view(text).substr(x + 1), height);
}

#endif
