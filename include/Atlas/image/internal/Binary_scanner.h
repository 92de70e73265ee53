// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_BINARY_SCANNER_H
#define ATLAS_IMAGE_INTERNAL_BINARY_SCANNER_H

#include <Atlas/core/errors.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace Atlas::internal {

/// Reads numbers of either byte order; knows where it is when the file is too short.
class Binary_scanner
{
public:
  /// \param bytes must outlive the scanner
  /// \param offset where to start
  Binary_scanner(std::string_view bytes, std::string file_name, std::endian order, std::size_t offset = 0)
      : bytes_(bytes), file_name_(std::move(file_name)), order_(order), at_(offset)
  {}

  template <typename Number>
  Number get(const char* what)
  {
    char raw[sizeof(Number)];
    need(sizeof raw, what);
    std::memcpy(raw, bytes_.data() + at_, sizeof raw);
    if (order_ != std::endian::native)
      std::reverse(raw, raw + sizeof raw);
    at_ += sizeof raw;
    Number value;
    std::memcpy(&value, raw, sizeof raw);
    return value;
  }

  void skip(std::size_t n, const char* what)
  {
    need(n, what);
    at_ += n;
  }

  std::size_t bytes_left() const { return bytes_.size() - at_; }

  [[noreturn]] void fail(const std::string& message) const
  {
    throw IO_error(file_name_ + ": byte " + std::to_string(at_) + ": " + message);
  }

private:
  void need(std::size_t n, const char* what) const
  {
    if (bytes_left() < n)
      fail(std::string("the file ends in the middle of ") + what);
  }

  std::string_view bytes_;
  std::string file_name_;
  std::endian order_;
  std::size_t at_;
};

} // namespace Atlas::internal

#endif
