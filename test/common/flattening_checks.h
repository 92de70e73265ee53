// SPDX-License-Identifier: MIT
// Charts on which flattenings break, and what a flattening is worth by independent definitions.
#ifndef ATLAS_TEST_FLATTENING_CHECKS_H
#define ATLAS_TEST_FLATTENING_CHECKS_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/halfedges.h>

#include "test_meshes.h"
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace Atlas::test {

/// Whether a chart is one-to-one, without the code under test: all triangles counterclockwise, and no two
/// border edges meet but at their common ends.
inline bool is_one_to_one(const Chart& chart)
{
  for (const auto& [a, b, c] : chart.triangles)
    if (CGAL::orientation(chart.uv[a], chart.uv[b], chart.uv[c]) != CGAL::LEFT_TURN)
      return false;
  std::vector<std::pair<Index, Index>> border;
  const std::vector<Index> opposite = internal::opposite_halfedges(chart.triangles);
  for (Index h = 0; h < opposite.size(); ++h)
    if (opposite[h] == no_index) {
      const Index g = next_halfedge(h);
      border.emplace_back(chart.triangles[h / 3][h % 3], chart.triangles[g / 3][g % 3]);
    }
  for (std::size_t i = 0; i < border.size(); ++i)
    for (std::size_t j = i + 1; j < border.size(); ++j) {
      const auto [a, b] = border[i];
      const auto [c, d] = border[j];
      const Kernel::Segment_2 s(chart.uv[a], chart.uv[b]), t(chart.uv[c], chart.uv[d]);
      if (a == d || b == c) {
        const Index p = a == d ? b : a, q = a == d ? c : d;
        if (p != q && (s.has_on(chart.uv[q]) || t.has_on(chart.uv[p])))
          return false;
      } else if (CGAL::do_intersect(s, t))
        return false;
    }
  return true;
}

/// Mean symmetric Dirichlet energy over 4, from singular values by lengths and areas.
inline double mean_energy(const Chart& chart)
{
  double sum = 0, total = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    const Vector_3 p = chart.points[b] - chart.points[a], q = chart.points[c] - chart.points[a];
    const Vector_2 s = chart.uv[b] - chart.uv[a], t = chart.uv[c] - chart.uv[a];
    const double space = std::sqrt(CGAL::cross_product(p, q).squared_length()),
                 plane = s.x() * t.y() - s.y() * t.x();
    // |J|^2 = trace of G^-1 H with the first fundamental forms G in space and H in the plane
    const double squares = ((q * q) * (s * s) - 2 * (p * q) * (s * t) + (p * p) * (t * t)) / (space * space);
    sum += space * squares * (1 + space * space / (plane * plane));
    total += space;
  }
  return sum / total / 4;
}

inline Chart height_field(Index n, double noise, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(-noise / n, noise / n);
  return chart_of(grid(n, n, [&](double x, double y) { return Point_3(x, y, height(random)); }));
}

/// A ramp that winds around an axis: flat in the plane it covers itself.
inline Chart spiral(double turns, Index length = 60, Index width = 3)
{
  return chart_of(grid(length, width, [=](double x, double y) {
    const double angle = 2 * M_PI * turns * x, r = 1 + y;
    return Point_3(r * std::cos(angle), r * std::sin(angle), 0.1 * angle);
  }));
}

/// A closed tube of quads, open only by one missing triangle at its end.
inline Chart tube(Index rings)
{
  Soup soup = grid(
      6, rings,
      [=](double x, double y) { return Point_3(std::cos(2 * M_PI * x), std::sin(2 * M_PI * x), y * rings); },
      true);
  soup.points.emplace_back(0, 0, -1);
  for (Index i = 0; i < 6; ++i)
    soup.polygons.push_back({(i + 1) % 6, i, static_cast<Index>(soup.points.size() - 1)});
  return chart_of(soup);
}

} // namespace Atlas::test

#endif
