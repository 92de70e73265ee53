// SPDX-License-Identifier: MIT
// Small meshes made by formula, for the tests.
#ifndef ATLAS_TEST_MESHES_H
#define ATLAS_TEST_MESHES_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/extract_charts.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace Atlas::test {

/// Points and polygons, the plainest mesh there is.
struct Soup
{
  std::vector<Point_3> points;
  std::vector<std::vector<Index>> polygons;
};

inline Surface surface_of(const Soup& soup)
{
  std::vector<std::size_t> first{0};
  std::vector<Index> vertices;
  for (const auto& polygon : soup.polygons) {
    vertices.insert(vertices.end(), polygon.begin(), polygon.end());
    first.push_back(vertices.size());
  }
  return build_surface(soup.points, first, vertices);
}

/// The whole surface as one chart without cuts.
inline Segmentation one_chart(const Surface& surface)
{
  return {std::vector<Index>(surface.number_of_triangles(), 0),
          std::vector<std::uint8_t>(3 * surface.number_of_triangles(), 0),
          surface.triangles.empty() ? 0u : 1u};
}

inline Chart chart_of(const Soup& soup)
{
  const Surface surface = surface_of(soup);
  return extract_charts(surface, one_chart(surface)).at(0);
}

/// A grid of m x n cells over [0,1]^2, mapped to space by `f`; two triangles a cell, or one quad.
/// With `wrap_x` (`wrap_y`) the last column (row) of cells closes up to the first.
inline Soup grid(Index m, Index n, const std::function<Point_3(double, double)>& f, bool wrap_x = false,
                 bool wrap_y = false, bool quads = false)
{
  Soup soup;
  const Index columns = wrap_x ? m : m + 1, rows = wrap_y ? n : n + 1;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i)
      soup.points.push_back(f(double(i) / m, double(j) / n));
  const auto at = [&](Index i, Index j) { return (j % rows) * columns + i % columns; };
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i) {
      const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (quads)
        soup.polygons.push_back({a, b, c, d});
      else
        soup.polygons.insert(soup.polygons.end(), {{a, b, c}, {a, c, d}});
    }
  return soup;
}

inline Soup planar_grid(Index m, Index n)
{
  return grid(m, n, [](double x, double y) { return Point_3(x, y, 0); });
}

inline Soup torus(Index m, Index n, double radius = 1, double tube = 0.4)
{
  return grid(
      m, n,
      [=](double x, double y) {
        const double u = 2 * M_PI * x, v = 2 * M_PI * y, r = radius + tube * std::cos(v);
        return Point_3(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
      },
      true, true);
}

/// A unit cube of six quads.
inline Soup cube()
{
  Soup soup;
  for (int i = 0; i < 8; ++i)
    soup.points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  soup.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return soup;
}

/// A unit sphere: an octahedron, every triangle split into four `levels` times.
inline Soup sphere(int levels)
{
  Soup soup;
  soup.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  soup.polygons = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto midpoint = [&](Index a, Index b) {
      const auto [it, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<Index>(soup.points.size()));
      if (is_new) {
        const Vector_3 v = (soup.points[a] - CGAL::ORIGIN) + (soup.points[b] - CGAL::ORIGIN);
        soup.points.push_back(CGAL::ORIGIN + v / std::sqrt(v.squared_length()));
      }
      return it->second;
    };
    std::vector<std::vector<Index>> finer;
    for (const auto& t : soup.polygons) {
      const Index a = midpoint(t[0], t[1]), b = midpoint(t[1], t[2]), c = midpoint(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    soup.polygons = std::move(finer);
  }
  return soup;
}

} // namespace Atlas::test

#endif
