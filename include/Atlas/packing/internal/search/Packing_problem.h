// SPDX-License-Identifier: MIT
#ifndef ATLAS_PACKING_INTERNAL_SEARCH_PACKING_PROBLEM_H
#define ATLAS_PACKING_INTERNAL_SEARCH_PACKING_PROBLEM_H

#include <Atlas/packing/internal/raster/Raster_builder.h>
#include <Atlas/packing/internal/shapes/Coarse_shape.h>
#include <Atlas/packing/internal/shapes/Outline.h>
#include <Atlas/packing/internal/shapes/Packing_shape.h>
#include <Atlas/packing/internal/shapes/chart_clearance.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace Atlas::internal {

/// What all searches of one packing have in common.
struct Packing_problem
{
  std::vector<const Outline*> outlines; ///< of the shapes
  std::vector<Packing_shape> shapes;    ///< those that move, then obstacles, which are in texels
  std::size_t movable = 0;              ///< shapes that move
  double width = 0, height = 0;
  double gutter = 0;    ///< to be kept exactly
  double fineness = 1;  ///< of rasters and shapes
  double tolerance = 0; ///< of simplification, in texels
  /// No layout has a larger scale.
  double most_scale = std::numeric_limits<double>::infinity();
  Shape_layout fallback; ///< layouts of a smaller scale are of no use. Layouts have obstacles too
  std::optional<Raster_masks> masks;
  std::vector<Coarse_shape> coarse; ///< none with very many shapes

  std::span<const Packing_shape> movables() const { return std::span(shapes).first(movable); }
  std::span<const Packing_shape> obstacles() const { return std::span(shapes).subspan(movable); }
  std::span<const Vec2> obstacle_centres() const { return std::span(fallback.positions).subspan(movable); }

  /// The scale at which the charts, grown by half the gutter, fill that share of what obstacles leave of the
  /// page.
  double scale_of_share(double share) const
  {
    double a = 0, b = 0;
    for (const Packing_shape& s : movables()) {
      a += s.area;
      b += s.perimeter * gutter / 2;
    }
    double page = width * height;
    for (const Packing_shape& s : obstacles())
      page -= s.area + s.perimeter * gutter / 2;
    const double c = share * std::max(page, least_free_share * width * height);
    double scale = a > 0 ? (std::sqrt(b * b + 4 * a * c) - b) / (2 * a) : c / std::max(b, 1e-300);
    for (const Packing_shape& s : movables())
      if (s.radius > 0)
        scale = std::min(scale, std::hypot(width, height) / s.radius);
    return scale;
  }

  /// The side of a pixel: the finer the more shapes there are.
  double pixel() const
  {
    const double count = std::max(120 * fineness, 9 * std::sqrt(static_cast<double>(shapes.size())));
    return std::max(std::sqrt(width * height) / count, gutter / 4);
  }
  /// What shapes are grown by on a raster: not enough to keep them apart for sure, relaxing does the rest.
  double grown() const { return gutter / 2 + 0.5 * std::min({pixel(), width, height}); }

  /// What pushing apart can mend.
  double leniency() const { return 0.002 * std::sqrt(width * height); }

  /// A page with nothing but the obstacles on it.
  Raster_frame empty_page(double side_of_pixel) const
  {
    Raster_frame frame(width, height, side_of_pixel);
    if (!obstacles().empty())
      draw_obstacles(frame, obstacles(), obstacle_centres(), grown());
    return frame;
  }

  /// The outlines in their places.
  std::vector<Placed_outline> placed(const Shape_layout& layout) const
  {
    std::vector<Placed_outline> result(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      result[i].outline = outlines[i];
      const double scale = i < movable ? layout.scale : 1;
      const Vec2 r = scale * rotated(layout.turns[i], shapes[i].frame);
      for (const Vec2& p : outlines[i]->points)
        result[i].points.push_back(layout.positions[i] + rotated(r, p));
    }
    return result;
  }

private:
  static constexpr double least_free_share = 0.05; ///< of the page, whatever obstacles seem to take
};

} // namespace Atlas::internal

#endif
