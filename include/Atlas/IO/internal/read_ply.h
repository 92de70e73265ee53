// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_PLY_H
#define ATLAS_IO_INTERNAL_READ_PLY_H

#include <Atlas/image/internal/Binary_scanner.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/soup/Polygon_soup.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Atlas::internal {

enum class Ply_type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Ply_property
{
  std::string name;
  Ply_type type{};
  std::optional<Ply_type> count_type; ///< of a list
};

struct Ply_element
{
  std::string name;
  std::size_t count = 0;
  std::vector<Ply_property> properties;

  /// The place of the first property with one of the names, or -1.
  int find(std::initializer_list<std::string_view> names) const
  {
    for (std::size_t i = 0; i < properties.size(); ++i)
      for (const std::string_view name_wanted : names)
        if (properties[i].name == name_wanted)
          return static_cast<int>(i);
    return -1;
  }
};

/// The rows of a text or binary PLY file as numbers.
class Ply_rows
{
public:
  Ply_rows(std::string_view bytes, std::string file_name, Text_scanner& text,
           std::optional<std::endian> order)
      : text_(text), is_text_(!order),
        binary_(bytes, std::move(file_name), order.value_or(std::endian::little),
                bytes.size() - text.rest().size())
  {}

  /// Starts row `i` of the element; fails if there is none.
  void start_row(const Ply_element& element, std::size_t i)
  {
    if (is_text_ && !text_.next_filled_line())
      text_.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(element.count) +
                 " rows of '" + element.name + "'");
  }

  double value(Ply_type type, const std::string& what)
  {
    if (is_text_)
      return text_.number(what.c_str());
    switch (type) {
    case Ply_type::int8:
      return binary_.get<std::int8_t>(what.c_str());
    case Ply_type::uint8:
      return binary_.get<std::uint8_t>(what.c_str());
    case Ply_type::int16:
      return binary_.get<std::int16_t>(what.c_str());
    case Ply_type::uint16:
      return binary_.get<std::uint16_t>(what.c_str());
    case Ply_type::int32:
      return binary_.get<std::int32_t>(what.c_str());
    case Ply_type::uint32:
      return binary_.get<std::uint32_t>(what.c_str());
    case Ply_type::float32:
      return static_cast<double>(binary_.get<float>(what.c_str()));
    case Ply_type::float64:
      return binary_.get<double>(what.c_str());
    }
    return 0;
  }

  /// The values of a property, one if it is not a list.
  void values(const Ply_property& property, std::vector<double>& result)
  {
    result.clear();
    double n = 1;
    if (property.count_type) {
      n = value(*property.count_type, property.name);
      if (!(n >= 0) || n != std::floor(n))
        fail("the length of list '" + property.name + "' is not a count");
      if (!is_text_ && n > static_cast<double>(binary_.bytes_left()))
        fail("list '" + property.name + "' is longer than the file");
    }
    for (double i = 0; i < n; ++i)
      result.push_back(value(property.type, property.name));
  }

  [[noreturn]] void fail(const std::string& message) const
  {
    if (is_text_)
      text_.fail(message);
    binary_.fail(message);
  }

private:
  Text_scanner& text_;
  bool is_text_;
  Binary_scanner binary_;
};

class Ply_reader
{
public:
  Ply_reader(std::string_view bytes, const std::string& file_name)
      : bytes_(bytes), file_name_(file_name), text_(bytes, file_name, Text_scanner::plain)
  {}

  Polygon_soup read()
  {
    read_header();
    Ply_rows rows(bytes_, file_name_, text_, order_);
    for (const Ply_element& element : elements_) {
      if (element.properties.empty())
        continue;
      if (element.name == "vertex")
        read_vertices(element, rows);
      else if (element.name == "face")
        read_faces(element, rows);
      else if (element.name == "halfedge")
        read_halfedges(element, rows);
      else
        for (std::size_t i = 0; i < element.count; ++i)
          read_row(element, i, rows);
    }
    if (soup_.number_of_faces() == 0)
      throw IO_error(file_name_ + ": no face in the file");
    finish();
    return std::move(soup_);
  }

private:
  void read_header()
  {
    if (!text_.next_line() || text_.token() != "ply")
      text_.fail("a PLY file begins with the word ply");
    bool has_format = false;
    while (true) {
      if (!text_.next_line())
        text_.fail("the header has no end");
      const std::string_view word = text_.token();
      if (word == "end_header")
        break;
      if (word == "format") {
        read_format();
        has_format = true;
      } else if (word == "element") {
        const std::string name(text_.token());
        const long long n = text_.integer("number of rows");
        if (n < 0 || static_cast<std::size_t>(n) > bytes_.size())
          text_.fail("element '" + name + "' has " + std::to_string(n) +
                     " rows, more than the file can hold");
        elements_.push_back({name, static_cast<std::size_t>(n), {}});
      } else if (word == "property") {
        read_property();
      } else if (word == "comment") {
        if (text_.token() == "TextureFile")
          soup_.page_textures.emplace_back(text_.remainder());
      } else if (word != "obj_info" && !word.empty()) {
        text_.fail("unknown word in the header: " + quoted(word));
      }
    }
    if (!has_format)
      text_.fail("the header does not tell the format");
  }

  void read_format()
  {
    const std::string_view format = text_.token();
    if (format == "binary_little_endian")
      order_ = std::endian::little;
    else if (format == "binary_big_endian")
      order_ = std::endian::big;
    else if (format != "ascii")
      text_.fail("unknown format " + quoted(format));
  }

  void read_property()
  {
    if (elements_.empty())
      text_.fail("a property before the first element");
    Ply_property property;
    std::string_view word = text_.token();
    if (word == "list") {
      property.count_type = type(text_.token());
      word = text_.token();
    }
    property.type = type(word);
    property.name = text_.token();
    elements_.back().properties.push_back(std::move(property));
  }

  Ply_type type(std::string_view word) const
  {
    static constexpr std::pair<std::string_view, Ply_type> types[] = {
        {"char", Ply_type::int8},      {"int8", Ply_type::int8},       {"uchar", Ply_type::uint8},
        {"uint8", Ply_type::uint8},    {"short", Ply_type::int16},     {"int16", Ply_type::int16},
        {"ushort", Ply_type::uint16},  {"uint16", Ply_type::uint16},   {"int", Ply_type::int32},
        {"int32", Ply_type::int32},    {"uint", Ply_type::uint32},     {"uint32", Ply_type::uint32},
        {"float", Ply_type::float32},  {"float32", Ply_type::float32}, {"double", Ply_type::float64},
        {"float64", Ply_type::float64}};
    for (const auto& [name, value] : types)
      if (name == word)
        return value;
    text_.fail("unknown type " + quoted(word));
  }

  /// Reads a row into `row_`, one list of values per property.
  void read_row(const Ply_element& element, std::size_t i, Ply_rows& rows)
  {
    rows.start_row(element, i);
    row_.resize(element.properties.size());
    for (std::size_t k = 0; k < row_.size(); ++k)
      rows.values(element.properties[k], row_[k]);
  }

  /// The single value of a property of the row; 0 if the property is missing or an empty list.
  double at(int property) const
  {
    return property < 0 || row_[property].empty() ? 0 : row_[property].front();
  }

  static double color_range(const Ply_element& element, int property)
  {
    const Ply_type t = element.properties[property].type;
    return t == Ply_type::uint8 || t == Ply_type::int8 ? 255 : t == Ply_type::uint16 ? 65535 : 1;
  }

  void read_vertices(const Ply_element& element, Ply_rows& rows)
  {
    const int x = element.find({"x"}), y = element.find({"y"}), z = element.find({"z"});
    if (x < 0 || y < 0)
      throw IO_error(file_name_ + ": the vertices have no positions x, y, z");
    const int nx = element.find({"nx"}), ny = element.find({"ny"}), nz = element.find({"nz"});
    const int r = element.find({"red", "r", "diffuse_red"}),
              g = element.find({"green", "g", "diffuse_green"}),
              b = element.find({"blue", "b", "diffuse_blue"}),
              a = element.find({"alpha", "a", "diffuse_alpha"});
    const int u = element.find({"texture_u", "texture_s", "u", "s"}),
              v = element.find({"texture_v", "texture_t", "v", "t"});
    const bool has_color = r >= 0 && g >= 0 && b >= 0;
    const double range = has_color ? color_range(element, r) : 1;
    soup_.points.reserve(element.count);
    for (std::size_t i = 0; i < element.count; ++i) {
      read_row(element, i, rows);
      soup_.points.emplace_back(at(x), at(y), at(z));
      if (nx >= 0 && ny >= 0 && nz >= 0)
        soup_.normals.emplace_back(at(nx), at(ny), at(nz));
      if (has_color)
        soup_.colors.push_back({static_cast<float>(at(r) / range), static_cast<float>(at(g) / range),
                                static_cast<float>(at(b) / range),
                                a < 0 ? 1.f : static_cast<float>(at(a) / range)});
      if (u >= 0 && v >= 0)
        vertex_uv_.emplace_back(at(u), at(v));
    }
  }

  void read_faces(const Ply_element& element, Ply_rows& rows)
  {
    const int indices = element.find({"vertex_indices", "vertex_index"}), wedge = element.find({"texcoord"}),
              page = element.find({"texnumber"});
    if (indices < 0 || !element.properties[indices].count_type)
      throw IO_error(file_name_ + ": the faces have no list vertex_indices");
    soup_.first.reserve(element.count + 1);
    for (std::size_t i = 0; i < element.count; ++i) {
      read_row(element, i, rows);
      for (const double v : row_[indices]) {
        if (v != std::floor(v))
          rows.fail("a vertex index is not an integer");
        soup_.vertices.push_back(v >= 0 && v < no_index ? static_cast<Index>(v) : no_index);
      }
      soup_.close_face();
      if (wedge >= 0)
        add_wedge_uv(row_[indices].size(), row_[wedge]);
      if (page >= 0)
        soup_.face_page.push_back(at(page) > 0 && at(page) < most_pages ? static_cast<Index>(at(page)) : 0);
    }
  }

  /// Numbers of textures beyond it are no pages.
  static constexpr double most_pages = 1 << 16;

  void add_wedge_uv(std::size_t corners, const std::vector<double>& values)
  {
    for (std::size_t k = 0; k < corners; ++k)
      soup_.uv.push_back(values.size() == 2 * corners ? Point_2(values[2 * k], values[2 * k + 1])
                                                      : Point_2(NAN, NAN));
  }

  /// CGAL keeps coordinates at halfedges: source, target, u, v, where the target's corner has (u, v).
  void read_halfedges(const Ply_element& element, Ply_rows& rows)
  {
    const int source = element.find({"source"}), target = element.find({"target"}), u = element.find({"u"}),
              v = element.find({"v"});
    const bool has_uv = source >= 0 && target >= 0 && u >= 0 && v >= 0;
    for (std::size_t i = 0; i < element.count; ++i) {
      read_row(element, i, rows);
      if (has_uv)
        halfedge_uv_.insert_or_assign(edge_key(at(source), at(target)), Point_2(at(u), at(v)));
    }
  }

  static std::uint64_t edge_key(double source, double target)
  {
    const auto index = [](double v) {
      return v >= 0 && v < no_index ? static_cast<std::uint64_t>(v) : no_index;
    };
    return index(source) << 32 | index(target);
  }

  void finish()
  {
    const auto exists = [&](Index v) { return v < soup_.points.size(); };
    if (!soup_.face_page.empty() && soup_.number_of_pages() == 1)
      soup_.face_page.clear();
    if (!soup_.normals.empty())
      for (const Index v : soup_.vertices)
        soup_.corner_normal.push_back(exists(v) ? v : no_index);
    if (soup_.uv.empty() && !halfedge_uv_.empty())
      for (std::size_t f = 0; f < soup_.number_of_faces(); ++f)
        add_halfedge_uv(soup_.face(f));
    if (soup_.uv.empty() && !vertex_uv_.empty())
      for (const Index v : soup_.vertices)
        soup_.uv.push_back(exists(v) ? vertex_uv_[v] : Point_2(NAN, NAN));
  }

  void add_halfedge_uv(std::span<const Index> face)
  {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index before = face[k == 0 ? face.size() - 1 : k - 1];
      const auto it = halfedge_uv_.find(std::uint64_t(before) << 32 | face[k]);
      soup_.uv.push_back(it == halfedge_uv_.end() ? Point_2(NAN, NAN) : it->second);
    }
  }

  std::string_view bytes_;
  std::string file_name_;
  Text_scanner text_;
  std::optional<std::endian> order_;
  std::vector<Ply_element> elements_;
  std::vector<std::vector<double>> row_;
  std::vector<Point_2> vertex_uv_;
  std::unordered_map<std::uint64_t, Point_2> halfedge_uv_;
  Polygon_soup soup_;
};

/// Reads a PLY file: text or binary of either byte order, with positions, normals, colours, and
/// texture coordinates in any of three dialects (at the vertices, at the wedges of faces as MeshLab writes
/// them, at the halfedges as CGAL does); MeshLab's numbers of textures are pages. Values at the end of a text
/// row that the header does not declare are skipped. \throw IO_error naming the line or byte
inline Polygon_soup read_ply(const std::filesystem::path& path)
{
  const std::string bytes = read_whole_file(path);
  return Ply_reader(bytes, path.string()).read();
}

} // namespace Atlas::internal

#endif
