// SPDX-License-Identifier: MIT
#ifndef ATLAS_SOUP_INTERNAL_TRIANGLE_LIST_H
#define ATLAS_SOUP_INTERNAL_TRIANGLE_LIST_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/soup/Polygon_soup.h>
#include <Atlas/soup/internal/corner_normals.h>

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace Atlas::internal {

/// \brief The soup as separate triangles of floats, for renderers: three corners each, scaled into the unit
/// ball about the origin, with normals that are smooth except at sharp edges.
struct Triangle_list
{
  std::vector<float> positions; ///< 3 per corner
  std::vector<float> normals;   ///< 3 per corner
  std::vector<float> uv;        ///< 2 per corner; 0 where the face has none
  std::vector<Index> face;      ///< per triangle: the face of the soup

  explicit Triangle_list(const Polygon_soup& soup)
  {
    const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
    const std::vector<Point_3> points = normalized_points(surface).points;
    const std::vector<Vector_3> corner = corner_normals(surface, facet_normals(surface, points));
    for (Index h = 0; h < 3 * surface.number_of_triangles(); ++h) {
      const Point_3& p = points[surface.triangles[h / 3][h % 3]];
      const Vector_3& n = corner[h];
      const Point_2 t = soup.uv.empty() ? Point_2(0, 0) : soup.uv[surface.corner[h]];
      const bool has_uv = std::isfinite(t.x()) && std::isfinite(t.y());
      append(positions, {p.x(), p.y(), p.z()});
      append(normals, {n.x(), n.y(), n.z()});
      append(uv, {has_uv ? t.x() : 0, has_uv ? t.y() : 0});
    }
    face = surface.face;
  }

private:
  static void append(std::vector<float>& to, std::initializer_list<double> values)
  {
    for (const double value : values)
      to.push_back(static_cast<float>(value));
  }
};

} // namespace Atlas::internal

#endif
