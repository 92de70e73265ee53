// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_JOINED_SOUPS_IMPL_H
#define ATLAS_SOUP_INTERNAL_JOINED_SOUPS_IMPL_H

#include <Atlas/core/internal/library.h>
#include <Atlas/soup/Joined_soups.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

namespace Atlas {

namespace internal {

template <typename Value>
void append_list(std::vector<Value>& list, std::vector<Value>&& more)
{
  if (list.empty())
    list = std::move(more);
  else
    list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

template <typename Value>
void slice(const std::vector<Value>& list, std::vector<Value>& result, std::size_t begin, std::size_t end)
{
  if (list.size() >= end)
    result.assign(list.begin() + static_cast<std::ptrdiff_t>(begin),
                  list.begin() + static_cast<std::ptrdiff_t>(end));
}

inline void raise(std::vector<Index>& numbers, std::size_t by)
{
  for (Index& i : numbers)
    i = i == no_index ? i : static_cast<Index>(i + by);
}
inline void lower(std::vector<Index>& numbers, std::size_t by)
{
  for (Index& i : numbers)
    i = i == no_index ? i : static_cast<Index>(i - by);
}

} // namespace internal

ATLAS_INLINE Joined_soups::Joined_soups(std::vector<Polygon_soup> soups)
{
  for (const Polygon_soup& soup : soups) {
    has_.colors = has_.colors || !soup.colors.empty();
    has_.face_colors = has_.face_colors || !soup.face_colors.empty();
    has_.uv = has_.uv || !soup.uv.empty();
    has_.normals = has_.normals || !soup.corner_normal.empty();
    has_.materials = has_.materials || !soup.face_material.empty();
    has_.groups = has_.groups || !soup.face_group.empty();
    has_.pages = has_.pages || !soup.face_page.empty();
    number_of_points_ += soup.points.size();
  }
  for (Polygon_soup& soup : soups)
    append(std::move(soup));
  start_part(Attributes());
}

ATLAS_INLINE Polygon_soup Joined_soups::part(std::size_t i) const
{
  const Part &from = parts_[i], &to = parts_[i + 1];
  Polygon_soup soup;
  internal::slice(whole_.points, soup.points, from.vertex, to.vertex);
  soup.first.clear();
  for (std::size_t f = from.face; f <= to.face; ++f)
    soup.first.push_back(whole_.first[f] - from.corner);
  for (std::size_t c = from.corner; c < to.corner; ++c)
    soup.vertices.push_back(own_vertex(whole_.vertices[c], from.vertex, to.vertex));
  if (from.has.colors)
    internal::slice(whole_.colors, soup.colors, from.vertex, to.vertex);
  if (from.has.face_colors)
    internal::slice(whole_.face_colors, soup.face_colors, from.face, to.face);
  internal::slice(whole_.uv, soup.uv, from.corner, to.corner);
  internal::slice(whole_.face_page, soup.face_page, from.face, to.face);
  if (from.has.uv)
    internal::slice(whole_.old_uv, soup.old_uv, from.corner, to.corner);
  if (from.has.normals) {
    internal::slice(whole_.normals, soup.normals, from.normal, to.normal);
    internal::slice(whole_.corner_normal, soup.corner_normal, from.corner, to.corner);
    internal::lower(soup.corner_normal, from.normal);
  }
  soup.material_names = whole_.material_names;
  if (from.has.materials)
    internal::slice(whole_.face_material, soup.face_material, from.face, to.face);
  if (from.has.groups) {
    internal::slice(whole_.group_names, soup.group_names, from.group, to.group);
    internal::slice(whole_.face_group, soup.face_group, from.face, to.face);
    internal::lower(soup.face_group, from.group);
  }
  return soup;
}

ATLAS_INLINE void Joined_soups::start_part(const Attributes& has)
{
  parts_.push_back({whole_.points.size(), whole_.vertices.size(), whole_.number_of_faces(),
                    whole_.normals.size(), whole_.group_names.size(), has});
}

ATLAS_INLINE Index Joined_soups::common_vertex(Index v, std::size_t first, std::size_t size) const
{
  const std::uint64_t number = v < size ? v + std::uint64_t(first) : v - size + number_of_points_;
  return static_cast<Index>(v == no_index ? no_index : std::min<std::uint64_t>(number, no_index));
}

ATLAS_INLINE Index Joined_soups::own_vertex(Index v, std::size_t first, std::size_t end) const
{
  return v == no_index            ? no_index
         : v >= number_of_points_ ? static_cast<Index>(v - number_of_points_ + (end - first))
                                  : static_cast<Index>(v - first);
}

ATLAS_INLINE std::vector<Index> Joined_soups::common_materials(const std::vector<std::string>& names)
{
  std::vector<Index> result;
  for (const std::string& name : names) {
    auto& all = whole_.material_names;
    const std::size_t old = parts_.size() == 1 ? all.size() : 0; // those of the first model stay as they are
    const auto at = std::find(all.begin() + static_cast<std::ptrdiff_t>(old), all.end(), name);
    result.push_back(static_cast<Index>(at - all.begin()));
    if (at == all.end())
      all.push_back(name);
  }
  return result;
}

ATLAS_INLINE void Joined_soups::append(Polygon_soup&& soup)
{
  const Attributes has{!soup.colors.empty(),        !soup.face_colors.empty(),   !soup.uv.empty(),
                       !soup.corner_normal.empty(), !soup.face_material.empty(), !soup.face_group.empty(),
                       !soup.face_page.empty()};
  start_part(has);
  const Part& part = parts_.back();
  const std::size_t points = soup.points.size(), corners = soup.number_of_corners(),
                    faces = soup.number_of_faces();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (has_.colors)
    soup.colors.resize(points, {1, 1, 1, 1});
  if (has_.face_colors)
    soup.face_colors.resize(faces, {1, 1, 1, 1});
  if (has_.uv)
    soup.uv.resize(corners, Point_2(nan, nan));
  if (has_.normals)
    soup.corner_normal.resize(corners, no_index);
  if (has_.materials)
    soup.face_material.resize(faces, no_index);
  if (has_.groups)
    soup.face_group.resize(faces, no_index);
  if (has_.pages)
    soup.face_page.resize(faces, 0);
  for (Index& v : soup.vertices)
    v = common_vertex(v, part.vertex, points);
  internal::raise(soup.corner_normal, part.normal);
  internal::raise(soup.face_group, part.group);
  const std::vector<Index> material = common_materials(soup.material_names);
  for (Index& m : soup.face_material)
    m = m == no_index ? m : material[m];

  internal::append_list(whole_.points, std::move(soup.points));
  for (std::size_t f = 1; f <= faces; ++f)
    whole_.first.push_back(soup.first[f] + part.corner);
  internal::append_list(whole_.vertices, std::move(soup.vertices));
  internal::append_list(whole_.colors, std::move(soup.colors));
  internal::append_list(whole_.face_colors, std::move(soup.face_colors));
  internal::append_list(whole_.uv, std::move(soup.uv));
  internal::append_list(whole_.normals, std::move(soup.normals));
  internal::append_list(whole_.corner_normal, std::move(soup.corner_normal));
  internal::append_list(whole_.face_material, std::move(soup.face_material));
  internal::append_list(whole_.group_names, std::move(soup.group_names));
  internal::append_list(whole_.face_group, std::move(soup.face_group));
  internal::append_list(whole_.face_page, std::move(soup.face_page));
}

} // namespace Atlas

#endif
