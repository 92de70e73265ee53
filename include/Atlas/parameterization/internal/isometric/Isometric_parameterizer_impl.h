// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_ISOMETRIC_ISOMETRIC_PARAMETERIZER_IMPL_H
#define ATLAS_PARAMETERIZATION_INTERNAL_ISOMETRIC_ISOMETRIC_PARAMETERIZER_IMPL_H

#include <Atlas/measure/distortion.h>
#include <Atlas/parameterization/Bijective_parameterizer.h>
#include <Atlas/parameterization/internal/isometric/unroll.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// Whether lengths are kept but for a small part of the area. Triangles that cannot be measured have none.
inline bool is_isometric(const Chart& chart, double max_stretch)
{
  constexpr double ignored_part = 5e-4;
  double whole = 0, bad = 0;
  for (const Triangle_distortion& t : triangle_distortions(chart)) {
    whole += t.area_3d;
    if (t.area_3d > 0 && !(t.is_measurable() && std::max(t.largest, 1 / t.smallest) <= max_stretch))
      bad += t.area_3d;
  }
  return whole > 0 && bad <= ignored_part * whole;
}

/// Whether every triangle is counterclockwise, or flat in the plane and in space, and none covers another.
inline bool is_one_to_one(const Chart& chart)
{
  std::vector<Triangle_uv> triangles;
  triangles.reserve(chart.triangles.size());
  for (const auto& [a, b, c] : chart.triangles) {
    const auto turn = CGAL::orientation(chart.uv[a], chart.uv[b], chart.uv[c]);
    if (turn == CGAL::RIGHT_TURN ||
        (turn == CGAL::COLLINEAR && !CGAL::collinear(chart.points[a], chart.points[b], chart.points[c])))
      return false;
    triangles.push_back({chart.uv[a], chart.uv[b], chart.uv[c]});
  }
  return is_overlap_free(triangles, opposite_halfedges(chart.triangles));
}

/// Gives vertices that are one in space, and fall together in the plane but for rounding, the same
/// coordinates: the two sides of a cut from hole to hole. O(n log n).
inline void weld_sides_of_cuts(Chart& chart)
{
  constexpr double rounding = 1e-7;
  const CGAL::Bbox_2 box = CGAL::bbox_2(chart.uv.begin(), chart.uv.end());
  const double near = rounding * std::max(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  std::vector<Index> order(chart.points.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Point_3 &p = chart.points[a], &q = chart.points[b];
    return std::tuple(p.x(), p.y(), p.z(), a) < std::tuple(q.x(), q.y(), q.z(), b);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i; k-- > 0 && chart.points[order[k]] == chart.points[order[i]];)
      if (CGAL::squared_distance(chart.uv[order[k]], chart.uv[order[i]]) <= near * near) {
        chart.uv[order[i]] = chart.uv[order[k]];
        break;
      }
}

/// Fills the coordinates of a developable chart; false for any other.
inline bool unroll(Chart& chart, double max_stretch)
{
  if (chart.triangles.empty())
    return false;
  const std::vector<Vec2> place = Chart_unroller(chart)();
  if (place.empty())
    return false;
  const Vec2 axis = dominant_direction(chart, place), back{axis.x, -axis.y};
  chart.uv.clear();
  for (const Vec2 p : place) {
    const Vec2 q = rotated(back, p);
    if (!std::isfinite(q.x) || !std::isfinite(q.y))
      return false;
    chart.uv.emplace_back(q.x, q.y);
  }
  weld_sides_of_cuts(chart);
  return is_isometric(chart, max_stretch) && is_one_to_one(chart);
}

} // namespace internal

ATLAS_INLINE Isometric_parameterizer::Isometric_parameterizer(Any_parameterizer other)
    : other_(std::move(other))
{}

ATLAS_INLINE Chart_status Isometric_parameterizer::parameterize(Chart& chart,
                                                                const Execution& execution) const
{
  Flattening_record record;
  return parameterize(chart, execution, record);
}

ATLAS_INLINE Chart_status Isometric_parameterizer::parameterize(Chart& chart, const Execution& execution,
                                                                Flattening_record& record) const
{
  record = {};
  return internal::unroll(chart, max_stretch) ? Chart_status::valid
                                              : other_.parameterize(chart, execution, record);
}

} // namespace Atlas

#endif
