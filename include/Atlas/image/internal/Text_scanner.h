// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_TEXT_SCANNER_H
#define ATLAS_IMAGE_INTERNAL_TEXT_SCANNER_H

#include <Atlas/core/errors.h>
#include <Atlas/image/internal/Reading_listener.h>
#include <Atlas/image/internal/text_bytes.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace Atlas::internal {

/// The whole file as bytes.
inline std::string read_whole_file(const std::filesystem::path& path)
{
  const auto fail = [&](int error) -> IO_error {
    tell_of_reading(path, std::nullopt);
    return IO_error(path.string() + ": cannot read: " + std::generic_category().message(error));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.string().c_str(), "rb"),
                                                             &std::fclose);
  if (!file)
    throw fail(errno);
  std::string bytes;
  std::error_code ignored;
  if (const auto size = std::filesystem::file_size(path, ignored); !ignored)
    bytes.reserve(size);
  char block[1 << 16];
  while (const std::size_t n = std::fread(block, 1, sizeof block, file.get()))
    bytes.append(block, n);
  if (std::ferror(file.get()))
    throw fail(errno);
  tell_of_reading(path, bytes);
  if (bytes.empty())
    throw IO_error(path.string() + ": the file is empty");
  return bytes;
}

/// A file that is text, in UTF-8. See `decoded_text()`. \throw IO_error
inline std::string read_text_file(const std::filesystem::path& path)
{
  return decoded_text(read_whole_file(path), printable(path.string()));
}

/// A token as it is shown in an error message: short, printable.
inline std::string quoted(std::string_view token)
{
  std::size_t end = 0;
  while (end < token.size() && end < 30)
    end += std::max<std::size_t>(length_of_character(token.substr(end)), 1);
  return "'" + printable(token.substr(0, end)) + (end < token.size() ? "...'" : "'");
}

/// Reads a text line by line and token by token; knows where it is when something is wrong.
class Text_scanner
{
public:
  enum Options { plain = 0, hash_comments = 1, backslash_continues = 2 };

  /// \param text must outlive the scanner
  Text_scanner(std::string_view text, std::string file_name, int options)
      : rest_(text), file_name_(std::move(file_name)), options_(options)
  {
    if (rest_.substr(0, 3) == "\xEF\xBB\xBF")
      rest_.remove_prefix(3);
  }

  /// Goes to the next line; `false` at the end of the text.
  bool next_line()
  {
    if (rest_.empty())
      return false;
    take_physical_line();
    if (options_ & backslash_continues && ends_in_backslash())
      join_continued_lines();
    return true;
  }

  /// Goes to the next line that has a token; `false` at the end of the text.
  bool next_filled_line()
  {
    while (next_line())
      if (!at_end())
        return true;
    return false;
  }

  /// Whether nothing but blanks and comment is left of the line.
  bool at_end()
  {
    while (cursor_ != end_ && is_blank(*cursor_))
      ++cursor_;
    if (cursor_ != end_ && options_ & hash_comments && *cursor_ == '#')
      cursor_ = end_;
    return cursor_ == end_;
  }

  /// The next token of the line, empty at its end.
  std::string_view token()
  {
    at_end();
    const char* const begin = cursor_;
    while (cursor_ != end_ && !is_blank(*cursor_))
      ++cursor_;
    return {begin, static_cast<std::size_t>(cursor_ - begin)};
  }

  /// The next token, which stays; empty at the end of the line.
  std::string_view peek()
  {
    const char* const here = (at_end(), cursor_);
    const std::string_view word = token();
    cursor_ = here;
    return word;
  }

  /// The whole line as it stands, comments included.
  std::string_view line_text() const { return {begin_, static_cast<std::size_t>(end_ - begin_)}; }

  /// What is left of the line without blanks at its ends.
  std::string_view remainder()
  {
    at_end();
    const char* last = end_;
    while (last != cursor_ && is_blank(last[-1]))
      --last;
    const std::string_view result(cursor_, static_cast<std::size_t>(last - cursor_));
    cursor_ = end_;
    return result;
  }

  /// The next token as a number; fails when there is none. Too large numbers are infinite, too small ones 0.
  double number(const char* what)
  {
    if (at_end())
      fail(std::string(what) + " is missing");
    double value = 0;
    const char* const begin = *cursor_ == '+' ? cursor_ + 1 : cursor_;
    const auto [p, error] = std::from_chars(begin, end_, value);
    if (error == std::errc::result_out_of_range)
      value = std::strtod(std::string(begin, p).c_str(), nullptr);
    else if (error != std::errc())
      fail(std::string(what) + " is not a number: " + quoted(token()));
    if (p != end_ && *p == '#' && is_word_of_microsoft(p + 1, value))
      return value;
    if (p != end_ && !ends_number(*p))
      fail(std::string(what) + " is not a number: " + quoted(token()));
    cursor_ = p;
    return value;
  }

  /// The next token as a number, if it is one; else it stays.
  bool number_here(double& value)
  {
    if (at_end())
      return false;
    const auto [p, error] = std::from_chars(cursor_, end_, value);
    if (error != std::errc() || (p != end_ && !ends_number(*p)))
      return false;
    cursor_ = p;
    return true;
  }

  /// Skips bytes of the line that are known to be there.
  void skip(std::size_t n) { cursor_ += n; }

  /// An integer at the cursor, which must not be preceded by blanks; `false` if there is none.
  bool integer_here(long long& value)
  {
    const auto [p, error] = std::from_chars(cursor_, end_, value);
    if (error != std::errc())
      return false;
    cursor_ = p;
    return true;
  }

  /// The next token as an integer; fails when there is none.
  long long integer(const char* what)
  {
    if (at_end())
      fail(std::string(what) + " is missing");
    const char* const begin = cursor_;
    long long value = 0;
    if (!integer_here(value) || !at_token_end()) {
      cursor_ = begin;
      fail(std::string(what) + " is not an integer: " + quoted(token()));
    }
    return value;
  }

  /// Skips the character if it comes next.
  bool accept(char c)
  {
    if (cursor_ == end_ || *cursor_ != c)
      return false;
    ++cursor_;
    return true;
  }

  /// Skips .000 behind an integer.
  void skip_zero_fraction()
  {
    const std::string_view rest(cursor_, static_cast<std::size_t>(end_ - cursor_));
    const std::size_t end = std::min(rest.find_first_not_of('0', 1), rest.size());
    if (rest.starts_with('.') && (end == rest.size() || ends_number(rest[end]) || rest[end] == '/'))
      cursor_ += end;
  }

  /// Whether the cursor is behind a token that is a number, or several.
  bool at_token_end() const { return cursor_ == end_ || ends_number(*cursor_); }

  [[noreturn]] void fail(const std::string& message) const
  {
    throw IO_error(file_name_ + ":" + std::to_string(line_) + ": " + message);
  }

  std::size_t line() const { return line_; }
  std::string_view rest() const { return rest_; }

private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

  /// A comment may follow a number without a blank; a name may have a `#` in it.
  bool ends_number(char c) const { return is_blank(c) || (c == '#' && options_ & hash_comments); }

  /// Old C libraries write 1.#INF, -1.#IND and 1.#QNAN; reads what is behind the mark.
  bool is_word_of_microsoft(const char* p, double& value)
  {
    const std::string_view rest(p, static_cast<std::size_t>(end_ - p));
    if (rest.starts_with("INF"))
      value = std::copysign(std::numeric_limits<double>::infinity(), value);
    else if (rest.starts_with("IND") || rest.starts_with("QNAN") || rest.starts_with("SNAN"))
      value = std::numeric_limits<double>::quiet_NaN();
    else
      return false;
    token();
    return true;
  }

  void take_physical_line()
  {
    line_ += lines_taken_;
    lines_taken_ = 1;
    const std::size_t length = length_of_line();
    begin_ = cursor_ = rest_.data();
    end_ = cursor_ + length;
    rest_.remove_prefix(std::min(rest_.size(), length + 1));
  }

  /// Up to a line feed, or to a carriage return behind which the line goes on.
  std::size_t length_of_line()
  {
    const char* const begin = rest_.data();
    if (!feed_ || feed_ < begin) { // else it is still ahead, so that texts without any are not searched again
      feed_ = static_cast<const char*>(std::memchr(begin, '\n', rest_.size()));
      has_feed_ = feed_ != nullptr;
      feed_ = has_feed_ ? feed_ : begin + rest_.size();
    }
    const char *const end = feed_, *last = end;
    while (has_feed_ && last != begin && last[-1] == '\r') // these belong to the line feed
      --last;
    const auto n = static_cast<std::size_t>(last - begin);
    const auto* const carriage_return =
        n == 0 ? nullptr : static_cast<const char*>(std::memchr(begin, '\r', n));
    return static_cast<std::size_t>((carriage_return ? carriage_return : end) - begin);
  }

  /// A comment is not continued: some end in the path of a folder.
  bool ends_in_backslash() const
  {
    const std::string_view line(cursor_, static_cast<std::size_t>(end_ - cursor_));
    if (const std::size_t first = line.find_first_not_of(" \t"); first != std::string_view::npos)
      if (line[first] == '#' && options_ & hash_comments)
        return false;
    const char* last = end_;
    while (last != cursor_ && is_blank(last[-1]))
      --last;
    return last != cursor_ && last[-1] == '\\';
  }

  void join_continued_lines()
  {
    const std::size_t start = line_;
    joined_.clear();
    std::size_t lines = 0;
    bool is_continued = true;
    while (is_continued) {
      ++lines;
      is_continued = ends_in_backslash();
      joined_.append(cursor_, end_);
      if (is_continued)
        joined_[joined_.find_last_of('\\')] = ' ';
      if (rest_.empty())
        break;
      if (is_continued)
        take_physical_line();
    }
    line_ = start;
    lines_taken_ = lines;
    begin_ = cursor_ = joined_.data();
    end_ = cursor_ + joined_.size();
  }

  std::string_view rest_;
  std::string file_name_, joined_;
  const char* begin_ = nullptr;
  const char* cursor_ = nullptr;
  const char* end_ = nullptr;
  const char* feed_ = nullptr; ///< the next line feed, or the end of the text
  bool has_feed_ = false;
  std::size_t line_ = 0, lines_taken_ = 1;
  int options_;
};

} // namespace Atlas::internal

#endif
