// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_BAKE_NORMALS_H
#define ATLAS_BAKE_BAKE_NORMALS_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/soup/internal/corner_normals.h>

#include <array>
#include <cmath>
#include <cstddef>
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

/// \brief The colour of a direction in a map of normals: a unit vector's coordinates from [-1, 1] to
/// [0, 255].
inline Color color_of_normal(const Vector_3& n)
{
  const double length = std::sqrt(n.squared_length());
  if (!(length > 0))
    return {128, 128, 128};
  return color_of({(n.x() / length + 1) / 2, (n.y() / length + 1) / 2, (n.z() / length + 1) / 2});
}

/// \brief The normals of the surface as a texture, in the coordinates of the model ("object space", which
/// needs no tangents).
///
/// The normals of the soup where it has them, else normals that are smooth except at edges sharper than
/// 45 degrees; in between they are interpolated. Linear in texels and triangles. \param page which one
inline Image bake_normals(const Polygon_soup& soup, Image_size size, Index page = 0,
                          const Execution& execution = Execution())
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
