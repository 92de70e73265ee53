// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_SEAMS_SEAM_SAMPLES_H
#define ATLAS_BAKE_INTERNAL_SEAMS_SEAM_SAMPLES_H

#include <Atlas/bake/bake_texture.h>
#include <Atlas/core/Surface.h>
#include <Atlas/image/Image.h>
#include <Atlas/soup/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// The sizes of a page at the levels that seams are looked at: those of `halved()`.
inline std::array<Image_size, seam_levels> level_sizes(Image_size size)
{
  std::array<Image_size, seam_levels> sizes{size, size, size};
  for (std::size_t level = 1; level < seam_levels; ++level)
    sizes[level] = {std::max<std::size_t>(sizes[level - 1].width / 2, 1),
                    std::max<std::size_t>(sizes[level - 1].height / 2, 1)};
  return sizes;
}

/// What bilinear interpolation takes of the texels of all pages, page by page.
struct Bilinear_lookup
{
  std::array<std::size_t, 4> texel;
  std::array<double, 4> weight;
};

/// \param uv  finite. Beyond the outermost centres of texels the page goes on as it ends
inline Bilinear_lookup bilinear_lookup(const Point_2& uv, Index page, Image_size size)
{
  const auto width = static_cast<double>(size.width), height = static_cast<double>(size.height);
  const double x = std::clamp(uv.x() * width - 0.5, 0.0, width - 1),
               y = std::clamp((1 - uv.y()) * height - 0.5, 0.0, height - 1);
  const auto left = static_cast<std::size_t>(x), top = static_cast<std::size_t>(y);
  const std::size_t right = std::min(left + 1, size.width - 1), below = std::min(top + 1, size.height - 1),
                    first = page * size.width * size.height;
  const double a = x - std::floor(x), b = y - std::floor(y);
  return {{first + top * size.width + left, first + top * size.width + right,
           first + below * size.width + left, first + below * size.width + right},
          {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b}};
}

/// A place on a seam as both of its sides see it at a level.
struct Seam_sample
{
  std::size_t level;
  Index halfedge; ///< of one side
  double t;       ///< from the tail of the halfedge, 0, to its head, 1
  std::array<Bilinear_lookup, 2> sides;
};

/// \brief The seams of coordinates: the edges of the surface whose two sides lie at different places.
class Seam_sampler
{
public:
  /// \pre a coordinate per corner
  Seam_sampler(const Polygon_soup& soup, const Surface& surface, Image_size size)
      : soup_(soup), surface_(surface), sizes_(level_sizes(size))
  {
    for (Index h = 0; h < surface.opposite.size(); ++h)
      if (surface.opposite[h] != no_index && h < surface.opposite[h] && is_seam(h))
        halfedges_.push_back(h);
  }

  /// One of the two halfedges of each seam.
  const std::vector<Index>& halfedges() const { return halfedges_; }

  /// Calls `visit(samples)` for each piece of a seam on which both sides are quadratic at a level, with its
  /// ends and its middle: these three tell all about it.
  template <typename Visit>
  void for_each_piece(Index h, Visit visit) const
  {
    const Index o = surface_.opposite[h];
    for (std::size_t level = 0; level < seam_levels; ++level) {
      std::vector<double> breaks{0, 1};
      add_breaks(h, level, breaks);
      const std::size_t first_of_other = breaks.size();
      add_breaks(o, level, breaks);
      for (std::size_t i = first_of_other; i < breaks.size(); ++i)
        breaks[i] = 1 - breaks[i];
      std::sort(breaks.begin(), breaks.end());
      double from = 0;
      for (const double to : breaks)
        if (to - from > shortest) {
          visit(std::array<Seam_sample, 3>{sample(h, o, level, from), sample(h, o, level, (from + to) / 2),
                                           sample(h, o, level, to)});
          from = to;
        }
    }
  }

private:
  static constexpr double shortest = 1e-7; ///< of a piece, as a share of the seam

  const Point_2& uv(Index h) const { return soup_.uv[surface_.corner[h]]; }
  Index page(Index h) const { return soup_.page(surface_.face[h / 3]); }

  bool is_seam(Index h) const
  {
    const Index o = surface_.opposite[h], h_next = next_halfedge(h), o_next = next_halfedge(o);
    for (const Index c : {h, h_next, o, o_next})
      if (!std::isfinite(uv(c).x()) || !std::isfinite(uv(c).y()))
        return false;
    return page(h) != page(o) || uv(h) != uv(o_next) || uv(h_next) != uv(o);
  }

  /// Where a side of a seam crosses the lines through the centres of texels.
  void add_breaks(Index h, std::size_t level, std::vector<double>& breaks) const
  {
    const Point_2 &from = uv(h), &to = uv(next_halfedge(h));
    const auto add = [&](double start, double end, std::size_t size) {
      const double low = std::max(std::ceil(std::min(start, end)), 0.0),
                   high = std::min(std::floor(std::max(start, end)), static_cast<double>(size - 1));
      for (double line = low; line <= high && start != end; ++line)
        breaks.push_back(std::clamp((line - start) / (end - start), 0.0, 1.0));
    };
    const auto width = static_cast<double>(sizes_[level].width),
               height = static_cast<double>(sizes_[level].height);
    add(from.x() * width - 0.5, to.x() * width - 0.5, sizes_[level].width);
    add((1 - from.y()) * height - 0.5, (1 - to.y()) * height - 0.5, sizes_[level].height);
  }

  Seam_sample sample(Index h, Index o, std::size_t level, double t) const
  {
    return {level, h, t, {lookup(h, t, level), lookup(o, 1 - t, level)}};
  }

  Bilinear_lookup lookup(Index h, double t, std::size_t level) const
  {
    const Point_2 &from = uv(h), &to = uv(next_halfedge(h));
    const Point_2 place((1 - t) * from.x() + t * to.x(), (1 - t) * from.y() + t * to.y());
    return bilinear_lookup(place, page(h), sizes_[level]);
  }

  const Polygon_soup& soup_;
  const Surface& surface_;
  std::array<Image_size, seam_levels> sizes_;
  std::vector<Index> halfedges_;
};

} // namespace Atlas::internal

#endif
