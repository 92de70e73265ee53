// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_OBSTACLE_LAYOUT_H
#define ATLAS_PACKING_INTERNAL_PAGES_OBSTACLE_LAYOUT_H

#include <Atlas/core/Execution.h>
#include <Atlas/packing/Page_packer.h>
#include <Atlas/packing/internal/pages/Layout.h>
#include <Atlas/packing/internal/pages/scale_search.h>
#include <Atlas/packing/internal/raster/Raster_builder.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/Packing_shape.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// So many cells the distance field of an obstacle has along its radius at most: obstacles may be much larger
/// than the page.
inline constexpr double most_cells_of_obstacle = 2048;

/// How fine an obstacle is, when shapes are that fine.
inline Shape_resolution obstacle_resolution(Shape_resolution resolution, const Outline& outline)
{
  resolution.cell = std::max(resolution.cell, outline.radius / most_cells_of_obstacle);
  return resolution;
}

/// Packs charts around obstacles: on a raster, grown by so much that no rounding to pixels brings them too
/// near, with an exact test of every layout.
class Obstacle_packer
{
public:
  Obstacle_packer(const Outlines& outlines, const Obstacles& obstacles, const Page_task& page,
                  const Execution& execution)
      : outlines_(&outlines), obstacles_(&obstacles), page_(&page), execution_(&execution)
  {
    for (Index i = 0; i < outlines.size(); ++i)
      if (!outlines.charts[i].is_empty())
        numbers_.push_back(i);
    const double side = std::sqrt(double(page.width) * page.height);
    pixel_ = side / std::max(160.0, 9 * std::sqrt(static_cast<double>(numbers_.size())));
    const double scale = scale_bound(outlines.charts, page.width, page.height);
    shapes_.resize(numbers_.size());
    execution.for_each(shapes_.size(), [&](std::size_t i) {
      shapes_[i] = packing_shape(outlines.charts[numbers_[i]], resolution(scale));
    });
    for (const Outline& outline : obstacles.outlines) {
      obstacle_shapes_.push_back(packing_shape(outline, obstacle_resolution(resolution(1), outline)));
      obstacle_centres_.push_back(outline.centre);
    }
    order_.resize(shapes_.size());
    std::iota(order_.begin(), order_.end(), Index(0));
    std::stable_sort(order_.begin(), order_.end(),
                     [&](Index i, Index j) { return shapes_[i].radius > shapes_[j].radius; });
  }

  std::optional<Layout> layout(double scale, double margin)
  {
    if (execution_->is_cancelled())
      return std::nullopt;
    // Half a diagonal of a pixel, what distances on a grid and simplified outlines err by.
    const double grown = margin + 0.9 * pixel_;
    Raster_frame frame(page_->width, page_->height, pixel_);
    draw_obstacles(frame, obstacle_shapes_, obstacle_centres_, grown);
    const Raster_masks masks(shapes_, 16, scale, frame.pixel, grown, *execution_);
    std::vector<Index> order = order_;
    std::uint64_t work = 0;
    const auto found = build_on_raster(masks, frame, scale, order, 2, work);
    if (!found)
      return std::nullopt;
    Layout result{scale, margin, std::vector<Vec2>(outlines_->size(), Vec2{1, 0}),
                  std::vector<Vec2>(outlines_->size())};
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      result.turns[numbers_[i]] = rotated(found->turns[i], shapes_[i].frame);
      result.positions[numbers_[i]] = found->positions[i];
    }
    if (!keeps_margin(*outlines_, result, margin, *obstacles_, page_->width, page_->height))
      return std::nullopt;
    return result;
  }

private:
  Shape_resolution resolution(double scale) const
  {
    Shape_resolution result;
    result.tolerance = 0.05 * pixel_ / scale;
    result.spacing = pixel_ / scale;
    result.cell = 0.5 * pixel_ / scale;
    result.gutter = (page_->gutter + 2 * pixel_) / scale;
    return result;
  }

  const Outlines* outlines_;
  const Obstacles* obstacles_;
  const Page_task* page_;
  const Execution* execution_;
  std::vector<Index> numbers_; ///< of the outlines that are not empty
  std::vector<Packing_shape> shapes_, obstacle_shapes_;
  std::vector<Vec2> obstacle_centres_;
  std::vector<Index> order_;
  double pixel_ = 1;
};

/// The layout at the largest scale that is found, at most the one wanted; none if there is no room at all.
inline std::optional<Layout> obstacle_layout(const Outlines& outlines, const Obstacles& obstacles,
                                             const Page_task& page, const Execution& execution)
{
  Obstacle_packer packer(outlines, obstacles, page, execution);
  return search_scale(outlines, page, 0.002,
                      [&](double scale, double margin) { return packer.layout(scale, margin); });
}

} // namespace Atlas::internal

#endif
