// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_TEXEL_SHADER_H
#define ATLAS_BAKE_INTERNAL_TEXEL_SHADER_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/bake_texels.h>
#include <Atlas/bake/internal/interpolated.h>
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/srgb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace Atlas::internal {

/// \brief Old textures with all their smaller versions.
class Texture_sampler
{
public:
  explicit Texture_sampler(const Source_textures& source) : source_(source)
  {
    for (const Source_texture& texture : source.textures) {
      levels_.emplace_back();
      if (texture.image.pixels.empty())
        continue;
      levels_.back().push_back(texture.image);
      while (std::min(levels_.back().back().width, levels_.back().back().height) > 1)
        levels_.back().push_back(halved(levels_.back().back()));
    }
  }

  /// \param corners  the triangle that shows the texture, by its old coordinates
  /// \param weights  of the place in it
  /// \param area     of the triangle on the new page, in texels
  /// \param light    multiplies the light, in [0, 1]
  Texel color(Index texture, const std::array<Point_2, 3>& corners, const std::array<double, 3>& weights,
              double area, const std::array<double, 3>& light) const
  {
    const Source_texture& source = source_.textures[texture];
    const std::vector<Image>& levels = levels_[texture];
    std::array<double, 4> texel{255, 255, 255, 255};
    std::array<Point_2, 3> q;
    for (std::size_t i = 0; i < 3; ++i)
      q[i] = source.transformed(corners[i]);
    const Point_2 place(weights[0] * q[0].x() + weights[1] * q[1].x() + weights[2] * q[2].x(),
                        weights[0] * q[0].y() + weights[1] * q[1].y() + weights[2] * q[2].y());
    if (!levels.empty() && std::isfinite(place.x()) && std::isfinite(place.y()))
      texel = interpolated(levels[level(levels, q, area)], place, source.wrap_u, source.wrap_v);
    std::array<double, 3> components;
    for (std::size_t k = 0; k < 3; ++k)
      components[k] = product(product(texel[k] / 255, source.factor[k]), encoded_srgb(light[k]));
    return {color_of(components), color_of({texel[3] / 255 * source.opacity, 0, 0})[0]};
  }

private:
  /// The product of the light that two components stand for.
  static double product(double a, double b)
  {
    return a == 1 ? b : b == 1 ? a : encoded_srgb(decoded_srgb(a) * decoded_srgb(b));
  }

  /// The version whose pixels are about as large as the texels of the new page.
  static std::size_t level(const std::vector<Image>& levels, const std::array<Point_2, 3>& q, double area)
  {
    const double pixels = std::abs(CGAL::determinant(q[1] - q[0], q[2] - q[0])) / 2 *
                          static_cast<double>(levels[0].width) * static_cast<double>(levels[0].height);
    if (!(pixels > area))
      return 0;
    const double wanted = std::round(std::log2(pixels / area) / 2);
    return static_cast<std::size_t>(std::min(wanted, static_cast<double>(levels.size() - 1)));
  }

  const Source_textures& source_;
  std::vector<std::vector<Image>> levels_; ///< per texture; empty: none
};

/// The light of the colours of vertices at a place: 1 where they do not count.
inline std::array<double, 3> light_of_colors(const Polygon_soup& soup, const Bake_sample& sample)
{
  std::array<double, 3> light{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      light[k] += sample.weights[i] *
                  decoded_srgb(static_cast<double>(soup.colors[soup.vertices[sample.corners[i]]][k]));
  return light;
}

/// What a texel shows, and how much it hides, given its place on the surface.
using Texel_shader = std::function<Texel(const Bake_sample&)>;

/// What each place on the surface shows of the old textures.
inline Texel_shader texel_shader(const Polygon_soup& soup, Image_size size, const Source_textures& source,
                                 const Color& missing)
{
  require(soup.old_uv.empty() || soup.old_uv.size() == soup.number_of_corners(), "soup",
          "must have an old coordinate per corner, or none");
  require(source.face_texture.size() == soup.number_of_faces(), "source", "must have an entry per face");
  const auto sampler = std::make_shared<const Texture_sampler>(source);
  const double texels = static_cast<double>(size.width) * static_cast<double>(size.height);
  return [&soup, &source, sampler, texels, missing](const Bake_sample& sample) {
    const Index texture = source.face_texture[sample.face];
    if (texture == no_index)
      return Texel{missing};
    std::array<Point_2, 3> before, after;
    for (std::size_t i = 0; i < 3; ++i) {
      before[i] = soup.old_uv.empty() ? Point_2(NAN, NAN) : soup.old_uv[sample.corners[i]];
      after[i] = soup.uv[sample.corners[i]];
    }
    const double area = std::abs(CGAL::determinant(after[1] - after[0], after[2] - after[0])) / 2 * texels;
    const bool is_colored = source.textures[texture].multiplies_colors && !soup.colors.empty();
    return sampler->color(texture, before, sample.weights, area,
                          is_colored ? light_of_colors(soup, sample) : std::array<double, 3>{1, 1, 1});
  };
}

} // namespace Atlas::internal

#endif
