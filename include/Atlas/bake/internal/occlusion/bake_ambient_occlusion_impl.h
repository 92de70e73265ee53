// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_OCCLUSION_BAKE_AMBIENT_OCCLUSION_IMPL_H
#define ATLAS_BAKE_INTERNAL_OCCLUSION_BAKE_AMBIENT_OCCLUSION_IMPL_H

// This header needs CGAL's AABB tree, which is under the GPL; it makes up the component Occlusion.

#include <Atlas/bake/bake_ambient_occlusion.h>
#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/internal/library.h>
#include <Atlas/soup/internal/corner_normals.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace Atlas {

namespace internal {

/// \brief Which share of the sky a place on the surface sees.
class Sky_view
{
public:
  Sky_view(const Surface& surface, const Ambient_occlusion_options& options)
      : surface_(surface), normalized_(normalized_points(surface)),
        facet_(facet_normals(surface, normalized_.points)),
        samples_(std::max<std::size_t>(options.samples, 1)),
        reach_(std::min(options.distance / normalized_.unit, 3.0)) // longer than the model
  {
    for (const auto& triangle : surface.triangles) {
      const Triangle t(point(triangle[0]), point(triangle[1]), point(triangle[2]));
      if (!t.is_degenerate())
        triangles_.push_back(t);
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

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
      free +=
          !tree_.do_intersect(Segment(origin, Point(origin.x() + reach_ * d.x(), origin.y() + reach_ * d.y(),
                                                    origin.z() + reach_ * d.z())));
    }
    return static_cast<double>(free) / static_cast<double>(samples_);
  }

private:
  // Nothing is decided here that has to be exact.
  using K = CGAL::Simple_cartesian<double>;
  using Point = K::Point_3;
  using Triangle = K::Triangle_3;
  using Segment = K::Segment_3;
  using Iterator = std::vector<Triangle>::const_iterator;
#if CGAL_VERSION_MAJOR >= 6
  using Traits = CGAL::AABB_traits_3<K, CGAL::AABB_triangle_primitive_3<K, Iterator>>;
#else
  using Traits = CGAL::AABB_traits<K, CGAL::AABB_triangle_primitive<K, Iterator>>;
#endif

  static constexpr double golden_ratio = 0.6180339887498949;

  Point point(Index v) const
  {
    const Point_3& p = normalized_.points[v];
    return Point(p.x(), p.y(), p.z());
  }

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

  const Surface& surface_;
  Normalized_points normalized_;
  std::vector<Vector_3> facet_;
  std::size_t samples_;
  double reach_;
  std::vector<Triangle> triangles_;
  CGAL::AABB_tree<Traits> tree_;
};

} // namespace internal

ATLAS_INLINE Image bake_ambient_occlusion(const Polygon_soup& soup, Image_size size,
                                          const Ambient_occlusion_options& options, Index page,
                                          const Execution& execution)
{
  const Surface surface = build_surface(soup.points, soup.first, soup.vertices);
  const internal::Sky_view view(surface, options);
  const auto color = [&](const Bake_sample& sample) {
    const double share = view.share(sample);
    return color_of({share, share, share});
  };
  return bake_texture(soup, size, color, page, execution);
}

} // namespace Atlas

#endif
