// SPDX-License-Identifier: MIT
// Shapes on which a segmentation shows what it does.
#ifndef ATLAS_TEST_SEGMENTATION_SHAPES_H
#define ATLAS_TEST_SEGMENTATION_SHAPES_H

#include "test_meshes.h"
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace Atlas::test {

/// Adds a soup; equal positions are joined later, by build_surface().
inline void append(Soup& to, const Soup& from)
{
  const auto offset = static_cast<Index>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (std::vector<Index> polygon : from.polygons) {
    for (Index& v : polygon)
      v += offset;
    to.polygons.push_back(std::move(polygon));
  }
}

/// A surface of rotation about z from a polyline of (radius, height), m segments around, n along each piece.
/// Radius zero at an end closes it.
inline Soup lathe(const std::vector<std::pair<double, double>>& profile, Index m, Index n, bool quads = false)
{
  const auto pieces = static_cast<Index>(profile.size() - 1);
  Soup soup = grid(
      m, n * pieces,
      [&](double x, double y) {
        const double s = y * pieces;
        const auto i = std::min<std::size_t>(static_cast<std::size_t>(s + 1e-9), pieces - 1);
        const double u = s - static_cast<double>(i), a = 2 * M_PI * x;
        const double r = profile[i].first + u * (profile[i + 1].first - profile[i].first);
        const double z = profile[i].second + u * (profile[i + 1].second - profile[i].second);
        return r < 1e-9 ? Point_3(0, 0, z) : Point_3(r * std::cos(a), r * std::sin(a), z);
      },
      true, false, quads);
  // The poles: one vertex instead of a row of them.
  const auto rows = n * pieces + 1;
  for (auto& polygon : soup.polygons) {
    for (Index& v : polygon)
      if ((v < m && profile.front().first == 0) || (v >= m * (rows - 1) && profile.back().first == 0))
        v = v / m * m;
    polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    if (polygon.size() > 1 && polygon.front() == polygon.back())
      polygon.pop_back();
  }
  std::erase_if(soup.polygons, [](const auto& polygon) { return polygon.size() < 3; });
  return soup;
}

inline Soup open_cylinder(bool quads = false)
{
  return lathe({{1, 0}, {1, 4}}, 48, 30, quads);
}

inline Soup capped_cylinder(bool quads = false)
{
  return lathe({{0, 0}, {1, 0}, {1, 1.5}, {1, 3}, {0, 3}}, 48, 10, quads);
}

inline Soup ellipsoid(double length)
{
  Soup soup = sphere(4);
  for (Point_3& p : soup.points)
    p = Point_3(p.x(), p.y(), length * p.z());
  return soup;
}

/// A unit cube of n x n quads a side, each vertex moved by up to `noise` in every direction.
inline Soup noisy_cube(Index n, double noise)
{
  Soup soup;
  for (int side = 0; side < 6; ++side)
    append(soup, grid(
                     n, n,
                     [&](double x, double y) {
                       std::array<double, 3> p{};
                       p[side % 3] = side / 3;
                       p[(side + 1) % 3] = side / 3 ? x : y;
                       p[(side + 2) % 3] = side / 3 ? y : x;
                       return Point_3(p[0], p[1], p[2]);
                     },
                     false, false, false));
  std::map<Point_3, Vector_3> moves; // vertices in one place move together
  std::mt19937 random(3);
  std::uniform_real_distribution<double> move(-noise, noise);
  for (Point_3& p : soup.points) {
    const auto [it, is_new] = moves.try_emplace(p);
    if (is_new) {
      const double z = move(random), y = move(random), x = move(random); // one order with every compiler
      it->second = Vector_3(x, y, z);
    }
    p = p + it->second;
  }
  return soup;
}

/// A square sheet [0,1]^2 around (0.5, 0.5) out of which a finger with a round tip rises: radius 0.25, height
/// 1.25. 32 edges around, in rings from the rim of the sheet to the tip.
inline Soup finger(double at_x, double at_y)
{
  constexpr Index sides = 32, flat = 5, wall = 16, cap = 5;
  Soup soup;
  const auto rim = [&](Index j) { // on the square, side by side
    const double s = double(j % 8) / 8;
    switch (j / 8 % 4) {
    case 0:
      return Point_2(s, 0);
    case 1:
      return Point_2(1, s);
    case 2:
      return Point_2(1 - s, 1);
    default:
      return Point_2(0, 1 - s);
    }
  };
  const Index rings = flat + wall + cap;
  for (Index ring = 0; ring < rings; ++ring)
    for (Index j = 0; j < sides; ++j) {
      const double a = 2 * M_PI * (j + 0.) / sides - 3 * M_PI / 4;
      const double cx = 0.5 + 0.25 * std::cos(a), cy = 0.5 + 0.25 * std::sin(a);
      double x = cx, y = cy, z = 0;
      if (ring < flat) {
        const double u = double(ring) / flat;
        x = rim(j).x() + u * (cx - rim(j).x());
        y = rim(j).y() + u * (cy - rim(j).y());
      } else if (ring < flat + wall)
        z = double(ring - flat) / wall;
      else {
        const double b = M_PI / 2 * double(ring - flat - wall) / cap;
        x = 0.5 + 0.25 * std::cos(b) * std::cos(a);
        y = 0.5 + 0.25 * std::cos(b) * std::sin(a);
        z = 1 + 0.25 * std::sin(b);
      }
      soup.points.emplace_back(at_x + x, at_y + y, z);
    }
  for (Index ring = 0; ring + 1 < rings; ++ring)
    for (Index j = 0; j < sides; ++j) {
      const Index a = ring * sides + j, b = ring * sides + (j + 1) % sides, c = b + sides, d = a + sides;
      soup.polygons.insert(soup.polygons.end(), {{a, b, c}, {a, c, d}});
    }
  const auto tip = static_cast<Index>(soup.points.size());
  soup.points.emplace_back(at_x + 0.5, at_y + 0.5, 1.25);
  for (Index j = 0; j < sides; ++j)
    soup.polygons.push_back({(rings - 1) * sides + j, (rings - 1) * sides + (j + 1) % sides, tip});
  return soup;
}

/// An open sheet with four fingers in a row.
inline Soup glove()
{
  Soup soup;
  for (int i = 0; i < 4; ++i)
    append(soup, finger(i, 0));
  return soup;
}

/// A glove: a palm of 4 x 1 x 4 units with four fingers on top and a thumb at its side. Open at the wrist
/// unless `is_closed`. Its x runs across the fingers, its z from the wrist, -4, to the fingers, 0.
inline Soup whole_glove(bool is_closed = false)
{
  Soup soup = glove();
  const auto add = [&](Soup side, const std::function<Point_3(const Point_3&)>& place) {
    for (Point_3& p : side.points)
      p = place(p);
    append(soup, side);
  };
  const auto sheet = [](Index m, Index n) { // eight edges a unit, as fingers have
    return grid(8 * m, 8 * n, [&](double x, double y) { return Point_3(m * x, n * y, 0); });
  };
  add(sheet(4, 4), [](const Point_3& p) { return Point_3(p.x(), 0, p.y() - 4); });
  add(sheet(4, 4), [](const Point_3& p) { return Point_3(p.y(), 1, p.x() - 4); });
  add(sheet(4, 1), [](const Point_3& p) { return Point_3(0, p.y(), p.x() - 4); });
  for (int i = 0; i < 4; ++i)
    add(i == 2 ? finger(0, 0) : sheet(1, 1),
        [i](const Point_3& p) { return Point_3(4 + p.z(), p.x(), p.y() + i - 4); });
  if (is_closed)
    add(sheet(1, 4), [](const Point_3& p) { return Point_3(p.y(), p.x(), -4); });
  return soup;
}

} // namespace Atlas::test

#endif
