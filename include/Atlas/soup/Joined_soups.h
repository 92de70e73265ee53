// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_JOINED_SOUPS_H
#define ATLAS_SOUP_JOINED_SOUPS_H

#include <Atlas/core/Kernel.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Several models as one, and the way back.
///
/// Vertices, faces and corners are counted on from one model to the next, as `join_surfaces()` counts them.
/// Materials of the same name are one. Where only some models have an attribute, the others get its usual
/// value: white, no coordinates, no material.
class Joined_soups
{
public:
  explicit Joined_soups(std::vector<Polygon_soup> soups)
  {
    for (const Polygon_soup& soup : soups) {
      has_.colors = has_.colors || !soup.colors.empty();
      has_.uv = has_.uv || !soup.uv.empty();
      has_.normals = has_.normals || !soup.corner_normal.empty();
      has_.materials = has_.materials || !soup.face_material.empty();
      has_.groups = has_.groups || !soup.face_group.empty();
      number_of_points_ += soup.points.size();
    }
    for (Polygon_soup& soup : soups)
      append(std::move(soup));
    start_part(Attributes());
  }

  /// All models as one. It may be changed as long as its lists keep their lengths, but for those of
  /// attributes, which may be filled or emptied, and as long as each vertex stays in its model.
  Polygon_soup& whole() { return whole_; }
  const Polygon_soup& whole() const { return whole_; }

  std::size_t number_of_parts() const { return parts_.size() - 1; }
  std::size_t first_vertex(std::size_t part) const { return parts_[part].vertex; }
  std::size_t first_face(std::size_t part) const { return parts_[part].face; }

  /// One of the models, as it is now.
  Polygon_soup part(std::size_t i) const
  {
    const Part &from = parts_[i], &to = parts_[i + 1];
    Polygon_soup soup;
    slice(whole_.points, soup.points, from.vertex, to.vertex);
    soup.first.clear();
    for (std::size_t f = from.face; f <= to.face; ++f)
      soup.first.push_back(whole_.first[f] - from.corner);
    for (std::size_t c = from.corner; c < to.corner; ++c)
      soup.vertices.push_back(own_vertex(whole_.vertices[c], from.vertex, to.vertex));
    if (from.has.colors)
      slice(whole_.colors, soup.colors, from.vertex, to.vertex);
    slice(whole_.uv, soup.uv, from.corner, to.corner);
    slice(whole_.face_page, soup.face_page, from.face, to.face);
    if (from.has.uv)
      slice(whole_.old_uv, soup.old_uv, from.corner, to.corner);
    if (from.has.normals) {
      slice(whole_.normals, soup.normals, from.normal, to.normal);
      slice(whole_.corner_normal, soup.corner_normal, from.corner, to.corner);
      lower(soup.corner_normal, from.normal);
    }
    soup.material_names = whole_.material_names;
    if (from.has.materials)
      slice(whole_.face_material, soup.face_material, from.face, to.face);
    if (from.has.groups) {
      slice(whole_.group_names, soup.group_names, from.group, to.group);
      slice(whole_.face_group, soup.face_group, from.face, to.face);
      lower(soup.face_group, from.group);
    }
    return soup;
  }

private:
  /// Which attributes there are.
  struct Attributes
  {
    bool colors = false, uv = false, normals = false, materials = false, groups = false;
  };

  /// Where a model starts in each of the lists.
  struct Part
  {
    std::size_t vertex, corner, face, normal, group;
    Attributes has;
  };

  void start_part(const Attributes& has)
  {
    parts_.push_back({whole_.points.size(), whole_.vertices.size(), whole_.number_of_faces(),
                      whole_.normals.size(), whole_.group_names.size(), has});
  }

  template <typename Value>
  static void append_list(std::vector<Value>& list, std::vector<Value>&& more)
  {
    if (list.empty())
      list = std::move(more);
    else
      list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }

  template <typename Value>
  static void slice(const std::vector<Value>& list, std::vector<Value>& result, std::size_t begin,
                    std::size_t end)
  {
    if (list.size() >= end)
      result.assign(list.begin() + static_cast<std::ptrdiff_t>(begin),
                    list.begin() + static_cast<std::ptrdiff_t>(end));
  }

  static void raise(std::vector<Index>& numbers, std::size_t by)
  {
    for (Index& i : numbers)
      i = i == no_index ? i : static_cast<Index>(i + by);
  }
  static void lower(std::vector<Index>& numbers, std::size_t by)
  {
    for (Index& i : numbers)
      i = i == no_index ? i : static_cast<Index>(i - by);
  }

  /// Vertices that do not exist in their model must not become vertices of the next: they get numbers beyond
  /// all.
  Index common_vertex(Index v, std::size_t first, std::size_t size) const
  {
    const std::uint64_t number = v < size ? v + std::uint64_t(first) : v - size + number_of_points_;
    return static_cast<Index>(v == no_index ? no_index : std::min<std::uint64_t>(number, no_index));
  }
  Index own_vertex(Index v, std::size_t first, std::size_t end) const
  {
    return v == no_index            ? no_index
           : v >= number_of_points_ ? static_cast<Index>(v - number_of_points_ + (end - first))
                                    : static_cast<Index>(v - first);
  }

  /// The numbers that the materials of a model have in common.
  std::vector<Index> common_materials(const std::vector<std::string>& names)
  {
    std::vector<Index> result;
    for (const std::string& name : names) {
      auto& all = whole_.material_names;
      const std::size_t old =
          parts_.size() == 1 ? all.size() : 0; // those of the first model stay as they are
      const auto at = std::find(all.begin() + static_cast<std::ptrdiff_t>(old), all.end(), name);
      result.push_back(static_cast<Index>(at - all.begin()));
      if (at == all.end())
        all.push_back(name);
    }
    return result;
  }

  void append(Polygon_soup&& soup)
  {
    const Attributes has{!soup.colors.empty(), !soup.uv.empty(), !soup.corner_normal.empty(),
                         !soup.face_material.empty(), !soup.face_group.empty()};
    start_part(has);
    const Part& part = parts_.back();
    const std::size_t points = soup.points.size(), corners = soup.number_of_corners(),
                      faces = soup.number_of_faces();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (has_.colors)
      soup.colors.resize(points, {1, 1, 1, 1});
    if (has_.uv)
      soup.uv.resize(corners, Point_2(nan, nan));
    if (has_.normals)
      soup.corner_normal.resize(corners, no_index);
    if (has_.materials)
      soup.face_material.resize(faces, no_index);
    if (has_.groups)
      soup.face_group.resize(faces, no_index);
    for (Index& v : soup.vertices)
      v = common_vertex(v, part.vertex, points);
    raise(soup.corner_normal, part.normal);
    raise(soup.face_group, part.group);
    const std::vector<Index> material = common_materials(soup.material_names);
    for (Index& m : soup.face_material)
      m = m == no_index ? m : material[m];

    append_list(whole_.points, std::move(soup.points));
    for (std::size_t f = 1; f <= faces; ++f)
      whole_.first.push_back(soup.first[f] + part.corner);
    append_list(whole_.vertices, std::move(soup.vertices));
    append_list(whole_.colors, std::move(soup.colors));
    append_list(whole_.uv, std::move(soup.uv));
    append_list(whole_.normals, std::move(soup.normals));
    append_list(whole_.corner_normal, std::move(soup.corner_normal));
    append_list(whole_.face_material, std::move(soup.face_material));
    append_list(whole_.group_names, std::move(soup.group_names));
    append_list(whole_.face_group, std::move(soup.face_group));
  }

  Polygon_soup whole_;
  Attributes has_;
  std::size_t number_of_points_ = 0;
  std::vector<Part> parts_; ///< one more closes
};

} // namespace Atlas

#endif
