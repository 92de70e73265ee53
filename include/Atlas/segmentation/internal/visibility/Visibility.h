// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_VISIBILITY_VISIBILITY_H
#define ATLAS_SEGMENTATION_INTERNAL_VISIBILITY_VISIBILITY_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/bounding_box.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>
#include <Atlas/segmentation/internal/visibility/Depth_image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Two unit vectors at right angles to a unit vector and to each other.
inline std::pair<Vector_3, Vector_3> vectors_across(const Vector_3& axis)
{
  const Vector_3 beside = std::abs(axis.x()) < 0.6 ? Vector_3(1, 0, 0) : Vector_3(0, 1, 0);
  const Vector_3 u = unit(CGAL::cross_product(axis, beside));
  return {u, CGAL::cross_product(axis, u)};
}

/// Unit directions spread evenly over the cap around an axis, on a spiral.
/// \param angle  of the cap, from the axis to its rim, in radians; pi: the whole sphere
inline std::vector<Vector_3> directions_of_cap(const Vector_3& axis, double angle, int count)
{
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const std::pair<Vector_3, Vector_3> across = vectors_across(axis);
  std::vector<Vector_3> directions;
  for (int i = 0; i < count; ++i) {
    const double height = 1 - (1 - std::cos(angle)) * (i + 0.5) / count;
    const double radius = std::sqrt(1 - height * height), turn = golden_angle * i;
    directions.push_back(height * axis + radius * std::cos(turn) * across.first +
                         radius * std::sin(turn) * across.second);
  }
  return directions;
}

/// \brief How much the vertices of a surface are seen from given directions, by depth buffers.
///
/// A place is seen as much as the light that it gets from all directions is of what a place gets that faces
/// their axis and that nothing hides. Of a component, that side counts which is seen more: a model may be
/// inside out. O(directions x (vertices + triangles + pixels)).
class Visibility
{
public:
  explicit Visibility(const Surface& surface) : surface_(surface), box_(bounding_box(surface))
  {
    points_.resize(surface.points.size(), Vector_3(0, 0, 0));
    normals_.resize(surface.points.size(), Vector_3(0, 0, 0));
    if (!(box_.half_side > 0))
      return;
    for (const auto& triangle : surface.triangles)
      for (const Index v : triangle)
        points_[v] = unit_place(surface.points[v]);
    for (const auto& [a, b, c] : surface.triangles) {
      const Vector_3 n = CGAL::cross_product(points_[b] - points_[a], points_[c] - points_[a]);
      for (const Index v : {a, b, c})
        normals_[v] = normals_[v] + n;
    }
    for (Vector_3& n : normals_)
      if (const double length = std::sqrt(n.squared_length()); length > 0)
        n = n / length;
  }

  /// Per vertex, in [0, 1].
  std::vector<double> run(const Vector_3& axis, double angle, int directions, const Execution& execution)
  {
    const std::vector<Vector_3> all = directions_of_cap(axis, angle, directions);
    for (Light& side : light_)
      side.assign(points_.size(), 0);
    std::vector<std::vector<std::uint8_t>> seen(batch);
    for (std::size_t first = 0; first < all.size() && execution.proceed(); first += batch) {
      const std::size_t count = std::min(batch, all.size() - first);
      execution.for_each(count, [&](std::size_t i) { seen[i] = look(all[first + i]); });
      for (std::size_t i = 0; i < count; ++i) // in order: sums do not depend on threads
        add(all[first + i], seen[i]);
    }
    double most = 0;
    for (const Vector_3& d : all)
      most += std::max(0., d * axis);
    return share_of(most);
  }

private:
  using Light = std::vector<double>; // per vertex
  /// Depth buffers at a time: a bound on memory.
  static constexpr std::size_t batch = 8;
  static constexpr int pixels = 512;     // a side
  static constexpr double radius = 1.74; // of the ball around the model: that of a cube of half side 1
  static constexpr double pixel = 2 * radius / pixels;
  /// A place is lifted off the surface by so many pixels, and hidden by what is more than one before it.
  static constexpr double lift = 2 * pixel;

  Vector_3 unit_place(const Point_3& p) const
  {
    return {(p.x() - box_.center[0]) / box_.half_side, (p.y() - box_.center[1]) / box_.half_side,
            (p.z() - box_.center[2]) / box_.half_side};
  }

  /// Per vertex, whether its front (1) or its back (2) is seen from afar.
  std::vector<std::uint8_t> look(const Vector_3& d) const
  {
    const std::pair<Vector_3, Vector_3> across = vectors_across(d);
    const auto project = [&](const Vector_3& p) {
      return Depth_image::Place{(p * across.first + radius) / pixel, (p * across.second + radius) / pixel,
                                p * d};
    };
    std::vector<Depth_image::Place> places(points_.size());
    for (std::size_t k = 0; k < places.size(); ++k)
      places[k] = project(points_[k]);
    Depth_image image(pixels);
    for (const auto& [a, b, c] : surface_.triangles)
      image.draw(places[a], places[b], places[c]);
    std::vector<std::uint8_t> seen(points_.size(), 0);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const double facing = normals_[k] * d;
      const Depth_image::Place p = project(points_[k] + (facing > 0 ? lift : -lift) * normals_[k]);
      if (facing != 0 && image.depth_at(p) <= p[2] + pixel)
        seen[k] = facing > 0 ? 1 : 2;
    }
    return seen;
  }

  void add(const Vector_3& d, const std::vector<std::uint8_t>& seen)
  {
    for (std::size_t k = 0; k < seen.size(); ++k)
      if (seen[k])
        light_[seen[k] - 1][k] += std::abs(normals_[k] * d);
  }

  std::vector<double> share_of(double most) const
  {
    const Components parts = connected_components(surface_.opposite);
    std::vector<std::array<double, 2>> sum(parts.count, {0, 0});
    for (Index t = 0; t < surface_.number_of_triangles(); ++t)
      for (const Index v : surface_.triangles[t])
        for (std::size_t side : {0u, 1u})
          sum[parts.of_triangle[t]][side] += light_[side][v];
    std::vector<double> result(points_.size(), 0);
    for (Index t = 0; t < surface_.number_of_triangles(); ++t) {
      const auto& [front, back] = sum[parts.of_triangle[t]];
      for (const Index v : surface_.triangles[t])
        result[v] = std::min(1., light_[back > front][v] / most);
    }
    return result;
  }

  const Surface& surface_;
  Bounding_box box_;
  std::vector<Vector_3> points_, normals_; ///< per vertex, in a cube of half side 1
  std::array<Light, 2> light_;
};

} // namespace Atlas::internal

#endif
