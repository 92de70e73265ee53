// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_PAGES_OBSTACLE_LAYOUT_H
#define ATLAS_PACKING_INTERNAL_PAGES_OBSTACLE_LAYOUT_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Packing.h>
#include <Atlas/packing/internal/horizon/horizon_layout.h>
#include <Atlas/packing/internal/pages/scale_search.h>
#include <Atlas/packing/internal/raster/Raster_builder.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/Packing_shape.h>
#include <Atlas/packing/internal/shapes/chart_clearance.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace Atlas::internal {

/// The outlines of charts that stay where they are on a page, in texels.
struct Obstacles
{
  std::vector<Outline> outlines;

  void add(const Chart& chart, const Placement& placement)
  {
    Chart placed;
    placed.triangles = chart.triangles;
    for (const Point_2& p : chart.uv)
      placed.uv.push_back(placement(p));
    Outline outline;
    outline.centre = extent_of(placed).centre;
    build_outline(placed, 1, outline);
    if (!outline.is_empty())
      outlines.push_back(std::move(outline));
  }

  double area() const
  {
    return std::accumulate(outlines.begin(), outlines.end(), 0.0,
                           [](double sum, const Outline& o) { return sum + o.area; });
  }
};

/// Whether outlines keep twice the layout's margin from each other and from obstacles, and the margin from
/// the border of the page. Obstacles are not checked against each other.
inline bool keeps_margin(const Outlines& outlines, const Layout& layout, const Obstacles& obstacles,
                         const Page_options& page)
{
  std::vector<Placed_outline> placed;
  const auto place = [&](const Outline& outline, Vec2 r, Vec2 position) {
    placed.push_back({&outline, {}});
    for (const Vec2& p : outline.points)
      placed.back().points.push_back(position + rotated(r, p));
  };
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (outlines.charts[i].is_empty())
      continue;
    place(outlines.charts[i], layout.scale * layout.turns[i], layout.positions[i]);
    for (const Vec2& p : placed.back().points)
      if (std::min({p.x, p.y, page.width - p.x, page.height - p.y}) < layout.margin)
        return false;
  }
  const std::size_t movable = placed.size();
  for (const Outline& outline : obstacles.outlines)
    place(outline, {1, 0}, outline.centre);
  bool is_kept = true;
  Chart_clearance(placed, 2 * layout.margin).search([&](Index i, Index j, double) {
    is_kept = i >= movable && j >= movable;
    return is_kept;
  });
  return is_kept;
}

/// Packs charts around obstacles: on a raster, grown by so much that no rounding to pixels brings them too
/// near, with an exact test of every layout.
class Obstacle_packer
{
public:
  Obstacle_packer(const Outlines& outlines, const Obstacles& obstacles, const Page_options& page,
                  const Execution& execution)
      : outlines_(&outlines), obstacles_(&obstacles), page_(&page), execution_(&execution)
  {
    for (Index i = 0; i < outlines.size(); ++i)
      if (!outlines.charts[i].is_empty())
        numbers_.push_back(i);
    const double side = std::sqrt(double(page.width) * page.height);
    pixel_ = side / std::max(160.0, 9 * std::sqrt(static_cast<double>(numbers_.size())));
    const bool may_turn = page.rotation == Chart_rotation::any;
    turns_ = rotations(may_turn ? 16 : page.rotation == Chart_rotation::none ? 1 : 4);
    const double scale = scale_bound(outlines, page);
    shapes_.resize(numbers_.size());
    execution.for_each(shapes_.size(), [&](std::size_t i) {
      shapes_[i] = packing_shape(outlines.charts[numbers_[i]], resolution(scale), may_turn);
    });
    for (const Outline& outline : obstacles.outlines)
      obstacle_shapes_.push_back(packing_shape(outline, resolution(1), false));
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
    Shape_layout fixed{1, std::vector<Vec2>(obstacle_shapes_.size(), Vec2{1, 0}), {}};
    for (const Outline& outline : obstacles_->outlines)
      fixed.positions.push_back(outline.centre);
    std::uint64_t work = 0;
    draw_on_raster(frame, obstacle_shapes_, fixed, std::vector<bool>(obstacle_shapes_.size(), false), grown,
                   work);
    const Raster_masks masks(shapes_, turns_, scale, frame.pixel, grown, *execution_);
    std::vector<Index> order = order_;
    const auto found = build_on_raster(masks, frame, scale, order, 2, work);
    if (!found)
      return std::nullopt;
    Layout result{scale, margin, std::vector<Vec2>(outlines_->size(), Vec2{1, 0}),
                  std::vector<Vec2>(outlines_->size())};
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      result.turns[numbers_[i]] = rotated(found->turns[i], shapes_[i].frame);
      result.positions[numbers_[i]] = found->positions[i];
    }
    if (!keeps_margin(*outlines_, result, *obstacles_, *page_))
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
  const Page_options* page_;
  const Execution* execution_;
  std::vector<Index> numbers_; ///< of the outlines that are not empty
  std::vector<Packing_shape> shapes_, obstacle_shapes_;
  std::vector<Vec2> turns_;
  std::vector<Index> order_;
  double pixel_ = 1;
};

/// The layout at the largest scale that is found, at most `most_scale`; none if there is no room at all.
inline std::optional<Layout> obstacle_layout(const Outlines& outlines, const Obstacles& obstacles,
                                             const Page_options& page, double most_scale,
                                             const Execution& execution)
{
  Obstacle_packer packer(outlines, obstacles, page, execution);
  return search_scale(outlines, page, most_scale, 0.002,
                      [&](double scale, double margin) { return packer.layout(scale, margin); });
}

} // namespace Atlas::internal

#endif
