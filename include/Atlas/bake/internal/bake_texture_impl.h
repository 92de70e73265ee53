// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_BAKE_TEXTURE_IMPL_H
#define ATLAS_BAKE_INTERNAL_BAKE_TEXTURE_IMPL_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/bake_texels.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace Atlas {

ATLAS_INLINE Image bake_texture(const Polygon_soup& soup, Image_size size, const Bake_shader& shader,
                                Index page, const Execution& execution)
{
  return internal::bake_texels(
      soup, size, [&](const Bake_sample& sample) { return internal::Texel{shader(sample)}; }, page,
      execution);
}

ATLAS_INLINE double differing_share(const Polygon_soup& soup, Image_size size, const Bake_shader& shader,
                                    Index page)
{
  internal::require(soup.uv.size() == soup.number_of_corners(), "soup", "must have a coordinate per corner");
  constexpr int tolerance = 16;
  const internal::Page_raster raster(soup, size, page);
  std::size_t differing = 0;
  for (const auto& [texel, triangle] : raster.covered_before()) {
    const Color above = shader(raster.sample(texel)), below = shader(raster.sample(texel, triangle));
    bool differs = false;
    for (std::size_t k = 0; k < 3; ++k)
      differs = differs || std::abs(int(above[k]) - int(below[k])) > tolerance;
    differing += differs;
  }
  const std::size_t all = raster.covered_before().size();
  return all == 0 ? 0 : static_cast<double>(differing) / static_cast<double>(all);
}

ATLAS_INLINE Color color_of(const std::array<double, 3>& components)
{
  Color color;
  for (std::size_t k = 0; k < 3; ++k)
    color[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(components[k], 0.0, 1.0)));
  return color;
}

ATLAS_INLINE Bake_shader vertex_color_shader(const Polygon_soup& soup)
{
  const bool has_vertices = soup.colors.size() == soup.points.size(),
             has_faces = soup.face_colors.size() == soup.number_of_faces();
  internal::require(has_vertices || has_faces, "soup", "must have a colour per vertex or face");
  return [&soup, has_vertices, has_faces](const Bake_sample& sample) {
    std::array<double, 3> mean{1, 1, 1};
    if (has_vertices)
      mean = sample.mean<std::array<double, 3>>([&](Index c) { return soup.colors[soup.vertices[c]]; });
    const bool is_white = mean[0] == 1 && mean[1] == 1 && mean[2] == 1;
    for (std::size_t k = 0; k < 3 && has_faces && is_white; ++k)
      mean[k] = static_cast<double>(soup.face_colors[sample.face][k]);
    return color_of(mean);
  };
}

ATLAS_INLINE Image bake_vertex_colors(const Polygon_soup& soup, Image_size size, Index page)
{
  return bake_texture(soup, size, vertex_color_shader(soup), page);
}

ATLAS_INLINE Image bake_procedural(const Polygon_soup& soup, Image_size size,
                                   const std::function<Color(const Point_3&)>& color_at, Index page)
{
  const auto color = [&](const Bake_sample& sample) {
    const auto p = sample.mean<std::array<double, 3>>(
        [&](Index c) -> const Point_3& { return soup.points[soup.vertices[c]]; });
    return color_at(Point_3(p[0], p[1], p[2]));
  };
  return bake_texture(soup, size, color, page);
}

} // namespace Atlas

#endif
