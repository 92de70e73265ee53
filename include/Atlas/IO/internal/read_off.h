// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_OFF_H
#define ATLAS_IO_INTERNAL_READ_OFF_H

#include <Atlas/IO/internal/row_ends.h>
#include <Atlas/IO/internal/scale_colors.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace Atlas::internal {

class Off_reader
{
public:
  Off_reader(std::string_view text, const std::string& file_name, Row_ends ends)
      : scanner_(text, file_name, Text_scanner::hash_comments), text_size_(text.size()),
        has_free_rows_(ends == Row_ends::anywhere)
  {}

  /// Whether the beginning has been understood.
  bool may_have_free_rows() const { return has_word_; }

  Polygon_soup read()
  {
    read_header();
    read_vertices();
    for (std::size_t f = 0; f < faces_; ++f)
      read_face(f);
    if (has_free_rows_ && (!scanner_.at_end() || scanner_.next_filled_line()))
      scanner_.fail("more values than the header tells of");
    finish();
    return std::move(soup_);
  }

private:
  /// [[ST][C][N]OFF], then three counts.
  void read_header()
  {
    if (!scanner_.next_filled_line())
      scanner_.fail("no header");
    if (std::isdigit(static_cast<unsigned char>(scanner_.peek().front())) == 0 ||
        scanner_.peek().starts_with('4'))
      read_kind();
    has_word_ = true;
    vertices_ = count("number of vertices");
    faces_ = count("number of faces");
    if (has_free_rows_)
      count("number of edges");
    if (faces_ == 0)
      scanner_.fail("no face in the file");
  }

  /// The word, in capitals or in small letters.
  void read_kind()
  {
    std::string word(scanner_.peek());
    if (std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c); }))
      std::transform(word.begin(), word.end(), word.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const std::string kind = word.substr(0, word.find("OFF"));
    if (kind.size() == word.size() && std::isdigit(static_cast<unsigned char>(word.front())) != 0)
      return; // there is none, and this is a count
    if (kind.size() == word.size() || kind.size() > 4)
      scanner_.fail("an OFF file begins with the word OFF, this one with " + quoted(scanner_.peek()));
    if (kind.find_first_not_of("STCN") != std::string::npos || word.substr(kind.size() + 3) == "BINARY")
      scanner_.fail("OFF files of kind " + quoted(scanner_.peek()) + " are not supported");
    has_texture_ = kind.find("ST") != std::string::npos;
    has_colors_ = kind.find('C') != std::string::npos;
    has_normals_ = kind.find('N') != std::string::npos;
    scanner_.skip(kind.size() + 3); // the first count may follow without a blank
    if (scanner_.peek() == "BINARY")
      scanner_.fail("binary OFF files are not supported");
    if (scanner_.at_end() && !scanner_.next_filled_line())
      scanner_.fail("the counts are missing");
  }

  /// Goes to the next line where the row may go on there.
  void find_value()
  {
    if (has_free_rows_ && scanner_.at_end())
      scanner_.next_filled_line();
  }

  double number(const char* what)
  {
    find_value();
    return scanner_.number(what);
  }

  /// A count cannot exceed the size of the file, so that memory is not asked for what is not there.
  std::size_t count(const char* what)
  {
    find_value();
    const long long n = scanner_.integer(what);
    if (n < 0 || static_cast<std::size_t>(n) > text_size_)
      scanner_.fail(std::string(what) + " is " + std::to_string(n) + ", more than the file can hold");
    return static_cast<std::size_t>(n);
  }

  void start_row(std::size_t i, std::size_t n, const char* rows)
  {
    if (!has_free_rows_ && !scanner_.next_filled_line())
      scanner_.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(n) + ' ' + rows);
  }

  void read_vertices()
  {
    soup_.points.reserve(vertices_);
    for (std::size_t v = 0; v < vertices_; ++v) {
      start_row(v, vertices_, "vertices");
      const double x = number("x"), y = number("y"), z = number("z");
      soup_.points.emplace_back(x, y, z);
      if (has_normals_) {
        const double a = number("normal x"), b = number("normal y"), c = number("normal z");
        soup_.normals.emplace_back(a, b, c);
      }
      if (has_colors_)
        read_color();
      if (has_texture_) {
        const double s = number("texture s");
        texture_.emplace_back(s, number("texture t"));
      }
      if (!has_normals_ && !has_colors_ && !has_texture_ && !has_free_rows_)
        read_untold_color();
    }
  }

  void read_color()
  {
    std::array<float, 4> color{1, 1, 1, untold};
    for (std::size_t n = 0; n < 4 && !(n == 3 && !has_free_rows_ && scanner_.at_end()); ++n)
      color[n] = static_cast<float>(number("colour"));
    soup_.colors.push_back(color);
  }

  /// Many write colours behind positions, and a header that does not tell of them: three or four numbers, at
  /// each vertex, none of which is negative as those of normals are.
  void read_untold_color()
  {
    const std::size_t before = soup_.points.size() - 1;
    if (soup_.colors.size() != before || scanner_.at_end())
      return;
    std::array<float, 4> color{1, 1, 1, untold};
    std::size_t n = 0;
    for (double x = 0; n < 4 && scanner_.number_here(x) && x >= 0; ++n)
      color[n] = static_cast<float>(x);
    if (n >= 3 && scanner_.at_end())
      soup_.colors.push_back(color);
  }

  /// Three or four numbers behind the corners are a colour; one is the place in a table that is not there.
  void read_face_color()
  {
    std::array<float, 4> color{1, 1, 1, untold};
    std::size_t n = 0;
    for (double x = 0; n < 4 && scanner_.number_here(x); ++n)
      color[n] = static_cast<float>(x);
    if (n < 3)
      return;
    soup_.face_colors.resize(soup_.number_of_faces() - 1, untold_color);
    soup_.face_colors.push_back(color);
  }

  void read_face(std::size_t f)
  {
    start_row(f, faces_, "faces");
    const std::size_t n = count("number of corners");
    for (std::size_t i = 0; i < n; ++i) {
      find_value();
      const long long v = scanner_.integer("vertex index");
      soup_.vertices.push_back(v < 0 || v >= no_index ? no_index : static_cast<Index>(v));
    }
    soup_.close_face();
    if (!has_free_rows_)
      read_face_color();
  }

  void finish()
  {
    if (!soup_.face_colors.empty())
      soup_.face_colors.resize(soup_.number_of_faces(), untold_color);
    if (soup_.colors.size() != vertices_) // those of some only have not been colours
      soup_.colors.clear();
    scale_colors(soup_.colors);
    scale_colors(soup_.face_colors);
    const auto exists = [&](Index v) { return v < vertices_; };
    if (has_texture_)
      for (const Index v : soup_.vertices)
        soup_.uv.push_back(exists(v) ? texture_[v] : Point_2(NAN, NAN));
    if (has_normals_)
      for (const Index v : soup_.vertices)
        soup_.corner_normal.push_back(exists(v) ? v : no_index);
  }

  Text_scanner scanner_;
  std::size_t text_size_, vertices_ = 0, faces_ = 0;
  bool has_free_rows_, has_word_ = false, has_texture_ = false, has_colors_ = false, has_normals_ = false;
  std::vector<Point_2> texture_;
  Polygon_soup soup_;
};

/// Reads an OFF file: `OFF`, and with normals, colours or texture coordinates at the vertices `NOFF`,
/// `COFF`, `STOFF` and their combinations; colours of faces. The word may be missing, or in small letters,
/// and the first count may follow it without a blank. Where rows have no lines of their own, line ends are
/// blanks. \throw IO_error naming the line
inline Polygon_soup read_off(const std::filesystem::path& path)
{
  return read_with_any_row_ends<Off_reader>(read_text_file(path), path.string());
}

} // namespace Atlas::internal

#endif
