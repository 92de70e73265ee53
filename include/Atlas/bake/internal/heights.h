// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_HEIGHTS_H
#define ATLAS_BAKE_INTERNAL_HEIGHTS_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/Execution.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace Atlas::internal {

/// How far another mesh is from the places of a mesh, along the normals.
struct Height_maps
{
  std::vector<std::vector<float>> pages; ///< per page and texel, row by row, in the unit of the model
  double largest = 0;                    ///< of the absolute values
};

/// How much the two sides of seams differed, and how much they still do.
struct Seams_closed
{
  Seam_difference before, after;
};

/// The heights of a page, per texel, row by row. What no chart covers has the height of the nearest texel of
/// one.
/// \param place  on the other mesh. O(texels) places; zero heights once cancelled
std::vector<float> heights_of_page(const Polygon_soup& soup, const Polygon_soup& detail,
                                   const std::function<Bake_sample(const Bake_sample&)>& place,
                                   Image_size size, Index page, const Execution& execution);

/// The heights of all pages.
Height_maps bake_heights(const Polygon_soup& soup, const Polygon_soup& detail,
                         const std::function<Bake_sample(const Bake_sample&)>& place, Image_size size,
                         const Execution& execution);

/// As `make_seamless()` does; 255 stands for twice the largest height.
Seams_closed close_seams(const Polygon_soup& soup, Height_maps& heights, Image_size size,
                         const Execution& execution);

/// The bytes of a grey PNG file of 16 bits, linear. White is the largest height, black as far inwards.
std::string png_of_heights(const Height_maps& heights, std::size_t page, Image_size size);

} // namespace Atlas::internal

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/bake/internal/heights_impl.h>
#endif

#endif
