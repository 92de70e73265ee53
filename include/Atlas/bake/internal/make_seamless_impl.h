// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_MAKE_SEAMLESS_IMPL_H
#define ATLAS_BAKE_INTERNAL_MAKE_SEAMLESS_IMPL_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/seams/Textured_seams.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Atlas {

namespace internal {

/// The size of all pages.
inline Image_size checked_size(const Polygon_soup& soup, const std::vector<Image>& pages)
{
  require(soup.uv.size() == soup.number_of_corners(), "soup", "must have a coordinate per corner");
  require(soup.number_of_faces() == 0 || pages.size() >= soup.number_of_pages(), "pages",
          "must have a picture for each page of the soup");
  for (const Image& page : pages)
    require(page.width == pages[0].width && page.height == pages[0].height && !page.pixels.empty(), "pages",
            "must be of the same size, and not empty");
  return pages.empty() ? Image_size(1) : Image_size(pages[0].width, pages[0].height);
}

inline Texel_components components_of(const std::vector<Image>& pages)
{
  const bool has_alpha =
      std::any_of(pages.begin(), pages.end(), [](const Image& page) { return !page.alpha.empty(); });
  Texel_components result;
  for (std::size_t k = 0; k < (has_alpha ? 4u : 3u); ++k)
    for (const Image& page : pages)
      for (std::size_t i = 0; i < page.pixels.size(); ++i)
        result[k].push_back(k < 3 ? page.pixels[i][k] : page.alpha.empty() ? 255.f : page.alpha[i]);
  return result;
}

inline void put(const Texel_components& components, std::vector<Image>& pages)
{
  std::size_t first = 0;
  for (Image& page : pages) {
    for (std::size_t i = 0; i < page.pixels.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        page.pixels[i][k] = static_cast<std::uint8_t>(components[k][first + i]);
    if (!components[3].empty()) {
      page.alpha.resize(page.pixels.size());
      for (std::size_t i = 0; i < page.alpha.size(); ++i)
        page.alpha[i] = static_cast<std::uint8_t>(components[3][first + i]);
      if (std::all_of(page.alpha.begin(), page.alpha.end(), [](std::uint8_t a) { return a == 255; }))
        page.alpha.clear();
    }
    first += page.pixels.size();
  }
}

} // namespace internal

ATLAS_INLINE Seam_difference seam_difference(const Polygon_soup& soup, const std::vector<Image>& pages,
                                             Texel_meaning meaning)
{
  return internal::Textured_seams(soup, internal::checked_size(soup, pages), meaning)
      .difference(internal::components_of(pages));
}

ATLAS_INLINE Seam_difference make_seamless(const Polygon_soup& soup, std::vector<Image>& pages,
                                           Texel_meaning meaning, const Execution& execution)
{
  const internal::Textured_seams seams(soup, internal::checked_size(soup, pages), meaning);
  internal::Texel_components components = internal::components_of(pages);
  seams.equalize(components, true, execution);
  internal::put(components, pages);
  return seams.difference(components);
}

} // namespace Atlas

#endif
