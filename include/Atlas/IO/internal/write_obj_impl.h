// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_WRITE_OBJ_IMPL_H
#define ATLAS_IO_INTERNAL_WRITE_OBJ_IMPL_H

#include <Atlas/IO/internal/page_material_name.h>
#include <Atlas/IO/write_model.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/soup/internal/index_uv.h>
#include <Atlas/soup/internal/number_text.h>

#include <cstddef>
#include <initializer_list>

namespace Atlas {

namespace internal {

inline void append_statement(std::string& text, const char* keyword, std::initializer_list<double> numbers)
{
  text += keyword;
  for (const double x : numbers) {
    text += ' ';
    append_number(text, x);
  }
  text += '\n';
}

inline void append_vertices(std::string& text, const Polygon_soup& soup)
{
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const Point_3& p = soup.points[v];
    if (soup.colors.empty()) {
      append_statement(text, "v", {p.x(), p.y(), p.z()});
      continue;
    }
    append_statement(text, "v", {p.x(), p.y(), p.z()});
    text.pop_back();
    for (int k = 0; k < (soup.colors[v][3] < 1 ? 4 : 3); ++k) {
      text += ' ';
      append_number(text, soup.colors[v][k]);
    }
    text += '\n';
  }
}

/// Indices that do not exist come out as they came in; `no_index` as 0.
inline void append_face(std::string& text, const Polygon_soup& soup, const std::vector<Index>& texture,
                        std::size_t f)
{
  text += 'f';
  for (std::size_t c = soup.first[f]; c < soup.first[f + 1]; ++c) {
    const Index t = texture.empty() ? no_index : texture[c];
    const Index n = soup.corner_normal.empty() ? no_index : soup.corner_normal[c];
    text += ' ';
    append_number(text, static_cast<Index>(soup.vertices[c] + 1));
    if (t != no_index || n != no_index)
      text += '/';
    if (t != no_index)
      append_number(text, t + 1);
    if (n != no_index) {
      text += '/';
      append_number(text, n + 1);
    }
  }
  text += '\n';
}

} // namespace internal

ATLAS_INLINE std::string obj_text(const Polygon_soup& soup, const std::string& material_library,
                                  Page_style style)
{
  std::string text = "# written by Atlas\n";
  if (!material_library.empty())
    text += "mtllib " + material_library + '\n';
  text.reserve(60 * soup.points.size() + 40 * soup.number_of_corners());
  internal::append_vertices(text, soup);
  const internal::Indexed_uv uv = internal::index_uv(style == Page_style::udim ? udim_uv(soup) : soup.uv);
  for (const Point_2& p : uv.points)
    internal::append_statement(text, "vt", {p.x(), p.y()});
  for (const Vector_3& n : soup.normals)
    internal::append_statement(text, "vn", {n.x(), n.y(), n.z()});

  const bool has_materials = !soup.face_material.empty();
  const bool names_pages = style == Page_style::materials && soup.number_of_pages() > 1;
  Index group = no_index, material = no_index, page = names_pages ? no_index : 0;
  if (!material_library.empty() && !names_pages)
    text += std::string("usemtl ") + default_material_name + '\n';
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    if (!soup.face_group.empty() && soup.face_group[f] != group) {
      group = soup.face_group[f];
      text += "g " + (group == no_index ? "default" : soup.group_names[group]) + '\n';
    }
    const Index own_material = has_materials ? soup.face_material[f] : no_index;
    const Index own_page = names_pages ? soup.page(f) : 0;
    if (own_material != material || own_page != page) {
      material = own_material;
      page = own_page;
      text += "usemtl " + internal::page_material_name(soup, material, page, names_pages) + '\n';
    }
    internal::append_face(text, soup, uv.corner, f);
  }
  return text;
}

ATLAS_INLINE std::string mtl_text(const Polygon_soup& soup, const std::string& texture, Page_style style,
                                  bool has_alpha)
{
  std::string text = "# written by Atlas\n";
  const Index pages = soup.number_of_pages();
  const bool names_pages = style == Page_style::materials && pages > 1;
  const auto append = [&](Index material) {
    for (Index page = 0; page < (names_pages ? pages : 1); ++page) {
      std::string picture = page_file_name(texture, page, pages);
      if (pages > 1 && !names_pages)
        picture.replace(picture.rfind(".1001") + 1, 4, "<UDIM>");
      text += "newmtl " + internal::page_material_name(soup, material, page, names_pages) +
              "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " + picture + '\n' +
              (has_alpha ? "map_d " + picture + '\n' : "");
    }
  };
  append(no_index);
  for (Index m = 0; m < soup.material_names.size(); ++m)
    if (soup.material_names[m] != default_material_name)
      append(m);
  return text;
}

ATLAS_INLINE void write_obj(const std::filesystem::path& path, const Polygon_soup& soup,
                            const std::string& texture, Page_style style)
{
  std::filesystem::path library = path;
  library.replace_extension(".mtl");
  internal::Output_files files;
  files.add(library, mtl_text(soup, texture, style));
  files.add(path, obj_text(soup, library.filename().string(), style));
  files.commit();
}

ATLAS_INLINE void write_obj(const std::filesystem::path& path, const Polygon_soup& soup)
{
  internal::write_whole_file(path, obj_text(soup, ""));
}

} // namespace Atlas

#endif
