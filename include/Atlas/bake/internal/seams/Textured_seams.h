// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_SEAMS_TEXTURED_SEAMS_H
#define ATLAS_BAKE_INTERNAL_SEAMS_TEXTURED_SEAMS_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/bake/internal/Shading_frames.h>
#include <Atlas/bake/internal/bake_texels.h>
#include <Atlas/bake/internal/seams/Nearest_seamless.h>
#include <Atlas/bake/internal/seams/Seam_equations.h>
#include <Atlas/bake/internal/seams/Seam_samples.h>
#include <Atlas/core/build_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Up to four numbers in [0, 255] per texel of all pages, page by page; the last ones may be left out.
using Texel_components = std::array<std::vector<float>, 4>;

/// \brief The seams of textures, and what their sides see.
class Textured_seams
{
public:
  /// \param size  of the pages. The soup must outlive this object
  Textured_seams(const Polygon_soup& soup, Image_size size, Texel_meaning meaning)
      : soup_(soup), size_(size), surface_(build_surface(soup.points, soup.first, soup.vertices)),
        sampler_(soup, surface_, size_)
  {
    if (meaning == Texel_meaning::tangent_normals)
      frames_.emplace(soup, surface_);
    for (const Index h : sampler_.halfedges())
      if (!frames_ || !is_crease(h))
        halfedges_.push_back(h);
  }

  Seam_difference difference(const Texel_components& components) const
  {
    const std::array<Image_size, seam_levels> sizes = level_sizes(size_);
    std::array<Texel_components, seam_levels> levels{components};
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

  /// \param are_whole  whether components are whole numbers in the end. Once cancelled, they stay as they are
  void equalize(Texel_components& components, bool are_whole, const Execution& execution) const
  {
    const std::size_t pages = components[0].size() / (size_.width * size_.height);
    Seam_texels texels(size_, pages);
    Seam_equations equations;
    for (const Index h : halfedges_)
      sampler_.for_each_piece(h, [&](const std::array<Seam_sample, 3>& piece) {
        for (std::size_t i = piece[0].t > 0 ? 1 : 0; i < 3;
             ++i) // the first is the last one of the piece before
          add(piece[i], texels, equations);
      });
    const std::vector<float> ease = ease_of(texels, pages);
    const std::size_t together = frames_ ? 3 : 1; // components that equations mix
    Texel_components result = components;
    execution.for_each(number_of(components) / together, [&](std::size_t k) {
      std::vector<double> numbers;
      for (const std::size_t texel : texels.texels())
        for (std::size_t i = 0; i < together; ++i)
          numbers.push_back(components[k + i][texel]);
      Nearest_seamless(equations, ease, are_whole)(numbers, execution);
      for (std::size_t n = 0; n < numbers.size(); ++n)
        result[k + n % together][texels.texels()[n / together]] = static_cast<float>(numbers[n]);
    });
    if (!execution.is_cancelled())
      components = std::move(result);
  }

private:
  static std::size_t number_of(const Texel_components& components)
  {
    return static_cast<std::size_t>(
        std::count_if(components.begin(), components.end(), [](const auto& c) { return !c.empty(); }));
  }

  /// Whether the normals of the two sides differ: then the light does, too.
  bool is_crease(Index h) const
  {
    constexpr double cosine = 0.9998; // of a degree
    const Index o = surface_.opposite[h];
    return frames_->normal(h) * frames_->normal(next_halfedge(o)) < cosine ||
           frames_->normal(next_halfedge(h)) * frames_->normal(o) < cosine;
  }

  /// Each texel the mean of four, not rounded.
  static Texel_components halved(const Texel_components& components, Image_size fine, Image_size coarse)
  {
    Texel_components result;
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

  std::array<double, 4> difference(const Seam_sample& sample, const Texel_components& components) const
  {
    std::array<double, 4> result{};
    for (std::size_t side = 0; side < 2; ++side) {
      const Bilinear_lookup& lookup = sample.sides[side];
      std::array<double, 4> seen{};
      for (std::size_t k = 0; k < number_of(components); ++k)
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
};

} // namespace Atlas::internal

#endif
