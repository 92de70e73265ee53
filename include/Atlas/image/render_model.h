// SPDX-License-Identifier: MIT
#ifndef ATLAS_IMAGE_RENDER_MODEL_H
#define ATLAS_IMAGE_RENDER_MODEL_H

#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <cstddef>
#include <vector>

namespace Atlas {

/// Where the camera stands: turned about the vertical axis, then raised above the horizon. Degrees.
struct View_direction
{
  /// Where the viewer stands, in degrees.
  double azimuth = 0, elevation = 0; ///< how high, in degrees
};

/// The sides that `render_model()` shows by default: front right, right back, back left, from above.
inline const std::vector<View_direction> default_views = {{30, 15}, {120, 15}, {210, 15}, {300, 55}};

/// \brief A picture of the textured model, lit, from several sides, two by two.
///
/// Part of `Atlas::Rendering`: drawn by Mesa's offscreen renderer, without a display.
/// \param texture  square, a power of two a side; its first row belongs to v = 1
/// \param size     pixels a side of each view
/// \throw IO_error no context can be made
Image render_model(const Polygon_soup& soup, const Image& texture, std::size_t size = 640,
                   const std::vector<View_direction>& views = default_views);

} // namespace Atlas

#ifdef ATLAS_HEADER_ONLY
#include <Atlas/image/internal/rendering/render_model_impl.h>
#endif

#endif
