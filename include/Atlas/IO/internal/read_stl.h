// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_STL_H
#define ATLAS_IO_INTERNAL_READ_STL_H

#include <Atlas/image/internal/Binary_scanner.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/index_uv.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

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

inline Polygon_soup read_binary_stl(std::string_view bytes, const std::string& file_name)
{
  Polygon_soup soup;
  Vertex_table table(soup, bytes.size() / 100);
  Binary_scanner scanner(bytes, file_name, std::endian::little);
  scanner.skip(80, "the header");
  const auto n = scanner.get<std::uint32_t>("the number of triangles");
  for (std::uint32_t t = 0; t < n; ++t) {
    scanner.skip(12, "a normal");
    for (int i = 0; i < 3; ++i) {
      const float x = scanner.get<float>("a vertex"), y = scanner.get<float>("a vertex");
      table.add_corner(x, y, scanner.get<float>("a vertex"));
    }
    scanner.skip(2, "an attribute");
    soup.close_face();
  }
  return soup;
}

inline Polygon_soup read_ascii_stl(std::string_view text, const std::string& file_name)
{
  Polygon_soup soup;
  Vertex_table table(soup, text.size() / 500);
  Text_scanner scanner(text, file_name, Text_scanner::plain);
  bool is_in_loop = false;
  while (scanner.next_filled_line()) {
    const std::string_view word = scanner.token();
    if (word == "vertex") {
      if (!is_in_loop)
        scanner.fail("a vertex outside of a loop");
      const double x = scanner.number("x"), y = scanner.number("y");
      table.add_corner(x, y, scanner.number("z"));
    } else if (word == "outer") {
      is_in_loop = true;
    } else if (word == "endloop") {
      is_in_loop = false;
      soup.close_face();
    } else if (word != "solid" && word != "facet" && word != "endfacet" && word != "endsolid") {
      scanner.fail("unknown statement " + quoted(word));
    }
  }
  if (is_in_loop)
    scanner.fail("the file ends in the middle of a facet");
  return soup;
}

/// Whether the bytes are binary STL: the size tells, since headers of binary files may begin with "solid"
/// too.
inline bool is_binary_stl(std::string_view bytes)
{
  if (bytes.size() >= 84) {
    std::uint32_t n = 0;
    for (int i = 3; i >= 0; --i)
      n = n << 8 | static_cast<unsigned char>(bytes[80 + i]);
    if (bytes.size() == 84 + 50 * std::uint64_t(n))
      return true;
  }
  const auto start = bytes.find_first_not_of(" \t\r\n");
  return start == std::string_view::npos || bytes.substr(start, 5) != "solid" ||
         bytes.substr(0, 1000).find('\0') != std::string_view::npos;
}

/// Reads an STL file, text or binary. Corners at exactly the same position become one vertex.
/// \throw IO_error naming the line or byte
inline Polygon_soup read_stl(const std::filesystem::path& path)
{
  const std::string bytes = read_whole_file(path), name = path.string();
  Polygon_soup soup = is_binary_stl(bytes) ? read_binary_stl(bytes, name) : read_ascii_stl(bytes, name);
  if (soup.number_of_faces() == 0)
    throw IO_error(name + ": no face in the file");
  return soup;
}

} // namespace Atlas::internal

#endif
