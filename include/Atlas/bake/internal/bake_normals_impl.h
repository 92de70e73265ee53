// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_BAKE_NORMALS_IMPL_H
#define ATLAS_BAKE_INTERNAL_BAKE_NORMALS_IMPL_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/Shading_frames.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/soup/internal/index_uv.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas {

ATLAS_INLINE Color color_of_normal(const Vector_3& n)
{
  const double length = std::sqrt(n.squared_length());
  if (!(length > 0))
    return {128, 128, 128};
  constexpr double up = 1 + 1e-9; // no noise where a coordinate is 0 but for rounding: it is 127.5
  return color_of({(n.x() / length + up) / 2, (n.y() / length + up) / 2, (n.z() / length + up) / 2});
}

ATLAS_INLINE Bake_normal shading_normal(const Polygon_soup& soup)
{
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  return [normals = internal::shading_normals(soup, surface)](const Bake_sample& sample) {
    Vector_3 sum(0, 0, 0);
    for (Index i = 0; i < 3; ++i)
      sum = sum + sample.weights[i] * normals[3 * sample.triangle + i];
    return sum;
  };
}

ATLAS_INLINE void add_normals(Polygon_soup& soup)
{
  if (!soup.corner_normal.empty())
    return;
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  const std::vector<Vector_3> normals = internal::shading_normals(soup, surface);
  soup.normals.clear();
  soup.corner_normal.assign(soup.number_of_corners(), no_index);
  internal::Row_table<3> table(normals.size() / 4);
  // Corners of one vertex have summed up the same faces in different orders: they are to be equal.
  const auto rounded = [](double x) { return std::round(x * 65536) / 65536 + 0.0; };
  for (std::size_t h = 0; h < normals.size(); ++h) {
    const Vector_3 n(rounded(normals[h].x()), rounded(normals[h].y()), rounded(normals[h].z()));
    const Index i = table({std::bit_cast<std::uint64_t>(n.x()), std::bit_cast<std::uint64_t>(n.y()),
                           std::bit_cast<std::uint64_t>(n.z())});
    if (i == soup.normals.size())
      soup.normals.push_back(n);
    soup.corner_normal[surface.corner[h]] = i;
  }
}

ATLAS_INLINE Bake_normal in_tangent_space(const Polygon_soup& soup, Bake_normal normal)
{
  internal::require(soup.uv.size() == soup.number_of_corners(), "soup", "must have a coordinate per corner");
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  return [normal = std::move(normal),
          frames = internal::Shading_frames(soup, surface)](const Bake_sample& sample) {
    const auto [t, b, n] = frames(sample.triangle, sample.weights);
    const Vector_3 v = normal(sample);
    const double det = t * CGAL::cross_product(b, n);
    if (det == 0)
      return Vector_3(0, 0, 1);
    return Vector_3(v * CGAL::cross_product(b, n) / det, v * CGAL::cross_product(n, t) / det,
                    v * CGAL::cross_product(t, b) / det);
  };
}

ATLAS_INLINE Image bake_normals(const Polygon_soup& soup, Image_size size, Index page,
                                const Execution& execution)
{
  const Bake_normal normal = shading_normal(soup);
  return bake_texture(
      soup, size, [&](const Bake_sample& sample) { return color_of_normal(normal(sample)); }, page,
      execution);
}

} // namespace Atlas

#endif
