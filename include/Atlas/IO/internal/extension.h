// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_EXTENSION_H
#define ATLAS_IO_INTERNAL_EXTENSION_H

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>

namespace Atlas::internal {

/// A word with small letters in the place of capitals.
inline std::string lower_case(std::string_view word)
{
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// The extension of a file's name in lower case, with its dot.
inline std::string lower_case_extension(const std::filesystem::path& path)
{
  return lower_case(path.extension().string());
}

} // namespace Atlas::internal

#endif
