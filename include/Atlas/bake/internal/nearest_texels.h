// SPDX-License-Identifier: MIT
#ifndef ATLAS_BAKE_INTERNAL_NEAREST_TEXELS_H
#define ATLAS_BAKE_INTERNAL_NEAREST_TEXELS_H

#include <Atlas/core/Kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// \brief For every place of a line the site that minimises height + squared distance: the lower envelope of
/// parabolas (Felzenszwalb, Huttenlocher 2012). O(n).
class Parabola_envelope
{
public:
  /// \param has_site, height  per place; places without a site are left out
  /// \param nearest  output: per place the place of its best site, or `no_index` if there is none
  template <typename HasSite, typename Height>
  void operator()(std::size_t n, HasSite has_site, Height height, std::vector<Index>& nearest)
  {
    sites_.clear();
    starts_.clear();
    for (std::size_t q = 0; q < n; ++q) {
      if (!has_site(q))
        continue;
      double start = -INFINITY;
      while (!sites_.empty()) {
        start = crossing(sites_.back(), q, height);
        if (start > starts_.back())
          break;
        sites_.pop_back();
        starts_.pop_back();
      }
      starts_.push_back(sites_.empty() ? -INFINITY : start);
      sites_.push_back(static_cast<Index>(q));
    }
    nearest.assign(n, no_index);
    for (std::size_t q = 0, k = 0; q < n && !sites_.empty(); ++q) {
      while (k + 1 < sites_.size() && starts_[k + 1] < static_cast<double>(q))
        ++k;
      nearest[q] = sites_[k];
    }
  }

private:
  /// Where the parabola of q becomes lower than that of p < q.
  template <typename Height>
  static double crossing(std::size_t p, std::size_t q, Height height)
  {
    const double x = static_cast<double>(p), y = static_cast<double>(q);
    return (height(q) + y * y - height(p) - x * x) / (2 * (y - x));
  }

  std::vector<Index> sites_;
  std::vector<double> starts_;
};

/// \brief For every texel of a page the nearest covered one, by Euclidean distance between centres; covered
/// texels are their own. `no_index` everywhere if none is covered. O(texels).
///
/// Filling a texture with it extends the borders of charts without limit, so that neither interpolation nor
/// smaller versions of the texture meet texels without a value.
inline std::vector<Index> nearest_texels(const std::vector<bool>& is_covered, std::size_t width,
                                         std::size_t height)
{
  Parabola_envelope envelope;
  std::vector<Index> result(width * height, no_index), nearest;
  for (std::size_t x = 0; x < width; ++x) { // the nearest in the column
    envelope(
        height, [&](std::size_t y) { return is_covered[y * width + x]; }, [](std::size_t) { return 0.0; },
        nearest);
    for (std::size_t y = 0; y < height; ++y)
      result[y * width + x] = nearest[y];
  }
  std::vector<Index> column(width);
  for (std::size_t y = 0; y < height; ++y) { // the best column
    std::copy_n(result.begin() + static_cast<std::ptrdiff_t>(y * width), width, column.begin());
    const auto squared_distance = [&](std::size_t x) {
      const double d = static_cast<double>(column[x]) - static_cast<double>(y);
      return d * d;
    };
    envelope(
        width, [&](std::size_t x) { return column[x] != no_index; }, squared_distance, nearest);
    for (std::size_t x = 0; x < width; ++x)
      if (nearest[x] != no_index)
        result[y * width + x] = static_cast<Index>(column[nearest[x]] * width + nearest[x]);
  }
  return result;
}

} // namespace Atlas::internal

#endif
