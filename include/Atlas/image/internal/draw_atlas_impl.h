// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_INTERNAL_DRAW_ATLAS_IMPL_H
#define ATLAS_IMAGE_INTERNAL_DRAW_ATLAS_IMPL_H

#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/internal/color_scale.h>
#include <Atlas/image/internal/fill_polygon.h>
#include <Atlas/image/internal/hue.h>
#include <Atlas/image/pages.h>
#include <Atlas/soup/internal/index_uv.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <unordered_map>
#include <utility>

namespace Atlas {

namespace internal {

/// \brief Draws faces on the page at twice the size of the picture.
class Atlas_painter
{
public:
  Atlas_painter(const Polygon_soup& soup, Image_size size, Index page)
      : soup_(soup), page_(page), image_(2 * size.width, 2 * size.height, {252, 252, 250}),
        uv_(index_uv(soup.uv))
  {}

  void fill_faces(const std::function<Color(std::size_t)>& color_of_face)
  {
    std::vector<Point_2> polygon;
    for (std::size_t f = 0; f < soup_.number_of_faces(); ++f) {
      if (!is_drawn(f))
        continue;
      polygon.clear();
      for (std::size_t c = soup_.first[f]; c < soup_.first[f + 1]; ++c)
        polygon.push_back(pixel(uv_.corner[c]));
      const Color color = color_of_face(f);
      fill_polygon(polygon, image_.width, image_.height,
                   [&](std::size_t x, std::size_t y) { image_.at(x, y) = color; });
    }
  }

  /// Draws the borders of charts: edges of the page that only one face has.
  void draw_borders(const Color& color)
  {
    for (const auto& [edge, count] : sorted_edges())
      if (count == 1)
        draw_edge(edge, [&](std::size_t x, std::size_t y) { image_.at(x, y) = color; });
  }

  /// Darkens the edges inside charts.
  void draw_inner_edges()
  {
    for (const auto& [edge, count] : sorted_edges())
      if (count > 1)
        draw_edge(edge, [&](std::size_t x, std::size_t y) {
          for (std::uint8_t& c : image_.at(x, y))
            c = static_cast<std::uint8_t>(c * 7 / 8);
        });
  }

  Image picture() const { return halved(image_); }

private:
  bool is_drawn(std::size_t f) const
  {
    if (soup_.page(f) != page_)
      return false;
    for (std::size_t c = soup_.first[f]; c < soup_.first[f + 1]; ++c)
      if (c >= uv_.corner.size() || uv_.corner[c] == no_index)
        return false;
    return soup_.first[f + 1] - soup_.first[f] >= 3;
  }

  Point_2 pixel(Index uv) const
  {
    const Point_2& p = uv_.points[uv];
    return Point_2(p.x() * static_cast<double>(image_.width),
                   (1 - p.y()) * static_cast<double>(image_.height));
  }

  /// Every edge with the number of faces that have it.
  const std::vector<std::pair<std::uint64_t, int>>& sorted_edges()
  {
    if (!edges_.empty())
      return edges_;
    std::vector<std::uint64_t> all;
    for (std::size_t f = 0; f < soup_.number_of_faces(); ++f) {
      if (!is_drawn(f))
        continue;
      for (std::size_t c = soup_.first[f]; c < soup_.first[f + 1]; ++c) {
        const std::uint64_t a = uv_.corner[c],
                            b = uv_.corner[c + 1 == soup_.first[f + 1] ? soup_.first[f] : c + 1];
        all.push_back(std::min(a, b) << 32 | std::max(a, b));
      }
    }
    std::sort(all.begin(), all.end());
    for (const std::uint64_t edge : all) {
      if (edges_.empty() || edges_.back().first != edge)
        edges_.emplace_back(edge, 0);
      ++edges_.back().second;
    }
    return edges_;
  }

  template <typename Plot>
  void draw_edge(std::uint64_t edge, Plot plot) const
  {
    draw_segment(pixel(static_cast<Index>(edge >> 32)), pixel(static_cast<Index>(edge)), image_.width,
                 image_.height, plot);
  }

  const Polygon_soup& soup_;
  Index page_;
  Image image_;
  Indexed_uv uv_;
  std::vector<std::pair<std::uint64_t, int>> edges_;
};

} // namespace internal

ATLAS_INLINE Image draw_atlas(const Polygon_soup& soup, const std::vector<Index>& face_chart, Image_size size,
                              const std::vector<Index>& flagged, Index page)
{
  internal::require(face_chart.size() == soup.number_of_faces(), "face_chart", "must have an entry per face");
  std::vector<bool> is_flagged(soup.number_of_faces(), false);
  for (const Index f : flagged) {
    internal::require(f < is_flagged.size(), "flagged", "must name faces that exist");
    is_flagged[f] = true;
  }
  internal::Atlas_painter painter(soup, size, page);
  painter.fill_faces([&](std::size_t f) {
    return is_flagged[f] ? Color{230, 20, 20} : internal::color_of_chart(face_chart[f]);
  });
  if (soup.number_of_faces() <= most_faces_with_edges)
    painter.draw_inner_edges();
  painter.draw_borders({40, 40, 48});
  return painter.picture();
}

ATLAS_INLINE Color color_of_stretch(double stretch)
{
  return std::isfinite(stretch) ? internal::color_of_heat(std::log(stretch) / std::log(hottest_stretch))
                                : Color{128, 128, 128};
}

ATLAS_INLINE Image draw_stretch(const Polygon_soup& soup, const std::vector<double>& stretch, Image_size size,
                                Index page)
{
  internal::require(stretch.size() == soup.number_of_faces(), "stretch", "must have an entry per face");
  internal::Atlas_painter painter(soup, size, page);
  painter.fill_faces([&](std::size_t f) { return color_of_stretch(stretch[f]); });
  painter.draw_borders({40, 40, 48});
  return painter.picture();
}

ATLAS_INLINE Image with_stretch_scale(const Image& picture)
{
  const std::size_t size = picture.width, dot = std::max<std::size_t>(size / 320, 1);
  Image image(size, picture.height + size / 12);
  paste(picture, image, 0, 0);
  const std::size_t left = size / 8, width = size - 2 * left, top = picture.height + size / 60,
                    bottom = top + size / 40;
  for (std::size_t x = 0; x < width; ++x)
    for (std::size_t y = top; y < bottom; ++y)
      image.at(left + x, y) = internal::color_of_heat(static_cast<double>(x) / static_cast<double>(width));
  for (const auto& [text, value] : std::initializer_list<std::pair<const char*, double>>{
           {"1", 1}, {"1.2", 1.2}, {"1.4", 1.4}, {"1.6", 1.6}, {"1.8", 1.8}, {"2", 2}}) {
    const double x = std::log(value) / std::log(hottest_stretch) * static_cast<double>(width);
    internal::draw_number(image, text, left + static_cast<std::size_t>(x) - 4 * dot, bottom + 2 * dot, dot);
  }
  return image;
}

} // namespace Atlas

#endif
