// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_READING_LISTENER_H
#define ATLAS_IMAGE_INTERNAL_READING_LISTENER_H

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace Atlas::internal {

/// Called with each file that is read and its bytes, or without bytes where there is no such file.
using Reading_listener = std::function<void(const std::filesystem::path&, std::optional<std::string_view>)>;

/// The one of this process, so that a program can know later whether what it has read is still the same. Set
/// before any file is read; called from the threads that read.
inline Reading_listener& reading_listener()
{
  static Reading_listener listener;
  return listener;
}

inline void tell_of_reading(const std::filesystem::path& path, std::optional<std::string_view> bytes)
{
  if (reading_listener())
    reading_listener()(path, bytes);
}

} // namespace Atlas::internal

#endif
