// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_OCCLUSION_BAKE_AMBIENT_OCCLUSION_IMPL_H
#define ATLAS_BAKE_INTERNAL_OCCLUSION_BAKE_AMBIENT_OCCLUSION_IMPL_H

// This header needs CGAL's AABB tree, which is under the GPL; it makes up the component Occlusion.

#include <Atlas/bake/bake_ambient_occlusion.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/occlusion/Triangle_tree.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/soup/internal/corner_normals.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// \brief Which share of the sky a place on the surface sees.
class Sky_view
{
public:
  Sky_view(Surface surface, const Ambient_occlusion_options& options)
      : surface_(std::move(surface)), normalized_(normalized_points(surface_)),
        facet_(facet_normals(surface_, normalized_.points)),
        samples_(std::max<std::size_t>(options.samples, 1)),
        reach_(std::min(options.distance / normalized_.unit, 3.0)), // longer than the model
        triangles_(surface_, normalized_.points)
  {}

  /// The cosine-weighted share of directions that are free, in [0, 1].
  double share(const Bake_sample& sample) const
  {
    const double length = std::sqrt(facet_[sample.triangle].squared_length());
    if (!(length > 0))
      return 1;
    const Vector_3 up = facet_[sample.triangle] / length;
    const Point origin = place(sample, up);
    // Two directions across; no coordinate of `up` vanishes that is divided by (Duff et al. 2017).
    const double sign = std::copysign(1.0, up.z()), a = -1 / (sign + up.z()), b = up.x() * up.y() * a;
    const Vector_3 across(1 + sign * up.x() * up.x() * a, sign * b, -sign * up.x());
    const Vector_3 along(b, sign + up.y() * up.y() * a, -up.y());
    const double turn = fraction(sample.texel);
    std::size_t free = 0;
    for (std::size_t i = 0; i < samples_; ++i) {
      // Points of the disc that are as dense everywhere, lifted to the hemisphere.
      const double r2 = (static_cast<double>(i) + 0.5) / static_cast<double>(samples_);
      const double angle = 2 * M_PI * (turn + golden_ratio * static_cast<double>(i));
      const double r = std::sqrt(r2), x = r * std::cos(angle), y = r * std::sin(angle);
      const Vector_3 d = x * across + y * along + std::sqrt(1 - r2) * up;
      free += !triangles_.tree().do_intersect(
          Segment(origin, Point(origin.x() + reach_ * d.x(), origin.y() + reach_ * d.y(),
                                origin.z() + reach_ * d.z())));
    }
    return static_cast<double>(free) / static_cast<double>(samples_);
  }

private:
  using Point = Triangle_tree::Point;
  using Segment = Triangle_tree::Segment;

  static constexpr double golden_ratio = 0.6180339887498949;

  /// The place that a sample shows, a little above the surface and away from the edges of its triangle, so
  /// that rays neither meet the triangle nor slip out between two.
  Point place(const Bake_sample& sample, const Vector_3& up) const
  {
    constexpr double height = 1e-6, inwards = 1e-4;
    Vector_3 p(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i)
      p = p + ((1 - inwards) * sample.weights[i] + inwards / 3) *
                  (normalized_.points[surface_.triangles[sample.triangle][i]] - CGAL::ORIGIN);
    p = p + height * up;
    return Point(p.x(), p.y(), p.z());
  }

  /// A number in [0, 1) that looks random (the mixing of splitmix64).
  static double fraction(std::uint64_t x)
  {
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return std::ldexp(static_cast<double>((x ^ (x >> 31)) >> 11), -53);
  }

  Surface surface_;
  Normalized_points normalized_;
  std::vector<Vector_3> facet_;
  std::size_t samples_;
  double reach_;
  Triangle_tree triangles_;
};

} // namespace internal

ATLAS_INLINE Bake_shader occlusion_shader(const Polygon_soup& soup, const Ambient_occlusion_options& options)
{
  const auto view = std::make_shared<const internal::Sky_view>(
      build_surface(soup.points, soup.first, soup.vertices), options);
  return [view](const Bake_sample& sample) {
    const double share = view->share(sample);
    return color_of({share, share, share});
  };
}

ATLAS_INLINE Image bake_ambient_occlusion(const Polygon_soup& soup, Image_size size,
                                          const Ambient_occlusion_options& options, Index page,
                                          const Execution& execution)
{
  return bake_texture(soup, size, occlusion_shader(soup, options), page, execution);
}

} // namespace Atlas

#endif
