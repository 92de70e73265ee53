// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_BAKE_NORMALS_IMPL_H
#define ATLAS_BAKE_INTERNAL_BAKE_NORMALS_IMPL_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/soup/internal/corner_normals.h>

#include <cmath>
#include <vector>

namespace Atlas {

namespace internal {

/// Unit normals per triangle corner: those that the soup has, else smooth ones.
inline std::vector<Vector_3> shading_normals(const Polygon_soup& soup, const Surface& surface)
{
  std::vector<Vector_3> normals =
      corner_normals(surface, facet_normals(surface, normalized_points(surface).points));
  if (soup.corner_normal.empty())
    return normals;
  for (std::size_t h = 0; h < normals.size(); ++h) {
    const Index n = soup.corner_normal[surface.corner[h]];
    if (n >= soup.normals.size())
      continue;
    const double length = std::sqrt(soup.normals[n].squared_length());
    if (length > 0 && std::isfinite(length))
      normals[h] = soup.normals[n] / length;
  }
  return normals;
}

} // namespace internal

ATLAS_INLINE Color color_of_normal(const Vector_3& n)
{
  const double length = std::sqrt(n.squared_length());
  if (!(length > 0))
    return {128, 128, 128};
  return color_of({(n.x() / length + 1) / 2, (n.y() / length + 1) / 2, (n.z() / length + 1) / 2});
}

ATLAS_INLINE Image bake_normals(const Polygon_soup& soup, Image_size size, Index page,
                                const Execution& execution)
{
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  const std::vector<Vector_3> normals = internal::shading_normals(soup, surface);
  const auto color = [&](const Bake_sample& sample) {
    Vector_3 sum(0, 0, 0);
    for (Index i = 0; i < 3; ++i)
      sum = sum + sample.weights[i] * normals[3 * sample.triangle + i];
    return color_of_normal(sum);
  };
  return bake_texture(soup, size, color, page, execution);
}

} // namespace Atlas

#endif
