// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_BAKE_TEXELS_H
#define ATLAS_BAKE_INTERNAL_BAKE_TEXELS_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/nearest_texels.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/fill_polygon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Which triangle each texel of a page shows.
class Page_raster
{
public:
  Page_raster(const Polygon_soup& soup, Image_size size, Index page)
      : soup_(soup), surface_(build_surface(soup.points, soup.first, soup.vertices)), size_(size),
        triangle_(size.width * size.height, no_index)
  {
    for (Index t = 0; t < surface_.number_of_triangles(); ++t)
      if (soup.page(surface_.face[t]) == page)
        cover(t);
  }

  /// Texels that had a triangle already when another came, and that triangle.
  const std::vector<std::pair<std::size_t, Index>>& covered_before() const { return covered_before_; }

  std::vector<bool> coverage() const
  {
    std::vector<bool> result(triangle_.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = triangle_[i] != no_index;
    return result;
  }

  Bake_sample sample(std::size_t texel) const { return sample(texel, triangle_[texel]); }

  Bake_sample sample(std::size_t texel, Index t) const
  {
    Bake_sample result;
    result.texel = texel;
    result.face = surface_.face[t];
    result.triangle = t;
    for (std::size_t i = 0; i < 3; ++i)
      result.corners[i] = surface_.corner[3 * t + i];
    result.weights = weights(corners_of(t), Point_2(static_cast<double>(texel % size_.width) + 0.5,
                                                    static_cast<double>(texel / size_.width) + 0.5));
    return result;
  }

private:
  double width() const { return static_cast<double>(size_.width); }
  double height() const { return static_cast<double>(size_.height); }

  /// The corners in texels, y downwards.
  std::array<Point_2, 3> corners_of(Index t) const
  {
    std::array<Point_2, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point_2& p = soup_.uv[surface_.corner[3 * t + i]];
      result[i] = Point_2(p.x() * width(), (1 - p.y()) * height());
    }
    return result;
  }

  void cover(Index t)
  {
    const std::array<Point_2, 3> corners = corners_of(t);
    for (const Point_2& p : corners)
      if (!std::isfinite(p.x()) || !std::isfinite(p.y()))
        return;
    bool is_seen = false;
    fill_polygon(corners, size_.width, size_.height, [&](std::size_t x, std::size_t y) {
      Index& triangle = triangle_[y * size_.width + x];
      if (triangle != no_index)
        covered_before_.emplace_back(y * size_.width + x, triangle);
      triangle = t;
      is_seen = true;
    });
    if (is_seen)
      return;
    // Triangles between texel centres get the texel that their middle is in, if nobody else does.
    const Point_2 middle = CGAL::centroid(corners[0], corners[1], corners[2]);
    if (!(middle.x() >= 0 && middle.y() >= 0 && middle.x() < width() && middle.y() < height()))
      return;
    Index& texel =
        triangle_[static_cast<std::size_t>(middle.y()) * size_.width + static_cast<std::size_t>(middle.x())];
    if (texel == no_index)
      texel = t;
  }

  /// Barycentric coordinates, clamped into the triangle: a texel may be a little outside of what it shows.
  static std::array<double, 3> weights(const std::array<Point_2, 3>& q, const Point_2& p)
  {
    const double area = CGAL::determinant(q[1] - q[0], q[2] - q[0]);
    std::array<double, 3> w{1. / 3, 1. / 3, 1. / 3};
    if (area == 0)
      return w;
    w[1] = std::clamp(CGAL::determinant(p - q[0], q[2] - q[0]) / area, 0.0, 1.0);
    w[2] = std::clamp(CGAL::determinant(q[1] - q[0], p - q[0]) / area, 0.0, 1.0 - w[1]);
    w[0] = 1 - w[1] - w[2];
    return w;
  }

  const Polygon_soup& soup_;
  Surface surface_;
  Image_size size_;
  std::vector<Index> triangle_; ///< per texel
  std::vector<std::pair<std::size_t, Index>> covered_before_;
};

/// A colour and how much it hides.
struct Texel
{
  Color color;
  std::uint8_t alpha = 255;
};

/// `bake_texture()` with alpha, which is left out where all of it is opaque.
inline Image bake_texels(const Polygon_soup& soup, Image_size size,
                         const std::function<Texel(const Bake_sample&)>& shader, Index page,
                         const Execution& execution)
{
  require(soup.uv.size() == soup.number_of_corners(), "soup", "must have a coordinate per corner");
  const Page_raster raster(soup, size, page);
  const std::vector<bool> is_covered = raster.coverage();
  const std::vector<Index> nearest = nearest_texels(is_covered, size.width, size.height);
  Image image(size.width, size.height, {128, 128, 128});
  image.alpha.assign(image.pixels.size(), 255);
  execution.for_each(size.height, [&](std::size_t row) {
    if (!execution.proceed(double(row) / double(size.height)))
      return;
    for (std::size_t i = row * size.width; i < (row + 1) * size.width; ++i)
      if (is_covered[i]) {
        const Texel texel = shader(raster.sample(i));
        image.pixels[i] = texel.color;
        image.alpha[i] = texel.alpha;
      }
  });
  for (std::size_t i = 0; i < is_covered.size(); ++i)
    if (nearest[i] != no_index) {
      image.pixels[i] = image.pixels[nearest[i]];
      image.alpha[i] = image.alpha[nearest[i]];
    }
  if (std::all_of(image.alpha.begin(), image.alpha.end(), [](std::uint8_t a) { return a == 255; }))
    image.alpha.clear();
  return image;
}

} // namespace Atlas::internal

#endif
