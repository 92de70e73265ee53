// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_OCCLUSION_PLACE_ON_IMPL_H
#define ATLAS_BAKE_INTERNAL_OCCLUSION_PLACE_ON_IMPL_H

// This header needs CGAL's AABB tree, which is under the GPL; it is part of the component Occlusion.

#include <Atlas/bake/bake_ambient_occlusion.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/occlusion/Triangle_tree.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/bounding_box.h>
#include <Atlas/core/internal/library.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// \brief Finds the places of one mesh on another. Both are moved and scaled so that the other one's
/// bounding box has its middle at the origin and a diagonal of 1.
class Place_finder
{
public:
  Place_finder(const Polygon_soup& soup, const Polygon_soup& detail, double cage)
      : normal_(shading_normal(soup)), from_(build_surface(soup.points, soup.first, soup.vertices)),
        to_(build_surface(detail.points, detail.first, detail.vertices)), cage_(cage)
  {
    require(cage >= 0, "cage", "must be at least 0");
    const Bounding_box box = bounding_box(to_);
    const double diagonal = diagonal_of(to_, box);
    require(diagonal > 0, "detail", "must have a triangle with an area");
    for (Surface* const surface : {&from_, &to_})
      for (Point_3& p : surface->points)
        p = Point_3((p.x() - box.center[0]) / diagonal, (p.y() - box.center[1]) / diagonal,
                    (p.z() - box.center[2]) / diagonal);
    triangles_ = std::make_unique<Triangle_tree>(to_, to_.points);
    require(!triangles_->tree().empty(), "detail", "must have a triangle with an area");
    triangles_->tree().accelerate_distance_queries();
  }

  Bake_sample operator()(const Bake_sample& sample) const
  {
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        p[static_cast<std::size_t>(k)] +=
            sample.weights[i] * from_.points[from_.triangles[sample.triangle][i]][k];
    const Point place(p[0], p[1], p[2]);
    const Vector_3 normal = normal_(sample);
    const double length = std::sqrt(normal.squared_length());
    std::optional<Hit> best;
    if (cage_ > 0 && length > 0)
      for (const double sign : {1, -1}) {
        const Vector up(normal.x() / length, normal.y() / length, normal.z() / length);
        const std::optional<Hit> hit = hit_along(place, sign * up, up);
        if (hit && (!best || hit->distance < best->distance))
          best = hit;
      }
    if (!best) {
      const auto [nearest, triangle] = triangles_->tree().closest_point_and_primitive(place);
      best = Hit{nearest, triangle, 0};
    }
    return sample_at(*best, sample.texel);
  }

private:
  using Point = Triangle_tree::Point;
  using Vector = Triangle_tree::Vector;

  struct Hit
  {
    Point point;
    Triangle_tree::Iterator triangle;
    double distance;
  };

  static double diagonal_of(const Surface& surface, const Bounding_box& box)
  {
    std::array<double, 3> reach{};
    for (const auto& triangle : surface.triangles)
      for (const Index v : triangle)
        for (int k = 0; k < 3; ++k)
          reach[static_cast<std::size_t>(k)] =
              std::max(reach[static_cast<std::size_t>(k)], std::abs(surface.points[v][k] - box.center[k]));
    return 2 * std::hypot(reach[0], reach[1], reach[2]);
  }

  static Vector facing(const Triangle_tree::Triangle& t)
  {
    return CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  }

  /// The first face on the way that looks where `up` points, within the cage.
  std::optional<Hit> hit_along(const Point& place, const Vector& direction, const Vector& up) const
  {
    constexpr double back = 1e-9; // what is at the place itself counts
    const auto is_skipped = [&](Triangle_tree::Iterator t) { return !(facing(*t) * up > 0); };
    const auto found = triangles_->tree().first_intersection(
        Triangle_tree::Ray(place - back * direction, direction), is_skipped);
    if (!found)
      return std::nullopt;
    const Point* const point = Triangle_tree::point_of(found->first);
    if (!point) // in the plane of the ray; none that looks along it
      return std::nullopt;
    const double distance = std::sqrt((*point - place).squared_length());
    if (distance > cage_)
      return std::nullopt;
    return Hit{*point, found->second, distance};
  }

  Bake_sample sample_at(const Hit& hit, std::size_t texel) const
  {
    const Index t = triangles_->number(hit.triangle);
    Bake_sample result;
    result.texel = texel;
    result.face = to_.face[t];
    result.triangle = t;
    const Triangle_tree::Triangle& q = *hit.triangle;
    const Vector normal = facing(q);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = static_cast<int>(i + 1) % 3, b = static_cast<int>(i + 2) % 3;
      result.corners[i] = to_.corner[3 * t + i];
      result.weights[i] = std::max(CGAL::cross_product(q[a] - hit.point, q[b] - hit.point) * normal, 0.0);
      sum += result.weights[i];
    }
    for (double& weight : result.weights)
      weight = sum > 0 ? weight / sum : 1. / 3;
    return result;
  }

  Bake_normal normal_;
  Surface from_, to_;
  double cage_;
  std::unique_ptr<Triangle_tree> triangles_;
};

} // namespace internal

ATLAS_INLINE Bake_place place_on(const Polygon_soup& soup, const Polygon_soup& detail, double cage)
{
  const auto finder = std::make_shared<const internal::Place_finder>(soup, detail, cage);
  return [finder](const Bake_sample& sample) { return (*finder)(sample); };
}

} // namespace Atlas

#endif
