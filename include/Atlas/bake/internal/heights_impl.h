// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_HEIGHTS_IMPL_H
#define ATLAS_BAKE_INTERNAL_HEIGHTS_IMPL_H

#include <Atlas/bake/internal/bake_texels.h>
#include <Atlas/bake/internal/heights.h>
#include <Atlas/bake/internal/seams/Textured_seams.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/image/Image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace Atlas::internal {

/// Where a place on a mesh is in space.
inline Point_3 point_of(const Polygon_soup& soup, const Bake_sample& sample)
{
  const auto p = sample.mean<std::array<double, 3>>(
      [&](Index corner) -> const Point_3& { return soup.points[soup.vertices[corner]]; });
  return Point_3(p[0], p[1], p[2]);
}

ATLAS_INLINE std::vector<float> heights_of_page(const Polygon_soup& soup, const Polygon_soup& detail,
                                                const std::function<Bake_sample(const Bake_sample&)>& place,
                                                Image_size size, Index page, const Execution& execution)
{
  require(soup.uv.size() == soup.number_of_corners(), "soup", "must have a coordinate per corner");
  const Bake_normal normal = shading_normal(soup);
  const Page_raster raster(soup, size, page);
  const std::vector<bool> is_covered = raster.coverage();
  const auto height = [&](const Bake_sample& sample) {
    const Vector_3 n = normal(sample);
    const double length = std::sqrt(n.squared_length());
    return length > 0 ? (point_of(detail, place(sample)) - point_of(soup, sample)) * n / length : 0;
  };
  std::vector<float> heights(is_covered.size(), 0);
  execution.for_each(size.height, [&](std::size_t row) {
    if (!execution.proceed(double(row) / double(size.height)))
      return;
    for (std::size_t i = row * size.width; i < (row + 1) * size.width; ++i)
      if (is_covered[i])
        heights[i] = static_cast<float>(height(raster.sample(i)));
  });
  const std::vector<Index> nearest = nearest_texels(is_covered, size.width, size.height);
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (nearest[i] != no_index)
      heights[i] = heights[nearest[i]];
  return heights;
}

ATLAS_INLINE Height_maps bake_heights(const Polygon_soup& soup, const Polygon_soup& detail,
                                      const std::function<Bake_sample(const Bake_sample&)>& place,
                                      Image_size size, const Execution& execution)
{
  Height_maps result;
  for (Index page = 0; page < soup.number_of_pages(); ++page) {
    result.pages.push_back(heights_of_page(soup, detail, place, size, page, execution));
    for (const float height : result.pages.back())
      result.largest = std::max(result.largest, std::abs(double(height)));
  }
  return result;
}

ATLAS_INLINE Seams_closed close_seams(const Polygon_soup& soup, Height_maps& heights, Image_size size,
                                      const Execution& execution)
{
  const double scale = heights.largest > 0 ? 127.5 / heights.largest : 0;
  Texel_components shades;
  for (const std::vector<float>& page : heights.pages)
    for (const float height : page)
      shades[0].push_back(static_cast<float>(127.5 + scale * double(height)));
  const Textured_seams seams(soup, size, Texel_meaning::colors);
  Seams_closed result;
  result.before = seams.difference(shades);
  seams.equalize(shades, false, execution);
  result.after = seams.difference(shades);
  std::size_t i = 0;
  for (std::vector<float>& page : heights.pages)
    for (float& height : page)
      height = scale > 0 ? static_cast<float>((double(shades[0][i++]) - 127.5) / scale) : 0;
  return result;
}

ATLAS_INLINE std::string png_of_heights(const Height_maps& heights, std::size_t page, Image_size size)
{
  std::vector<std::uint16_t> grey;
  for (const float height : heights.pages[page]) {
    const double share = heights.largest > 0 ? double(height) / heights.largest : 0;
    grey.push_back(static_cast<std::uint16_t>(std::lround(32767.5 * (1 + std::clamp(share, -1.0, 1.0)))));
  }
  return png_bytes(grey, size);
}

} // namespace Atlas::internal

#endif
