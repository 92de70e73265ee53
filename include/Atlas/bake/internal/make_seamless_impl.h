// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_MAKE_SEAMLESS_IMPL_H
#define ATLAS_BAKE_INTERNAL_MAKE_SEAMLESS_IMPL_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/Shading_frames.h>
#include <Atlas/bake/internal/bake_texels.h>
#include <Atlas/bake/internal/seams/Nearest_seamless.h>
#include <Atlas/bake/internal/seams/Seam_equations.h>
#include <Atlas/bake/internal/seams/Seam_samples.h>
#include <Atlas/core/build_surface.h>
#include <Atlas/core/errors.h>
#include <Atlas/core/internal/library.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// \brief The seams of textures, and what their sides see.
class Textured_seams
{
public:
  Textured_seams(const Polygon_soup& soup, const std::vector<Image>& pages, Texel_meaning meaning)
      : soup_(soup), size_(checked_size(soup, pages)),
        surface_(build_surface(soup.points, soup.first, soup.vertices)), sampler_(soup, surface_, size_)
  {
    if (meaning == Texel_meaning::tangent_normals)
      frames_.emplace(soup, surface_);
    for (const Index h : sampler_.halfedges())
      if (!frames_ || !is_crease(h))
        halfedges_.push_back(h);
    for (const Image& page : pages)
      number_of_components_ = page.alpha.empty() ? number_of_components_ : 4;
  }

  Seam_difference difference(const std::vector<Image>& pages) const
  {
    const std::array<Image_size, seam_levels> sizes = level_sizes(size_);
    std::array<Components, seam_levels> levels{components_of(pages)};
    for (std::size_t level = 1; level < seam_levels; ++level)
      levels[level] = halved(levels[level - 1], sizes[level - 1], sizes[level]);
    Seam_difference result;
    result.seams = halfedges_.size();
    for (const Index h : halfedges_)
      sampler_.for_each_piece(h, [&](const std::array<Seam_sample, 3>& piece) {
        std::array<std::array<double, 4>, 3> apart;
        for (std::size_t i = 0; i < 3; ++i)
          apart[i] = difference(piece[i], levels[piece[i].level]);
        double& largest = result.largest[piece[0].level];
        for (std::size_t k = 0; k < 4; ++k)
          largest = std::max(largest, largest_of_parabola(apart[0][k], apart[1][k], apart[2][k]));
      });
    return result;
  }

  void equalize(std::vector<Image>& pages, const Execution& execution) const
  {
    Seam_texels texels(size_, pages.size());
    Seam_equations equations;
    for (const Index h : halfedges_)
      sampler_.for_each_piece(h, [&](const std::array<Seam_sample, 3>& piece) {
        for (std::size_t i = piece[0].t > 0 ? 1 : 0; i < 3;
             ++i) // the first is the last one of the piece before
          add(piece[i], texels, equations);
      });
    const std::vector<float> ease = ease_of(texels, pages.size());
    Components components = components_of(pages);
    const std::size_t together = frames_ ? 3 : 1; // components that equations mix
    execution.for_each(number_of_components_ / together, [&](std::size_t k) {
      std::vector<double> numbers;
      for (const std::size_t texel : texels.texels())
        for (std::size_t i = 0; i < together; ++i)
          numbers.push_back(components[k + i][texel]);
      Nearest_seamless(equations, ease)(numbers, execution);
      for (std::size_t n = 0; n < numbers.size(); ++n)
        components[k + n % together][texels.texels()[n / together]] = static_cast<float>(numbers[n]);
    });
    if (!execution.is_cancelled())
      put(components, pages);
  }

private:
  using Components = std::array<std::vector<float>, 4>; ///< per texel of all pages, page by page

  static Image_size checked_size(const Polygon_soup& soup, const std::vector<Image>& pages)
  {
    require(soup.uv.size() == soup.number_of_corners(), "soup", "must have a coordinate per corner");
    require(soup.number_of_faces() == 0 || pages.size() >= soup.number_of_pages(), "pages",
            "must have a picture for each page of the soup");
    for (const Image& page : pages)
      require(page.width == pages[0].width && page.height == pages[0].height && !page.pixels.empty(), "pages",
              "must be of the same size, and not empty");
    return pages.empty() ? Image_size(1) : Image_size(pages[0].width, pages[0].height);
  }

  /// Whether the normals of the two sides differ: then the light does, too.
  bool is_crease(Index h) const
  {
    constexpr double cosine = 0.9998; // of a degree
    const Index o = surface_.opposite[h];
    return frames_->normal(h) * frames_->normal(next_halfedge(o)) < cosine ||
           frames_->normal(next_halfedge(h)) * frames_->normal(o) < cosine;
  }

  Components components_of(const std::vector<Image>& pages) const
  {
    Components result;
    for (std::size_t k = 0; k < number_of_components_; ++k)
      for (const Image& page : pages)
        for (std::size_t i = 0; i < page.pixels.size(); ++i)
          result[k].push_back(k < 3 ? page.pixels[i][k] : page.alpha.empty() ? 255.f : page.alpha[i]);
    return result;
  }

  static void put(const Components& components, std::vector<Image>& pages)
  {
    std::size_t first = 0;
    for (Image& page : pages) {
      for (std::size_t i = 0; i < page.pixels.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
          page.pixels[i][k] = static_cast<std::uint8_t>(components[k][first + i]);
      if (!components[3].empty()) {
        page.alpha.resize(page.pixels.size());
        for (std::size_t i = 0; i < page.alpha.size(); ++i)
          page.alpha[i] = static_cast<std::uint8_t>(components[3][first + i]);
        if (std::all_of(page.alpha.begin(), page.alpha.end(), [](std::uint8_t a) { return a == 255; }))
          page.alpha.clear();
      }
      first += page.pixels.size();
    }
  }

  /// Each texel the mean of four, not rounded.
  static Components halved(const Components& components, Image_size fine, Image_size coarse)
  {
    Components result;
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t first = 0; first < components[k].size(); first += fine.width * fine.height)
        for (std::size_t y = 0; y < coarse.height; ++y)
          for (std::size_t x = 0; x < coarse.width; ++x) {
            float sum = 0;
            for (const std::size_t j : {2 * y, std::min(2 * y + 1, fine.height - 1)})
              for (const std::size_t i : {2 * x, std::min(2 * x + 1, fine.width - 1)})
                sum += components[k][first + j * fine.width + i];
            result[k].push_back(sum / 4);
          }
    return result;
  }

  /// The frame of a side of a seam.
  std::array<Vector_3, 3> frame(const Seam_sample& sample, std::size_t side) const
  {
    const Index h = side == 0 ? sample.halfedge : surface_.opposite[sample.halfedge];
    const double t = side == 0 ? sample.t : 1 - sample.t;
    std::array<double, 3> weights{};
    weights[h % 3] = 1 - t;
    weights[next_halfedge(h) % 3] = t;
    return (*frames_)(h / 3, weights);
  }

  std::array<double, 4> difference(const Seam_sample& sample, const Components& components) const
  {
    std::array<double, 4> result{};
    for (std::size_t side = 0; side < 2; ++side) {
      const Bilinear_lookup& lookup = sample.sides[side];
      std::array<double, 4> seen{};
      for (std::size_t k = 0; k < number_of_components_; ++k)
        for (std::size_t i = 0; i < 4; ++i)
          seen[k] += lookup.weight[i] * double(components[k][lookup.texel[i]]);
      if (frames_)
        seen = decoded(seen, frame(sample, side));
      for (std::size_t k = 0; k < 4; ++k)
        result[k] += (side == 0 ? 1 : -1) * seen[k];
    }
    return result;
  }

  /// A normal of tangent space in space, as the colour of one in the coordinates of the model.
  static std::array<double, 4> decoded(const std::array<double, 4>& seen,
                                       const std::array<Vector_3, 3>& frame)
  {
    std::array<double, 4> result{};
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        result[k] += (seen[j] - middle) * frame[j][static_cast<int>(k)];
    return result;
  }

  void add(const Seam_sample& sample, Seam_texels& texels, Seam_equations& equations) const
  {
    std::vector<std::pair<Index, double>> terms;
    if (!frames_) {
      for (std::size_t side = 0; side < 2; ++side)
        texels.for_each_texel(sample.sides[side], sample.level, side == 0 ? 1 : -1,
                              [&](Index number, double weight) { terms.emplace_back(number, weight); });
      equations.add(terms, 0);
      return;
    }
    const std::array<std::array<Vector_3, 3>, 2> frames{frame(sample, 0), frame(sample, 1)};
    for (int k = 0; k < 3; ++k) {
      double constant = 0;
      for (std::size_t side = 0; side < 2; ++side)
        for (Index j = 0; j < 3; ++j) {
          const double factor = (side == 0 ? 1 : -1) * frames[side][j][k];
          constant -= factor * middle;
          texels.for_each_texel(sample.sides[side], sample.level, factor, [&](Index number, double weight) {
            terms.emplace_back(3 * number + j, weight);
          });
        }
      equations.add(terms, constant);
    }
  }

  /// What no chart covers changes more easily, and so do texels that only halved pages show at seams: thus
  /// the levels get into each other's way less.
  std::vector<float> ease_of(const Seam_texels& texels, std::size_t pages) const
  {
    const std::size_t texels_of_page = size_.width * size_.height;
    std::vector<std::vector<bool>> is_covered;
    for (Index page = 0; page < pages; ++page)
      is_covered.push_back(Page_raster(soup_, size_, page).coverage());
    std::vector<float> result;
    for (std::size_t i = 0; i < texels.texels().size(); ++i) {
      const std::size_t texel = texels.texels()[i];
      const float share = is_covered[texel / texels_of_page][texel % texels_of_page] ? 1.f : 3.f;
      result.insert(result.end(), frames_ ? 3 : 1, share * ease_of_level[texels.finest()[i]]);
    }
    return result;
  }

  /// The largest absolute value of a parabola with these values at 0, 1/2 and 1.
  static double largest_of_parabola(double start, double half, double end)
  {
    const double bend = 2 * (start - 2 * half + end), slope = end - start - bend;
    double largest = std::max({std::abs(start), std::abs(half), std::abs(end)});
    if (const double t = -slope / (2 * bend); bend != 0 && t > 0 && t < 1)
      largest = std::max(largest, std::abs(start + t * (slope + t * bend)));
    return largest;
  }

  static constexpr std::array<float, seam_levels> ease_of_level{1, 4, 4};
  static constexpr double middle = 127.5; ///< the colour of 0 in a normal

  const Polygon_soup& soup_;
  Image_size size_;
  Surface surface_;
  Seam_sampler sampler_;
  std::optional<Shading_frames> frames_; ///< of normals in tangent space
  std::vector<Index> halfedges_;
  std::size_t number_of_components_ = 3;
};

} // namespace internal

ATLAS_INLINE Seam_difference seam_difference(const Polygon_soup& soup, const std::vector<Image>& pages,
                                             Texel_meaning meaning)
{
  return internal::Textured_seams(soup, pages, meaning).difference(pages);
}

ATLAS_INLINE Seam_difference make_seamless(const Polygon_soup& soup, std::vector<Image>& pages,
                                           Texel_meaning meaning, const Execution& execution)
{
  const internal::Textured_seams seams(soup, pages, meaning);
  seams.equalize(pages, execution);
  return seams.difference(pages);
}

} // namespace Atlas

#endif
