// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_READ_OBJ_H
#define ATLAS_IO_INTERNAL_READ_OBJ_H

#include <Atlas/IO/internal/extension.h>
#include <Atlas/IO/internal/scale_colors.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Numbers names in the order in which they occur first.
class Name_table
{
public:
  explicit Name_table(std::vector<std::string>& names) : names_(names) {}
  Index operator()(std::string_view name)
  {
    const auto [it, is_new] = numbers_.try_emplace(std::string(name), static_cast<Index>(names_.size()));
    if (is_new)
      names_.emplace_back(name);
    return it->second;
  }

private:
  std::vector<std::string>& names_;
  std::map<std::string, Index> numbers_;
};

class Obj_reader
{
public:
  Obj_reader(std::string_view text, const std::string& file_name)
      : scanner_(text, file_name, Text_scanner::hash_comments | Text_scanner::backslash_continues),
        file_name_(file_name)
  {}

  Polygon_soup read()
  {
    while (scanner_.next_line())
      if (!scanner_.at_end())
        read_statement(keyword());
      else if (scanner_.line_text().starts_with("#MRGB"))
        read_painted_colors(scanner_.line_text().substr(5));
    if (soup_.number_of_faces() == 0)
      throw IO_error(file_name_ + ": no face in the file (" + std::to_string(scanner_.line()) + " lines, " +
                     std::to_string(soup_.points.size()) + " vertices)");
    finish();
    return std::move(soup_);
  }

private:
  /// Small letters in the place of capitals, of which some programs make their keywords.
  std::string_view keyword()
  {
    const std::string_view word = scanner_.token();
    if (std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c); }))
      return word;
    keyword_ = lower_case(word);
    return keyword_;
  }

  void read_statement(std::string_view keyword)
  {
    if (keyword == "v")
      read_vertex();
    else if (keyword == "vt")
      read_texture_vertex();
    else if (keyword == "vn")
      read_normal();
    else if (keyword == "f" || keyword == "fo")
      read_face();
    else if (keyword == "usemtl")
      material_ = name_or_none(materials_);
    else if (keyword == "g" || keyword == "o")
      group_ = name_or_none(groups_);
    else if (keyword == "mtllib")
      soup_.material_libraries.emplace_back(scanner_.remainder());
    // Everything else (curves, smoothing groups, points, lines) says nothing about polygons.
  }

  Index name_or_none(Name_table& names)
  {
    const std::string_view name = scanner_.remainder();
    return name.empty() ? no_index : names(name);
  }

  Vector_3 read_vector()
  {
    const double x = scanner_.number("x"), y = scanner_.number("y"), z = scanner_.number("z");
    return Vector_3(x, y, z);
  }

  /// v x y z [w] or v x y z r g b [a]
  void read_vertex()
  {
    const Vector_3 p = read_vector();
    soup_.points.emplace_back(p.x(), p.y(), p.z());
    if (scanner_.at_end())
      return;
    float extra[4] = {1, 1, 1, 1};
    int n = 0;
    while (n < 4 && !scanner_.at_end())
      extra[n++] = static_cast<float>(scanner_.number("vertex attribute"));
    if (n >= 3) {
      soup_.colors.resize(soup_.points.size() - 1, untold_color);
      soup_.colors.push_back({extra[0], extra[1], extra[2], extra[3]});
    }
  }

  /// ZBrush: #MRGB and 8 hexadecimal digits a vertex, mask, red, green, blue, in the order of the vertices.
  void read_painted_colors(std::string_view digits)
  {
    digits.remove_prefix(std::min(digits.size(), digits.find_first_not_of(" \t")));
    for (; digits.size() >= 8; digits.remove_prefix(8)) {
      std::uint32_t value = 0;
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + 8, value, 16);
      if (error != std::errc() || end != digits.data() + 8)
        return;
      const auto component = [&](int shift) { return static_cast<float>(value >> shift & 255) / 255; };
      painted_.push_back({component(16), component(8), component(0), 1});
    }
  }

  /// One that cannot be read keeps its number, and corners that name it have no coordinates.
  void read_texture_vertex()
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    texture_vertices_.emplace_back(nan, nan);
    read_or_tell([&] {
      const double u = scanner_.number("u");
      texture_vertices_.back() = Point_2(u, scanner_.at_end() ? 0 : scanner_.number("v"));
    });
  }

  /// As `read_texture_vertex()`.
  void read_normal()
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    soup_.normals.emplace_back(nan, nan, nan);
    read_or_tell([&] { soup_.normals.back() = read_vector(); });
  }

  /// Of what the surface does not need, the first statement that cannot be read is told of.
  template <typename Read>
  void read_or_tell(Read read)
  {
    try {
      read();
    } catch (const IO_error& error) {
      if (!has_told_)
        soup_.warnings.push_back("line " + std::string(error.what()).substr(file_name_.size() + 1) +
                                 "; texture coordinates and normals that cannot be read are passed over");
      has_told_ = true;
    }
  }

  /// Indices count from 1, negative ones back from the last; what cannot be expressed becomes `no_index`.
  static Index resolve(long long index, std::size_t size)
  {
    const long long i = index > 0 ? index - 1 : index < 0 ? static_cast<long long>(size) + index : -1;
    return i < 0 || i >= no_index ? no_index : static_cast<Index>(i);
  }

  long long read_index(const char* what)
  {
    long long i = 0;
    scanner_.accept('+');
    if (!scanner_.integer_here(i))
      scanner_.fail(std::string(what) + " is not an integer: " + quoted(scanner_.token()));
    scanner_.skip_zero_fraction(); // of programs that know one kind of number
    return i;
  }

  /// f v[/[vt][/vn]] ...
  void read_face()
  {
    while (!scanner_.at_end()) {
      soup_.vertices.push_back(resolve(read_index("vertex index"), soup_.points.size()));
      Index t = no_index, n = no_index;
      if (scanner_.accept('/')) {
        if (!scanner_.accept('/')) {
          if (!scanner_.at_token_end())
            t = resolve(read_index("texture index"), texture_vertices_.size());
          if (scanner_.accept('/') && !scanner_.at_token_end())
            n = resolve(read_index("normal index"), soup_.normals.size());
        } else if (!scanner_.at_token_end())
          n = resolve(read_index("normal index"), soup_.normals.size());
      }
      if (!scanner_.at_token_end())
        scanner_.fail("a corner is not of the form v/vt/vn: " + quoted(scanner_.token()));
      if (t != no_index) {
        corner_texture_.resize(soup_.vertices.size() - 1, no_index);
        corner_texture_.push_back(t);
      }
      if (n != no_index) {
        soup_.corner_normal.resize(soup_.vertices.size() - 1, no_index);
        soup_.corner_normal.push_back(n);
      }
    }
    if (soup_.vertices.size() >= no_index)
      scanner_.fail("more than 4294967294 corners");
    soup_.close_face();
    soup_.face_material.push_back(material_);
    soup_.face_group.push_back(group_);
  }

  void finish()
  {
    if (soup_.colors.empty())
      soup_.colors = std::move(painted_);
    if (!soup_.colors.empty())
      soup_.colors.resize(soup_.points.size(), untold_color);
    scale_colors(soup_.colors);
    if (!corner_texture_.empty()) {
      corner_texture_.resize(soup_.vertices.size(), no_index);
      const double nan = std::numeric_limits<double>::quiet_NaN();
      soup_.uv.reserve(corner_texture_.size());
      for (const Index t : corner_texture_)
        soup_.uv.push_back(t < texture_vertices_.size() ? texture_vertices_[t] : Point_2(nan, nan));
    }
    if (!soup_.corner_normal.empty()) {
      soup_.corner_normal.resize(soup_.vertices.size(), no_index);
      for (Index& n : soup_.corner_normal)
        if (n >= soup_.normals.size() || !std::isfinite(soup_.normals[n].x()))
          n = no_index;
    }
    if (soup_.material_names.empty())
      soup_.face_material.clear();
    if (soup_.group_names.empty())
      soup_.face_group.clear();
  }

  Text_scanner scanner_;
  std::string file_name_;
  Polygon_soup soup_;
  Name_table materials_{soup_.material_names}, groups_{soup_.group_names};
  std::vector<Point_2> texture_vertices_;
  std::vector<Index> corner_texture_;
  std::vector<std::array<float, 4>> painted_;
  Index material_ = no_index, group_ = no_index;
  std::string keyword_;
  bool has_told_ = false;
};

/// Reads a Wavefront OBJ file.
///
/// Understands relative indices, polygons, comments, continued lines, all line ends, `v` with w or with
/// colours, `vt`, `vn`, `usemtl`, `mtllib`, `o` and `g` (one group name a face, the latest). Vertices may
/// come after the faces that name them. Statements that are unknown are skipped. \throw IO_error naming the
/// line, if a statement cannot be understood, or if there is no face
inline Polygon_soup read_obj(const std::filesystem::path& path)
{
  const std::string text = read_text_file(path);
  return Obj_reader(text, path.string()).read();
}

} // namespace Atlas::internal

#endif
