// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_H
#define ATLAS_PACKING_H

#include <Atlas/Kernel.h>

#include <vector>

namespace Atlas {

/// The default side of a page, in texels.
inline constexpr Index default_texture_size = 1024;
/// The default distance between charts, in texels.
inline constexpr double default_gutter = 2;

/// \brief What a page has to be like.
struct Page_options
{
  Index width = default_texture_size;  ///< texels
  Index height = default_texture_size; ///< texels
  double gutter =
      default_gutter; ///< least distance between two charts in texels; half of it to the page border
};

/// \brief Where a chart goes: x -> s R x + t, from the chart's plane to texels of its page, origin bottom
/// left.
struct Placement
{
  double a = 1, b = 0; ///< the rotation and scale, as the complex number a + ib
  double x = 0, y = 0; ///< the translation, in texels
  Index page = 0;

  Point_2 operator()(const Point_2& p) const
  {
    return Point_2(a * p.x() - b * p.y() + x, b * p.x() + a * p.y() + y);
  }
};

/// \brief The result of a packer. All charts share one density; only their places differ.
struct Packing
{
  std::vector<Placement> placements; ///< per chart
  Index number_of_pages = 0;
  double density = 0; ///< texels per unit of the charts' coordinates
};

} // namespace Atlas

#endif
