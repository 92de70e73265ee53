// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_BUILD_SURFACE_IMPL_H
#define ATLAS_CORE_INTERNAL_BUILD_SURFACE_IMPL_H

#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/equal_points.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/core/internal/pair_doubled_faces.h>
#include <Atlas/core/internal/triangulate_polygon.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace Atlas {

namespace internal {

/// The first reason for which a polygon takes no part, if there is one; else its distinct consecutive
/// corners.
inline bool usable_corners(const std::vector<Point_3>& points, std::span<const Index> polygon,
                           std::vector<Index>& corners, Rejection& reason)
{
  corners.clear();
  for (Index i = 0; i < polygon.size(); ++i) {
    if (polygon[i] >= points.size()) {
      reason = Rejection::bad_index;
      return false;
    }
    if (!is_finite(points[polygon[i]])) {
      reason = Rejection::not_finite;
      return false;
    }
    if (corners.empty() || polygon[corners.back()] != polygon[i])
      corners.push_back(i);
  }
  while (corners.size() > 1 && polygon[corners.back()] == polygon[corners.front()])
    corners.pop_back();
  reason = Rejection::too_few_corners;
  return corners.size() >= 3;
}

} // namespace internal

namespace internal {

/// Fills the triangles of the surface from its polygons; lists those that cannot take part.
inline void triangulate_polygons(Surface& surface, const std::vector<std::size_t>& first,
                                 const std::vector<Index>& vertices)
{
  std::vector<Index> corners;
  std::vector<std::array<Index, 3>> pieces;
  for (std::size_t f = 0; f < surface.number_of_faces; ++f) {
    const std::span<const Index> polygon(vertices.data() + first[f], first[f + 1] - first[f]);
    Rejection reason{};
    if (!usable_corners(surface.points, polygon, corners, reason)) {
      surface.rejected.push_back({static_cast<Index>(f), reason});
      continue;
    }
    triangulate_polygon(
        corners.size(), [&](std::size_t i) { return surface.points[polygon[corners[i]]]; }, pieces);
    for (const auto& piece : pieces) {
      std::array<Index, 3> triangle;
      for (int i = 0; i < 3; ++i) {
        triangle[i] = polygon[corners[piece[i]]];
        surface.corner.push_back(static_cast<Index>(first[f] + corners[piece[i]]));
      }
      surface.triangles.push_back(triangle);
      surface.face.push_back(static_cast<Index>(f));
    }
  }
}

/// Pairs the diagonals of each polygon.
inline void pair_diagonals(Surface& surface)
{
  const auto corner = [&](Index h) { return surface.corner[h]; };
  std::vector<Index> candidates;
  for (std::size_t t = 0; t < surface.triangles.size();) {
    std::size_t end = t;
    candidates.clear();
    for (; end < surface.triangles.size() && surface.face[end] == surface.face[t]; ++end)
      for (Index i = 0; i < 3; ++i)
        candidates.push_back(static_cast<Index>(3 * end) + i);
    if (end - t > 1)
      pair_halfedges(
          candidates, corner, [&](Index h) { return corner(next_halfedge(h)); }, surface.opposite);
    t = end;
  }
}

/// The halfedges without an opposite.
inline std::vector<Index> open_halfedges(const Surface& surface)
{
  std::vector<Index> result;
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (surface.opposite[h] == no_index)
      result.push_back(h);
  return result;
}

} // namespace internal

ATLAS_INLINE Surface build_surface(std::vector<Point_3> points, const std::vector<std::size_t>& first,
                                   const std::vector<Index>& vertices)
{
  internal::require(std::is_sorted(first.begin(), first.end()) &&
                        (first.empty() || first.back() <= vertices.size()),
                    "first", "must not decrease, and end with at most the number of corners");
  Surface surface;
  surface.points = std::move(points);
  surface.number_of_faces = first.empty() ? 0 : first.size() - 1;
  surface.number_of_corners = vertices.size();
  internal::triangulate_polygons(surface, first, vertices);

  // Diagonals pair within their polygon, the other edges over the whole mesh.
  surface.opposite.assign(3 * surface.triangles.size(), no_index);
  internal::pair_diagonals(surface);
  const auto vertex = [&](Index h) { return surface.triangles[h / 3][h % 3]; };
  internal::pair_halfedges(
      internal::open_halfedges(surface), vertex, [&](Index h) { return vertex(next_halfedge(h)); },
      surface.opposite);
  const std::vector<Index> open = internal::open_halfedges(surface);
  if (!open.empty()) {
    const std::vector<Index> merged = internal::merge_equal_points(surface.points);
    const auto place = [&](Index h) { return merged[vertex(h)]; };
    internal::pair_halfedges(
        open, place, [&](Index h) { return place(next_halfedge(h)); }, surface.opposite);
    internal::Doubled_faces(surface).pair();
  }
  return surface;
}

ATLAS_INLINE Surface build_surface(std::vector<Point_3> points,
                                   const std::vector<std::vector<std::size_t>>& polygons)
{
  std::vector<std::size_t> first{0};
  std::vector<Index> vertices;
  for (const std::vector<std::size_t>& polygon : polygons) {
    for (const std::size_t v : polygon)
      vertices.push_back(v < no_index ? static_cast<Index>(v) : no_index);
    first.push_back(vertices.size());
  }
  return build_surface(std::move(points), first, vertices);
}

} // namespace Atlas

#endif
