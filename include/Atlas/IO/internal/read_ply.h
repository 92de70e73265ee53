// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_PLY_H
#define ATLAS_IO_INTERNAL_READ_PLY_H

#include <Atlas/IO/internal/Ply_rows.h>
#include <Atlas/IO/internal/scale_colors.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Atlas::internal {

class Ply_reader
{
public:
  Ply_reader(std::string_view bytes, const std::string& file_name, Row_ends ends)
      : bytes_(bytes), file_name_(file_name), text_(bytes, file_name, Text_scanner::plain), ends_(ends)
  {}

  /// Whether the header has been understood, and text follows.
  bool may_have_free_rows() const { return has_header_ && !order_; }

  Polygon_soup read()
  {
    read_header();
    has_header_ = true;
    Ply_rows rows(bytes_, file_name_, text_, order_, ends_);
    for (const Ply_element& element : elements_) {
      const std::string name = lower_case(element.name);
      if (element.properties.empty())
        continue;
      if (name == "vertex" || name == "vertices")
        read_vertices(element, rows);
      else if (name == "face" || name == "faces")
        read_faces(element, rows);
      else if (name == "tristrips")
        read_strips(element, rows);
      else if (name == "halfedge")
        read_halfedges(element, rows);
      else
        for (std::size_t i = 0; i < element.count; ++i)
          read_row(element, i, rows);
    }
    rows.check_end();
    if (soup_.number_of_faces() == 0)
      throw IO_error(file_name_ + ": no face in the file");
    finish();
    return std::move(soup_);
  }

private:
  void read_header()
  {
    if (!text_.next_line() || lower_case(text_.token()) != "ply")
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
        soup_.warnings.push_back("line " + std::to_string(text_.line()) +
                                 " of the header is taken for a comment: it begins with " + quoted(word));
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
    const std::optional<Ply_type> result = ply_type(word);
    if (!result)
      text_.fail("unknown type " + quoted(word));
    return *result;
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

  void add_color(const Ply_colors& columns, std::vector<std::array<float, 4>>& colors) const
  {
    std::array<float, 4> color{1, 1, 1, 1};
    for (std::size_t k = 0; k < 4; ++k)
      if (columns.at[k] >= 0)
        color[k] = static_cast<float>(at(columns.at[k]) / columns.range);
    colors.push_back(color);
  }

  void read_vertices(const Ply_element& element, Ply_rows& rows)
  {
    const int x = element.find({"x"}), y = element.find({"y"}), z = element.find({"z"});
    if (x < 0 || y < 0)
      throw IO_error(file_name_ + ": the vertices have no positions x, y, z");
    const int nx = element.find({"nx"}), ny = element.find({"ny"}), nz = element.find({"nz"});
    const int u = element.find({"texture_u", "texture_s", "u", "s"}),
              v = element.find({"texture_v", "texture_t", "v", "t"});
    const Ply_colors color = ply_colors(element);
    // A file may have several elements of this name, not all with the same properties.
    const bool has_normals = nx >= 0 && ny >= 0 && nz >= 0, has_uv = u >= 0 && v >= 0;
    fill_vertices(color.is_complete(), has_normals, has_uv);
    soup_.points.reserve(element.count);
    for (std::size_t i = 0; i < element.count; ++i) {
      read_row(element, i, rows);
      soup_.points.emplace_back(at(x), at(y), at(z));
      if (has_normals)
        soup_.normals.emplace_back(at(nx), at(ny), at(nz));
      if (color.is_complete())
        add_color(color, soup_.colors);
      if (has_uv)
        vertex_uv_.emplace_back(at(u), at(v));
    }
    fill_vertices(!soup_.colors.empty(), !soup_.normals.empty(), !vertex_uv_.empty());
  }

  /// Gives the vertices so far that have no value of these properties the one that says so.
  void fill_vertices(bool has_colors, bool has_normals, bool has_uv)
  {
    const std::size_t n = soup_.points.size();
    if (has_colors)
      soup_.colors.resize(n, untold_color);
    if (has_normals)
      soup_.normals.resize(n, Vector_3(0, 0, 0));
    if (has_uv)
      vertex_uv_.resize(n, Point_2(NAN, NAN));
  }

  static Index vertex(double v, const Ply_rows& rows)
  {
    if (v != std::floor(v))
      rows.fail("a vertex index is not an integer");
    return v >= 0 && v < no_index ? static_cast<Index>(v) : no_index;
  }

  /// The list of vertices: by its usual names, else the only list of integers.
  int indices_of(const Ply_element& element) const
  {
    const auto property_at = [&](int i) { return element.properties[static_cast<std::size_t>(i)]; };
    const auto is_list = [&](int i) {
      const Ply_type t = property_at(i).type;
      return property_at(i).count_type && t != Ply_type::float32 && t != Ply_type::float64;
    };
    int found =
        element.find({"vertex_indices", "vertex_index", "vertex_indexes", "vertex_indicies", "indices"});
    for (int i = 0, lists = 0; found < 0 && i < static_cast<int>(element.properties.size()); ++i)
      if (is_list(i))
        found = lists++ == 0 ? i : -1;
    if (found < 0 || !property_at(found).count_type)
      throw IO_error(file_name_ + ": the rows of '" + element.name + "' have no list vertex_indices");
    return found;
  }

  /// Strips of triangles, of which every second one is turned; -1 ends a strip. Triangles that name a vertex
  /// twice only lead from one place to another.
  void read_strips(const Ply_element& element, Ply_rows& rows)
  {
    const int indices = indices_of(element);
    for (std::size_t i = 0; i < element.count; ++i) {
      read_row(element, i, rows);
      std::vector<Index> strip;
      for (const double v : row_[indices]) {
        strip.push_back(vertex(v, rows));
        if (v == -1 || v == no_index) // as an unsigned number
          strip.clear();
        if (strip.size() >= 3)
          add_triangle_of_strip(strip);
      }
    }
  }

  void add_triangle_of_strip(const std::vector<Index>& strip)
  {
    const std::size_t n = strip.size();
    std::array<Index, 3> triangle{strip[n - 3], strip[n - 2], strip[n - 1]};
    if (n % 2 == 0)
      std::swap(triangle[0], triangle[1]);
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      return;
    soup_.vertices.insert(soup_.vertices.end(), triangle.begin(), triangle.end());
    soup_.close_face();
  }

  void read_faces(const Ply_element& element, Ply_rows& rows)
  {
    const int indices = indices_of(element), wedge = element.find({"texcoord"}),
              page = element.find({"texnumber"});
    const Ply_colors color = ply_colors(element);
    // Strips and faces before these may have none of it.
    if (wedge >= 0)
      soup_.uv.resize(soup_.number_of_corners(), Point_2(NAN, NAN));
    if (color.is_complete())
      soup_.face_colors.resize(soup_.number_of_faces(), untold_color);
    if (page >= 0)
      soup_.face_page.resize(soup_.number_of_faces(), 0);
    soup_.first.reserve(element.count + 1);
    for (std::size_t i = 0; i < element.count; ++i) {
      read_row(element, i, rows);
      for (const double v : row_[indices])
        soup_.vertices.push_back(vertex(v, rows));
      soup_.close_face();
      if (color.is_complete())
        add_color(color, soup_.face_colors);
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
    // Strips and faces behind the others.
    if (!soup_.face_colors.empty())
      soup_.face_colors.resize(soup_.number_of_faces(), untold_color);
    scale_colors(soup_.colors);
    scale_colors(soup_.face_colors);
    if (!soup_.face_page.empty())
      soup_.face_page.resize(soup_.number_of_faces(), 0);
    if (!soup_.uv.empty())
      soup_.uv.resize(soup_.number_of_corners(), Point_2(NAN, NAN));
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
  Row_ends ends_;
  bool has_header_ = false;
  std::optional<std::endian> order_;
  std::vector<Ply_element> elements_;
  std::vector<std::vector<double>> row_;
  std::vector<Point_2> vertex_uv_;
  std::unordered_map<std::uint64_t, Point_2> halfedge_uv_;
  Polygon_soup soup_;
};

/// Reads a PLY file: text or binary of either byte order, with positions, normals, colours of vertices and
/// faces, triangle strips, and texture coordinates in any of three dialects (at the vertices, at the wedges
/// of faces as MeshLab writes them, at the halfedges as CGAL does); MeshLab's numbers of textures are pages.
///
/// Values at the end of a text row that the header does not declare are skipped. Where the rows of a text
/// file have no lines of their own, line ends are blanks. \throw IO_error naming the line or byte
inline Polygon_soup read_ply(const std::filesystem::path& path)
{
  const std::string name = path.string();
  std::string bytes = read_whole_file(path);
  if (std::string_view(bytes).substr(0, bytes.find("end_header")).find("format binary") == std::string::npos)
    bytes = decoded_text(std::move(bytes), name);
  return read_with_any_row_ends<Ply_reader>(bytes, name);
}

} // namespace Atlas::internal

#endif
