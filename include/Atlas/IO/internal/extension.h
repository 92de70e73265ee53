// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_EXTENSION_H
#define ATLAS_IO_INTERNAL_EXTENSION_H

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace Atlas::internal {

/// The extension of a file's name in lower case, with its dot.
inline std::string lower_case_extension(const std::filesystem::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

} // namespace Atlas::internal

#endif
