// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_FIND_FILE_H
#define ATLAS_IO_INTERNAL_FIND_FILE_H

#include <Atlas/image/internal/Reading_listener.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace Atlas::internal {

inline bool is_same_name_in_any_case(std::string_view a, std::string_view b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// The file of a path below a folder; a part that is not there stands for one that differs from it in case
/// only, the first by name if there are several.
inline std::optional<std::filesystem::path> file_in_any_case(const std::filesystem::path& folder,
                                                             const std::filesystem::path& path)
{
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::is_regular_file(folder / path, ignored))
    return folder / path;
  tell_of_reading(folder / path, std::nullopt);
  fs::path here = path.is_absolute() ? path.root_path() : folder;
  for (const fs::path& part : path.relative_path()) {
    if (fs::exists(here / part, ignored)) {
      here /= part;
      continue;
    }
    std::optional<fs::path> found;
    for (const auto& entry : fs::directory_iterator(here.empty() ? fs::path(".") : here, ignored)) {
      const fs::path name = entry.path().filename();
      if (is_same_name_in_any_case(name.string(), part.string()) && (!found || name < *found))
        found = name;
    }
    if (!found)
      return std::nullopt;
    here /= *found;
  }
  if (!fs::is_regular_file(here, ignored))
    return std::nullopt;
  return here;
}

/// The name that a file gives to another: without quotes, with slashes.
inline std::string plain_name(std::string name)
{
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.size() >= 2 && name.front() == name.back() && (name.front() == '"' || name.front() == '\''))
    name = name.substr(1, name.size() - 2);
  return name;
}

/// The name that a URI stands for, in which %20 is a blank.
inline std::string percent_decoded(std::string_view uri)
{
  const auto is_digit = [&](std::size_t i) { return std::isxdigit(static_cast<unsigned char>(uri[i])) != 0; };
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i)
    if (uri[i] == '%' && i + 2 < uri.size() && is_digit(i + 1) && is_digit(i + 2)) {
      result += static_cast<char>(std::strtol(std::string(uri.substr(i + 1, 2)).c_str(), nullptr, 16));
      i += 2;
    } else {
      result += uri[i];
    }
  return result;
}

/// \brief The file that another one means by a name: relative to the folder, in any case; of a path that is
/// not there, as those of other machines, the longest end that is. The name may be a URI, and a comment may
/// follow it.
inline std::optional<std::filesystem::path> find_file(const std::filesystem::path& folder,
                                                      const std::string& name)
{
  const std::string uncommented = name.substr(0, name.find_last_not_of(" \t", name.find(" #")) + 1);
  for (const std::string& meant : {name, uncommented, percent_decoded(name)}) {
    std::string rest = plain_name(meant);
    while (!rest.empty()) {
      if (auto found = file_in_any_case(folder, rest))
        return found;
      const std::size_t slash = rest.find('/');
      rest = slash == std::string::npos ? "" : rest.substr(slash + 1);
    }
  }
  return std::nullopt;
}

} // namespace Atlas::internal

#endif
