// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_NUMBER_TEXT_H
#define ATLAS_SOUP_INTERNAL_NUMBER_TEXT_H

#include <charconv>
#include <string>

namespace Atlas::internal {

/// Appends the shortest text that is read back as exactly this number.
template <typename Number>
void append_number(std::string& text, Number value)
{
  char buffer[40];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, end);
}

} // namespace Atlas::internal

#endif
