// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_STL_H
#define ATLAS_IO_INTERNAL_READ_STL_H

#include <Atlas/IO/internal/extension.h>
#include <Atlas/image/internal/Binary_scanner.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/index_uv.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace Atlas::internal {

/// Gives equal positions one vertex, in the order in which they occur first: STL has no vertices of its own.
class Vertex_table
{
public:
  Vertex_table(Polygon_soup& soup, std::size_t expected) : soup_(soup), table_(expected) {}

  void add_corner(double x, double y, double z)
  {
    // Adding zero turns -0 into 0, which is the same place.
    const Index v = table_({std::bit_cast<std::uint64_t>(x + 0.0), std::bit_cast<std::uint64_t>(y + 0.0),
                            std::bit_cast<std::uint64_t>(z + 0.0)});
    if (v == soup_.points.size())
      soup_.points.emplace_back(x, y, z);
    soup_.vertices.push_back(v);
  }

private:
  Polygon_soup& soup_;
  Row_table<3> table_;
};

/// How binary STL tells the colour of a facet in its last two bytes; the file says so in its header, or not.
inline std::array<float, 4> stl_color(unsigned attribute, bool is_magics, const std::array<float, 4>& common)
{
  const bool has_own = (attribute >> 15 != 0) != is_magics;
  if (!has_own)
    return common;
  const auto part = [&](int shift) { return static_cast<float>(attribute >> shift & 31) / 31; };
  return is_magics ? std::array<float, 4>{part(0), part(5), part(10), 1}
                   : std::array<float, 4>{part(10), part(5), part(0), 1};
}

/// Binary STL. The number of triangles in it is often wrong (0, -1): where the file has a whole number of
/// them, or the number is none of these, what is there counts. Zeros behind the last one are padding.
class Binary_stl_reader
{
public:
  Binary_stl_reader(std::string_view bytes, const std::string& file_name)
      : bytes_(bytes), scanner_(bytes, file_name, std::endian::little), table_(soup_, bytes.size() / 100)
  {}

  Polygon_soup read()
  {
    scanner_.skip(80, "the header");
    const std::uint64_t told = scanner_.get<std::uint32_t>("the number of triangles");
    const std::uint64_t count = number_of_triangles(told);
    if (count != told)
      soup_.warnings.push_back("the header tells of " + std::to_string(told) + " triangles, but there are " +
                               std::to_string(count));
    read_common_color();
    for (std::uint64_t t = count; t > 0; --t)
      read_triangle();
    if (!has_colors_)
      soup_.face_colors.clear();
    return std::move(soup_);
  }

private:
  std::uint64_t number_of_triangles(std::uint64_t told) const
  {
    const std::uint64_t there = scanner_.bytes_left() / 50;
    const bool is_whole = there > 0 && scanner_.bytes_left() % 50 == 0;
    const bool is_no_number = told == 0 || told == 0xFFFFFFFF;
    const bool is_padded = !is_no_number && told < there &&
                           bytes_.find_first_not_of('\0', 84 + 50 * told) == std::string_view::npos;
    return is_padded ? told : is_whole || is_no_number ? there : told;
  }

  /// Materialise Magics: COLOR= and four bytes in the header.
  void read_common_color()
  {
    const std::size_t at = bytes_.substr(0, 80).find("COLOR=");
    is_magics_ = at != std::string_view::npos && at + 10 <= 80;
    for (std::size_t k = 0; k < 4 && is_magics_; ++k)
      common_[k] = static_cast<float>(static_cast<unsigned char>(bytes_[at + 6 + k])) / 255;
    has_colors_ = is_magics_;
  }

  void read_triangle()
  {
    scanner_.skip(12, "a normal");
    for (int i = 0; i < 3; ++i) {
      const float x = scanner_.get<float>("a vertex"), y = scanner_.get<float>("a vertex");
      table_.add_corner(x, y, scanner_.get<float>("a vertex"));
    }
    const unsigned attribute = scanner_.get<std::uint16_t>("an attribute");
    has_colors_ = has_colors_ || attribute >> 15 != 0;
    soup_.face_colors.push_back(stl_color(attribute, is_magics_, common_));
    soup_.close_face();
  }

  std::string_view bytes_;
  Binary_scanner scanner_;
  Polygon_soup soup_;
  Vertex_table table_;
  std::array<float, 4> common_{1, 1, 1, 1};
  bool is_magics_ = false, has_colors_ = false;
};

/// Text STL: keywords in any case, with line ends and blanks anywhere between words, "end loop" for
/// "endloop" and the reverse. A line that begins with no keyword is passed over.
class Text_stl_reader
{
public:
  Text_stl_reader(std::string_view text, const std::string& file_name)
      : scanner_(text, file_name, Text_scanner::plain), table_(soup_, text.size() / 500)
  {}

  Polygon_soup read()
  {
    while (scanner_.next_filled_line())
      while (!scanner_.at_end())
        read_statement(lower_case(scanner_.token()));
    if (is_in_loop_)
      scanner_.fail("the file ends in the middle of a facet");
    return std::move(soup_);
  }

private:
  void read_statement(std::string word)
  {
    if (word == "end")
      word += lower_case(scanner_.token());
    if (word == "solid" || word == "endsolid") {
      skip_name();
    } else if (word == "vertex") {
      read_vertex();
    } else if (word == "normal") { // not needed; some are no numbers
      for (int k = 0; k < 3 && !scanner_.at_end(); ++k)
        scanner_.token();
    } else if (word == "loop" || word == "outerloop") {
      is_in_loop_ = true;
    } else if (word == "endloop") {
      is_in_loop_ = false;
      soup_.close_face();
    } else if (word != "outer" && word != "facet" && word != "endfacet") {
      skip_line(word);
    }
  }

  /// The name of a solid ends with the line, or where the facets begin that stand on the same one.
  void skip_name()
  {
    const std::string line = lower_case(scanner_.line_text());
    const bool has_facets = line.find("vertex", line.find("facet normal")) != std::string::npos;
    if (!has_facets)
      scanner_.remainder();
    while (has_facets && !scanner_.at_end() && lower_case(scanner_.peek()) != "facet")
      scanner_.token();
  }

  /// Comments, colours and whatever else is no part of the shape.
  void skip_line(const std::string& word)
  {
    if (soup_.warnings.empty())
      soup_.warnings.push_back("line " + std::to_string(scanner_.line()) +
                               " is passed over, as it begins with " + internal::quoted(word) +
                               ", and so are others that begin with no keyword");
    scanner_.remainder();
  }

  void read_vertex()
  {
    if (!is_in_loop_)
      scanner_.fail("a vertex outside of a loop");
    const double x = scanner_.number("x"), y = scanner_.number("y");
    table_.add_corner(x, y, scanner_.number("z"));
  }

  Text_scanner scanner_;
  Polygon_soup soup_;
  Vertex_table table_;
  bool is_in_loop_ = false;
};

/// Whether the size is what binary STL of so many triangles has.
inline bool has_size_of_binary_stl(std::string_view bytes)
{
  return bytes.size() >= 84 &&
         bytes.size() == 84 + 50 * std::uint64_t(Binary_scanner(bytes, {}, std::endian::little, 80)
                                                     .get<std::uint32_t>("the number of triangles"));
}

/// Whether the bytes are binary STL: the size tells, since headers of binary files may begin with "solid"
/// too; else a zero byte near the beginning that is no padding of the end, or that there are no keywords.
inline bool is_binary_stl(std::string_view bytes)
{
  if (has_size_of_binary_stl(bytes))
    return true;
  const std::string head =
      lower_case(bytes.substr(0, std::min<std::size_t>(bytes.find_last_not_of('\0') + 1, 4000)));
  const std::size_t start = std::min(head.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), head.size());
  return head.find('\0') != std::string::npos ||
         (head.find("vertex") == std::string::npos && head.compare(start, 5, "solid") != 0 &&
          head.compare(start, 5, "facet") != 0);
}

/// Reads an STL file, text or binary. Corners at exactly the same position become one vertex; colours of the
/// facets of binary files, as Magics and VisCAM write them, are those of faces.
/// \throw IO_error naming the line or byte
inline Polygon_soup read_stl(const std::filesystem::path& path)
{
  const std::string name = path.string();
  std::string bytes = read_whole_file(path);
  const bool has_mark = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
  Polygon_soup soup;
  if (has_mark ? has_size_of_binary_stl(bytes) : is_binary_stl(bytes)) {
    soup = Binary_stl_reader(bytes, name).read();
  } else {
    bytes = decoded_text(std::move(bytes), name);
    soup = Text_stl_reader(bytes, name).read();
  }
  if (soup.number_of_faces() == 0)
    throw IO_error(name + ": no face in the file");
  return soup;
}

} // namespace Atlas::internal

#endif
