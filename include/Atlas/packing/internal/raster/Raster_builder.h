// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_RASTER_RASTER_BUILDER_H
#define ATLAS_PACKING_INTERNAL_RASTER_RASTER_BUILDER_H

#include <Atlas/core/Execution.h>
#include <Atlas/packing/internal/raster/Raster_page.h>
#include <Atlas/packing/internal/raster/raster_mask.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/Packing_shape.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Where each shape is on the page: the turn is relative to the shape's frame.
struct Shape_layout
{
  double scale = 0;
  std::vector<Vec2> turns, positions;
};

/// The turns that are tried: all multiples of a full turn by their number.
inline std::vector<Vec2> rotations(Index n)
{
  std::vector<Vec2> result;
  for (Index i = 0; i < n; ++i)
    result.push_back({std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n)});
  for (Vec2& r : result) { // quarter turns exactly
    if (std::abs(r.x) < 1e-9)
      r = {0, r.y > 0 ? 1.0 : -1.0};
    if (std::abs(r.y) < 1e-9)
      r = {r.x > 0 ? 1.0 : -1.0, 0};
  }
  return result;
}

/// The turns that are tried of a shape, of so many if it may turn freely.
inline std::vector<Vec2> turns_of(Chart_rotation rotation, Index n)
{
  return rotations(rotation == Chart_rotation::none ? 1 : rotation == Chart_rotation::quarter_turns ? 4 : n);
}

/// The masks of all shapes at some turns, made once for a size of pixel relative to the charts. The scale of
/// a layout is then that of its page: the fewer pixels, the larger the charts.
class Raster_masks
{
public:
  /// \param turns  number of turns of a shape that may turn freely
  /// \param pixel  side of a pixel at `scale`, in texels
  /// \param grow   what shapes are grown by, in texels
  Raster_masks(std::span<const Packing_shape> shapes, Index turns, double scale, double pixel, double grow,
               const Execution& execution)
      : scale_(scale), pixel_(pixel), turns_(shapes.size()), masks_(shapes.size())
  {
    execution.for_each(shapes.size(), [&](std::size_t i) {
      std::uint64_t work = 0;
      turns_[i] = turns_of(shapes[i].rotation, turns);
      masks_[i].resize(turns_[i].size());
      for (std::size_t r = 0; r < turns_[i].size(); ++r)
        make_mask(shapes[i], scale, turns_[i][r], grow, pixel, masks_[i][r], work);
    });
  }

  std::size_t number_of_shapes() const { return masks_.size(); }
  const std::vector<Vec2>& turns(std::size_t shape) const { return turns_[shape]; }
  const Raster_mask& mask(std::size_t shape, std::size_t turn) const { return masks_[shape][turn]; }
  /// The side of a pixel, in texels, when charts have that scale.
  double pixel(double scale) const { return pixel_ * scale / scale_; }

private:
  double scale_, pixel_;
  std::vector<std::vector<Vec2>> turns_;        ///< per shape
  std::vector<std::vector<Raster_mask>> masks_; ///< per shape and turn
};

/// A raster page somewhere on a page of texels.
struct Raster_frame
{
  double pixel;
  Raster_page page;
  Vec2 offset; ///< of the raster's lower left corner, in texels

  Raster_frame(double width, double height, double side_of_pixel)
      : pixel(std::min({side_of_pixel, width, height})),
        page(static_cast<Index>(width / pixel), static_cast<Index>(height / pixel)),
        offset{(width - page.columns() * pixel) / 2, (height - page.rows() * pixel) / 2}
  {}

  /// Where the centre of a chart is whose mask is put at a place.
  Vec2 position(const Raster_mask& mask, const Raster_page::Place& place) const
  {
    const double border = Raster_page::border;
    return offset + pixel * (mask.origin + Vec2{place.x - border, place.y - border});
  }
};

/// Rows in which masks of about the same size were found to have no place any longer.
class Row_hints
{
public:
  Index first_row(const Raster_mask& mask) const { return rows_[size_class(mask)]; }
  void note(const Raster_mask& mask, Index row)
  {
    const Index back = mask.height + mask.height / 2 + 4;
    Index& hint = rows_[size_class(mask)];
    hint = std::max(hint, row > back ? row - back : 0);
  }

private:
  static std::size_t size_class(const Raster_mask& mask)
  {
    return std::min<std::size_t>(
        255, static_cast<std::size_t>(4 * std::log2(double(mask.width + 1) * (mask.height + 1))));
  }
  std::vector<Index> rows_ = std::vector<Index>(256, 0);
};

/// Places all shapes in the given order, each where it touches most of what is there; with many shapes, in
/// the lowest rows that have room. A shape that finds no place moves forward in the order, and all begins
/// anew, at most `tries` times.
///
/// \param empty  the page, empty but for what is not to be moved
inline std::optional<Shape_layout> build_on_raster(const Raster_masks& masks, const Raster_frame& empty,
                                                   double scale, std::vector<Index>& order, int tries,
                                                   std::uint64_t& work)
{
  const std::size_t n = masks.number_of_shapes();
  const bool is_banded = n > 300;
  Raster_frame frame = empty;
  Shape_layout layout{scale, std::vector<Vec2>(n, Vec2{1, 0}), std::vector<Vec2>(n)};
  Row_hints hints;
  const auto place = [&](Index i) {
    Raster_page::Place best;
    double best_score = -HUGE_VAL;
    std::size_t best_turn = 0;
    for (std::size_t r = 0; r < masks.turns(i).size(); ++r) {
      const Raster_mask& mask = masks.mask(i, r);
      const auto found = is_banded
                             ? frame.page.search(mask, hints.first_row(mask), mask.height / 2 + 2, -1, work)
                             : frame.page.search(mask, 0, frame.page.rows(), best.score, work);
      if (!found)
        continue;
      const double score = is_banded ? found->score - 2.0 * found->y / frame.page.rows() : found->score;
      if (score > best_score) {
        best_score = score;
        best = *found;
        best_turn = r;
      }
    }
    if (best.score < 0)
      return false;
    const Raster_mask& mask = masks.mask(i, best_turn);
    frame.page.put(mask, best.x, best.y);
    hints.note(mask, best.y);
    layout.turns[i] = masks.turns(i)[best_turn];
    layout.positions[i] = frame.position(mask, best);
    return true;
  };
  for (int t = 0; t < tries; ++t) {
    if (t > 0)
      frame = empty;
    hints = Row_hints();
    std::size_t k = 0;
    while (k < n && place(order[k]))
      ++k;
    if (k == n)
      return layout;
    const auto failed = order.begin() + static_cast<std::ptrdiff_t>(k);
    std::rotate(order.begin() + static_cast<std::ptrdiff_t>(k / 2), failed, failed + 1);
  }
  return std::nullopt;
}

/// Occupies the pixels of a grown shape; call `update()` of the page afterwards. Gives the number of pixels
/// in its box, on the page or not.
inline double draw_shape(Raster_frame& frame, const Packing_shape& shape, double scale, Vec2 turn,
                         Vec2 position, double grow)
{
  const Vec2 at = position - frame.offset;
  const Corners box = box_of(shape.hull, scale * turn, at);
  const auto index = [&](double v) { return std::floor(v / frame.pixel); };
  const double x0 = index(box.low.x - grow), x1 = index(box.high.x + grow), y0 = index(box.low.y - grow),
               y1 = index(box.high.y + grow);
  const Vec2 back{turn.x / scale, -turn.y / scale};
  for (double y = std::max(y0, 0.0); y <= std::min(y1, frame.page.rows() - 1.0); ++y)
    for (double x = std::max(x0, 0.0); x <= std::min(x1, frame.page.columns() - 1.0); ++x) {
      const Vec2 p = frame.pixel * Vec2{x + 0.5, y + 0.5} - at;
      if (shape.field.estimate(rotated(back, p)) * scale < grow)
        frame.page.put_pixel(static_cast<Index>(x), static_cast<Index>(y));
    }
  return std::max(0.0, x1 - x0 + 1) * std::max(0.0, y1 - y0 + 1);
}

/// Occupies the pixels of grown obstacles, whose shapes are in texels.
inline void draw_obstacles(Raster_frame& frame, std::span<const Packing_shape> shapes,
                           std::span<const Vec2> centres, double grow)
{
  for (std::size_t i = 0; i < shapes.size(); ++i)
    draw_shape(frame, shapes[i], 1, {1, 0}, centres[i], grow);
  frame.page.update();
}

/// Puts the first shapes of a layout on a page, but for those left out.
inline void draw_on_raster(Raster_frame& frame, std::span<const Packing_shape> shapes,
                           const Shape_layout& layout, const std::vector<bool>& is_left_out, double grow,
                           std::uint64_t& work)
{
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (!is_left_out[i])
      work += 10 * static_cast<std::uint64_t>(draw_shape(frame, shapes[i], layout.scale, layout.turns[i],
                                                         layout.positions[i], grow));
  frame.page.update();
}

/// Puts one shape on the page where it touches most; tells whether there is a place.
inline bool insert_on_raster(Raster_frame& frame, const Packing_shape& shape, Index i,
                             const std::vector<Vec2>& turns, Vec2 twist, double grow, Shape_layout& layout,
                             std::uint64_t& work)
{
  Raster_mask mask, best_mask;
  Raster_page::Place best;
  for (const Vec2& turn : turns) {
    const Vec2 t = rotated(twist, turn);
    make_mask(shape, layout.scale, t, grow, frame.pixel, mask, work);
    if (const auto found = frame.page.search(mask, 0, frame.page.rows(), best.score, work)) {
      best = *found;
      layout.turns[i] = t;
      layout.positions[i] = frame.position(mask, best);
      std::swap(mask, best_mask);
    }
  }
  if (best.score < 0)
    return false;
  frame.page.put(best_mask, best.x, best.y);
  return true;
}

} // namespace Atlas::internal

#endif
