// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_RENDERING_STENCIL_PAINTER_H
#define ATLAS_VALIDATION_INTERNAL_RENDERING_STENCIL_PAINTER_H

#include <Atlas/planar/internal/box_tree.h>
#include <Atlas/validation/Stencil_validator.h>
#include <Atlas/validation/internal/rendering/OSMesa_stencil.h>
#include <Atlas/validation/overlaps.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The triangles in texels, drawn tile by tile.
class Stencil_painter
{
public:
  /// \param stencil  of the size of a tile
  Stencil_painter(std::span<const Triangle_uv> triangles, Index resolution, unsigned max_layers,
                  OSMesa_stencil& stencil)
      : tile_(stencil.size()), max_layers_(max_layers), stencil_(stencil)
  {
    Box_2 box;
    for (const Triangle_uv& t : triangles)
      for (const Point_2& p : t)
        box.add(p.x(), p.y());
    const double side = std::max(box.x1 - box.x0, box.y1 - box.y0);
    if (!(side > 0))
      return;
    for (Index t = 0; t < triangles.size(); ++t) {
      Stencil_triangle drawn{{}, t};
      for (int i = 0; i < 3; ++i)
        drawn.corners[i] = Point_2((triangles[t][i].x() - box.x0) / side * resolution,
                                   (triangles[t][i].y() - box.y0) / side * resolution);
      triangles_.push_back(drawn);
    }
    columns_ = (resolution + tile_ - 1) / tile_;
  }

  Stencil_overlaps run()
  {
    std::vector<std::vector<Index>> lists = triangles_of_tiles();
    for (std::size_t i = 0; i < lists.size(); ++i)
      paint(static_cast<double>(i % columns_) * tile_, static_cast<double>(i / columns_) * tile_, lists[i]);
    remove_duplicates();
    return std::move(result_);
  }

private:
  /// Per tile the triangles whose boxes touch it.
  std::vector<std::vector<Index>> triangles_of_tiles() const
  {
    std::vector<std::vector<Index>> lists(std::size_t(columns_) * columns_);
    const auto tile = [&](double x) {
      return static_cast<Index>(std::clamp(x / tile_, 0.0, double(columns_) - 1));
    };
    for (const Stencil_triangle& t : triangles_) {
      Box_2 box;
      for (const Point_2& p : t.corners)
        box.add(p.x(), p.y());
      for (Index y = tile(box.y0); y <= tile(box.y1); ++y)
        for (Index x = tile(box.x0); x <= tile(box.x1); ++x)
          lists[std::size_t(y) * columns_ + x].push_back(t.id);
    }
    return lists;
  }

  void paint(double x, double y, const std::vector<Index>& list)
  {
    std::vector<Stencil_triangle> shifted;
    for (const Index t : list) {
      shifted.push_back(triangles_[t]);
      for (Point_2& p : shifted.back().corners)
        p = Point_2(p.x() - x, p.y() - y);
    }
    stencil_.load(shifted);
    const std::vector<std::uint8_t> counts = stencil_.counts();
    unsigned layers = 0;
    for (const std::uint8_t count : counts) {
      result_.covered_texels += count > 0;
      result_.overlapped_texels += count > 1;
      layers = std::max<unsigned>(layers, count);
    }
    if (layers < 2)
      return;
    if (layers > max_layers_)
      result_.overlaps.is_complete = false;
    std::vector<std::vector<Index>> ids;
    for (unsigned layer = 0; layer < std::min(layers, max_layers_); ++layer)
      ids.push_back(stencil_.ids(layer));
    collect_pairs(counts, ids);
  }

  /// All pairs of triangles that are drawn on the same texel.
  void collect_pairs(const std::vector<std::uint8_t>& counts, const std::vector<std::vector<Index>>& ids)
  {
    auto& pairs = result_.overlaps.pairs;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      for (std::size_t k = 1; k < std::min<std::size_t>(counts[i], ids.size()); ++k)
        for (std::size_t j = 0; j < k; ++j) {
          const std::pair<Index, Index> pair = std::minmax(ids[j][i], ids[k][i]);
          if (pairs.empty() || pairs.back() != pair)
            pairs.push_back(pair);
        }
      if (pairs.size() > max_unsorted_) {
        remove_duplicates();
        max_unsorted_ = std::max(max_unsorted_, 2 * pairs.size());
      }
    }
  }

  void remove_duplicates()
  {
    auto& pairs = result_.overlaps.pairs;
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

  Index tile_, columns_ = 0;
  unsigned max_layers_;
  OSMesa_stencil& stencil_;
  std::vector<Stencil_triangle> triangles_;
  Stencil_overlaps result_;
  std::size_t max_unsorted_ = 1 << 20; ///< pairs, before those that occur again are thrown out
};

} // namespace Atlas::internal

#endif
