// SPDX-License-Identifier: MIT
#ifndef ATLAS_IO_INTERNAL_WRITE_PLY_IMPL_H
#define ATLAS_IO_INTERNAL_WRITE_PLY_IMPL_H

#include <Atlas/IO/write_model.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/soup/internal/split_vertices.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace Atlas {

namespace internal {

class Ply_writer
{
public:
  Ply_writer(const Polygon_soup& soup, const std::string& texture, Ply_texcoord_style style, Index pages)
      : soup_(soup), is_wedge_(style == Ply_texcoord_style::wedge),
        pages_(std::max(pages, soup.number_of_pages()))
  {
    if (is_wedge_)
      keep_vertices();
    else
      split();
    has_normals_ = !split_.normal.empty();
    has_vertex_uv_ = !is_wedge_ && !soup.uv.empty();
    has_wedge_uv_ = is_wedge_ && !soup.uv.empty();
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
      longest_ = std::max(longest_, soup.face(f).size());
    write_header(texture);
    for (std::size_t v = 0; v < split_.number_of_vertices(); ++v)
      write_vertex(v);
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
      write_face(f);
  }

  std::string take() { return std::move(bytes_); }

private:
  void split()
  {
    if (soup_.number_of_pages() <= 1) {
      split_ = split_vertices(soup_);
      return;
    }
    Polygon_soup tiles = soup_;
    tiles.uv = udim_uv(soup_);
    split_ = split_vertices(tiles);
  }

  /// Wedges need no splits. A vertex can have one normal only: that of its first corner.
  void keep_vertices()
  {
    split_.original.resize(soup_.points.size());
    std::iota(split_.original.begin(), split_.original.end(), Index(0));
    split_.corner = soup_.vertices;
    if (soup_.corner_normal.empty())
      return;
    split_.normal.assign(soup_.points.size(), no_index);
    for (std::size_t c = 0; c < soup_.number_of_corners(); ++c)
      if (const Index v = soup_.vertices[c]; v < soup_.points.size() && split_.normal[v] == no_index)
        split_.normal[v] = soup_.corner_normal[c];
  }

  void write_header(const std::string& texture)
  {
    bytes_ = "ply\nformat binary_little_endian 1.0\ncomment written by Atlas\n";
    for (Index page = 0; !texture.empty() && page < pages_; ++page)
      bytes_ += "comment TextureFile " + page_file_name(texture, page, pages_) + '\n';
    bytes_ += "element vertex " + std::to_string(split_.number_of_vertices()) +
              "\nproperty double x\nproperty double y\nproperty double z\n";
    if (has_normals_)
      bytes_ += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!soup_.colors.empty())
      bytes_ += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
    if (has_vertex_uv_)
      bytes_ += "property float texture_u\nproperty float texture_v\n";
    bytes_ += "element face " + std::to_string(soup_.number_of_faces()) + "\nproperty list " +
              count_type(longest_) + " int vertex_indices\n";
    if (!soup_.face_colors.empty())
      bytes_ += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
    if (has_wedge_uv_)
      bytes_ += "property list " + count_type(2 * longest_) + " float texcoord\nproperty int texnumber\n";
    bytes_ += "end_header\n";
  }

  static std::string count_type(std::size_t longest) { return longest < 256 ? "uchar" : "uint"; }

  void write_count(std::size_t count, std::size_t longest)
  {
    if (longest < 256)
      put(static_cast<std::uint8_t>(count));
    else
      put(static_cast<std::uint32_t>(count));
  }

  template <typename Number>
  void put(Number value)
  {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if constexpr (std::endian::native == std::endian::big)
      std::reverse(raw, raw + sizeof raw);
    bytes_.append(raw, sizeof raw);
  }

  void put_uv(const Point_2& p)
  {
    put(static_cast<float>(p.x()));
    put(static_cast<float>(p.y()));
  }

  void put_color(const std::array<float, 4>& color)
  {
    for (const float c : color)
      put(static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.f, 1.f))));
  }

  void write_vertex(std::size_t v)
  {
    const Index original = split_.original[v];
    for (int k = 0; k < 3; ++k)
      put(soup_.points[original][k]);
    if (has_normals_) {
      const Index n = split_.normal[v];
      for (int k = 0; k < 3; ++k)
        put(n == no_index ? 0.f : static_cast<float>(soup_.normals[n][k]));
    }
    if (!soup_.colors.empty())
      put_color(soup_.colors[original]);
    if (has_vertex_uv_)
      put_uv(split_.uv[v]);
  }

  void write_face(std::size_t f)
  {
    write_count(soup_.face(f).size(), longest_);
    for (std::size_t c = soup_.first[f]; c < soup_.first[f + 1]; ++c)
      put(static_cast<std::int32_t>(split_.corner[c]));
    if (!soup_.face_colors.empty())
      put_color(soup_.face_colors[f]);
    if (!has_wedge_uv_)
      return;
    write_count(2 * soup_.face(f).size(), 2 * longest_);
    for (std::size_t c = soup_.first[f]; c < soup_.first[f + 1]; ++c)
      put_uv(soup_.uv[c]);
    put(static_cast<std::int32_t>(soup_.page(f)));
  }

  const Polygon_soup& soup_;
  bool is_wedge_, has_normals_ = false, has_vertex_uv_ = false, has_wedge_uv_ = false;
  Index pages_;
  Split_vertices split_;
  std::size_t longest_ = 0;
  std::string bytes_;
};

} // namespace internal

ATLAS_INLINE std::string ply_bytes(const Polygon_soup& soup, const std::string& texture,
                                   Ply_texcoord_style style, Index pages)
{
  return internal::Ply_writer(soup, texture, style, pages).take();
}

ATLAS_INLINE void write_ply(const std::filesystem::path& path, const Polygon_soup& soup,
                            const std::string& texture, Ply_texcoord_style style)
{
  internal::write_whole_file(path, ply_bytes(soup, texture, style));
}

} // namespace Atlas

#endif
