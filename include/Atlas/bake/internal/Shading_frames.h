// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_SHADING_FRAMES_H
#define ATLAS_BAKE_INTERNAL_SHADING_FRAMES_H

#include <Atlas/bake/internal/Tangent_frames.h>
#include <Atlas/core/Surface.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/corner_normals.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

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

/// \brief The frames of tangent space all over a surface, interpolated as renderers do, and as they do not
/// made unit or orthogonal.
class Shading_frames
{
public:
  /// \pre a coordinate per corner
  Shading_frames(const Polygon_soup& soup, const Surface& surface) : normals_(shading_normals(soup, surface))
  {
    const std::vector<Point_3> points = normalized_points(surface).points;
    const Tangent_frames frames(surface, points, soup, normals_);
    for (Index h = 0; h < normals_.size(); ++h)
      tangents_.push_back(frames.tangent(h));
    for (Index t = 0; t < surface.number_of_triangles(); ++t)
      signs_.push_back(frames.sign(t));
  }

  /// The directions of x, y and z.
  std::array<Vector_3, 3> operator()(Index triangle, const std::array<double, 3>& weights) const
  {
    Vector_3 n(0, 0, 0), t(0, 0, 0);
    for (Index i = 0; i < 3; ++i) {
      n = n + weights[i] * normals_[3 * triangle + i];
      t = t + weights[i] * tangents_[3 * triangle + i];
    }
    return {t, signs_[triangle] * CGAL::cross_product(n, t), n};
  }

  const Vector_3& normal(Index corner) const { return normals_[corner]; }

private:
  std::vector<Vector_3> normals_, tangents_; ///< per corner of a triangle
  std::vector<double> signs_;                ///< per triangle
};

} // namespace Atlas::internal

#endif
