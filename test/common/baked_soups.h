// SPDX-License-Identifier: MIT
// Meshes with coordinates that are easy to tell, for the tests of baking.
#ifndef ATLAS_TEST_BAKED_SOUPS_H
#define ATLAS_TEST_BAKED_SOUPS_H

#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include "test_meshes.h"

namespace Atlas::test {

inline Polygon_soup polygon_soup_of(const Soup& soup)
{
  Polygon_soup result;
  result.points = soup.points;
  for (const auto& polygon : soup.polygons) {
    result.vertices.insert(result.vertices.end(), polygon.begin(), polygon.end());
    result.close_face();
  }
  return result;
}

/// Quads in a grid on the page, each in a square of its own with a margin of a quarter.
inline Polygon_soup faces_side_by_side(const Soup& quads)
{
  Polygon_soup soup = polygon_soup_of(quads);
  std::size_t columns = 1;
  while (columns * columns < soup.number_of_faces())
    ++columns;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = static_cast<double>(f % columns) + (i == 1 || i == 2 ? 0.75 : 0.25);
      const double y = static_cast<double>(f / columns) + (i >= 2 ? 0.75 : 0.25);
      soup.uv.emplace_back(x / static_cast<double>(columns), y / static_cast<double>(columns));
    }
  return soup;
}

/// The texel at a place in [0, 1]^2 of a quad.
inline Color texel_in_face(const Image& image, const Polygon_soup& soup, std::size_t f, double s, double t)
{
  const Point_2 &low = soup.uv[soup.first[f]], &high = soup.uv[soup.first[f] + 2];
  const double u = low.x() + s * (high.x() - low.x()), v = low.y() + t * (high.y() - low.y());
  return image.at(static_cast<std::size_t>(u * static_cast<double>(image.width)),
                  static_cast<std::size_t>((1 - v) * static_cast<double>(image.height)));
}

} // namespace Atlas::test

#endif
