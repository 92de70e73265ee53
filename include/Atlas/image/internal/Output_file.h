// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_OUTPUT_FILE_H
#define ATLAS_IMAGE_INTERNAL_OUTPUT_FILE_H

#include <Atlas/core/errors.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief A set of files that appear whole and together, or not at all.
///
/// `add()` writes a file beside its place under a temporary name; `commit()` renames all of them. What has
/// not been committed is deleted. Devices and pipes are written to directly.
class Output_files
{
public:
  Output_files() = default;
  Output_files(const Output_files&) = delete;
  Output_files& operator=(const Output_files&) = delete;
  ~Output_files()
  {
    for (const Pending& file : pending_)
      std::remove(file.temporary.c_str());
  }

  /// \throw IO_error if the file cannot be written in full
  void add(const std::filesystem::path& path, std::string_view bytes)
  {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (std::filesystem::is_directory(status))
      throw IO_error(path.string() + ": cannot write: it is a directory");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
      write(path.string(), path, bytes, "wb");
      return;
    }
    // A link stays a link: what it points to is replaced.
    auto place =
        std::filesystem::is_symlink(path, ignored) ? std::filesystem::weakly_canonical(path, ignored) : path;
    if (place.empty())
      place = path;
    std::string hidden = "."; // appended to: GCC 12 takes `"." + std::string()` for a copy onto itself
    hidden += place.filename().string() + "." + std::to_string(::getpid()) + ".part";
    const std::filesystem::path temporary = place.parent_path() / hidden;
    pending_.push_back({temporary.string(), place.string()});
    write(temporary.string(), path, bytes, "wb");
  }

  /// Gives all files their names. \throw IO_error
  void commit()
  {
    while (!pending_.empty()) {
      const Pending& file = pending_.back();
      if (std::rename(file.temporary.c_str(), file.final.c_str()) != 0)
        throw failure(file.final, errno);
      pending_.pop_back();
    }
  }

private:
  struct Pending
  {
    std::string temporary, final;
  };

  static IO_error failure(const std::string& path, int error)
  {
    return IO_error(path + ": cannot write: " + std::generic_category().message(error));
  }

  static void write(const std::string& where, const std::filesystem::path& name, std::string_view bytes,
                    const char* mode)
  {
    std::FILE* const file = std::fopen(where.c_str(), mode);
    if (!file)
      throw failure(name.string(), errno);
    errno = 0;
    bool is_good = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    is_good = is_good && std::fflush(file) == 0;
    const int error = errno;
    const bool is_closed = std::fclose(file) == 0;
    if (!is_good || !is_closed)
      throw failure(name.string(), is_good ? errno : error);
  }

  std::vector<Pending> pending_;
};

/// Writes one file, whole or not at all. \throw IO_error
inline void write_whole_file(const std::filesystem::path& path, std::string_view bytes)
{
  Output_files files;
  files.add(path, bytes);
  files.commit();
}

/// Finds out whether a file can be written to a place, with an empty one beside it that goes away again: a
/// long work should not end with an error that was there before. Devices are not tried. \throw IO_error
inline void check_can_write(const std::filesystem::path& path)
{
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_directory(status))
    return;
  Output_files files;
  files.add(path, "");
}

} // namespace Atlas::internal

#endif
