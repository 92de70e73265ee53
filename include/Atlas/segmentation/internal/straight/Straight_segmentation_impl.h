// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_STRAIGHT_STRAIGHT_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_STRAIGHT_STRAIGHT_SEGMENTATION_IMPL_H

#include <Atlas/core/internal/Quad_grid.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/core/internal/extract_triangles.h>
#include <Atlas/measure/internal/straight_layout.h>
#include <Atlas/segmentation/Merged_segmentation.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// A grid of quadrilaterals that is worth a chart.
struct Straight_piece
{
  std::vector<Index> triangles;
  std::vector<Index> cut; ///< halfedges along which a tube is opened
};

/// \brief Finds the regular grids of quadrilaterals of a surface, and opens tubes.
class Straight_piece_finder
{
public:
  Straight_piece_finder(const Surface& surface, const Distortion_bound& bound)
      : surface_(surface), bound_(bound), costs_(surface, std::numbers::pi / 4, 0.75),
        is_quad_(surface.number_of_triangles(), 0), local_(surface.number_of_triangles())
  {
    for (Index t = 0; t + 1 < is_quad_.size(); ++t)
      if (has_two_triangles(t))
        is_quad_[t] = is_quad_[t + 1] = 1;
  }

  std::vector<Straight_piece> run()
  {
    const Components components = connected_components(
        surface_.opposite, [&](Index t) { return is_quad_[t]; }, [&](Index h) { return is_link(h); });
    std::vector<Straight_piece> pieces(components.count), result;
    for (Index t = 0; t < is_quad_.size(); ++t)
      if (is_quad_[t])
        pieces[components.of_triangle[t]].triangles.push_back(t);
    for (Straight_piece& piece : pieces)
      if (may_be_cut_off(piece) && open(piece))
        result.push_back(std::move(piece));
    return result;
  }

private:
  /// A grid of fewer triangles than that is not worth a seam around it.
  static constexpr std::size_t least_triangles = 32;

  bool has_two_triangles(Index t) const
  {
    const auto is_same = [&](Index a, Index b) { return surface_.face[a] == surface_.face[b]; };
    return is_same(t, t + 1) && !(t > 0 && is_same(t - 1, t)) &&
           !(t + 2 < is_quad_.size() && is_same(t, t + 2));
  }

  bool is_link(Index h) const
  {
    return may_cross(surface_, h) && is_quad_[h / 3] && is_quad_[surface_.opposite[h] / 3];
  }

  /// Whether seams around the piece are allowed, and worth it if there are any.
  bool may_be_cut_off(const Straight_piece& piece) const
  {
    bool is_apart = true;
    for (const Index t : piece.triangles)
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (may_cross(surface_, h) && !is_link(h)) {
          is_apart = false;
          if (must_not_be_seam(surface_, h))
            return false;
        }
    return is_apart || piece.triangles.size() >= least_triangles;
  }

  /// Whether the piece is a grid that keeps the bound when it is straight. Finds the cut of a tube.
  bool open(Straight_piece& piece)
  {
    const auto is_link_here = [&](Index h) { return is_link(h); };
    const Quad_grid grid(surface_.opposite, piece.triangles, surface_.face, local_, is_link_here);
    if (!grid.is_grid() || (grid.is_tube() && !find_cut(grid, piece)))
      return false;
    std::vector<Index> cut = piece.cut;
    for (const Index h : piece.cut)
      cut.push_back(surface_.opposite[h]);
    std::sort(cut.begin(), cut.end());
    Chart chart = extract_triangles(
        surface_.opposite, piece.triangles, local_,
        [&](Index h) { return is_link(h) && !std::binary_search(cut.begin(), cut.end(), h); },
        [&](Index h) -> const Point_3& { return surface_.point(h); });
    return lay_out_straight(chart, surface_.face, bound_);
  }

  /// The cheapest line between two columns. False if the user forbids seams at every one.
  bool find_cut(const Quad_grid& grid, Straight_piece& piece) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (Index c = 0; c < grid.columns(); ++c) {
      std::vector<Index> line;
      double cost = 0;
      for (Index r = 0; r < grid.rows(); ++r) {
        line.push_back(grid.side(c, r, Quad_grid::left));
        cost += must_not_be_seam(surface_, line.back()) ? std::numeric_limits<double>::infinity()
                                                        : costs_(line.back()).cost;
      }
      if (cost < least) {
        least = cost;
        piece.cut = std::move(line);
      }
    }
    return !piece.cut.empty();
  }

  const Surface& surface_;
  const Distortion_bound& bound_;
  Seam_costs costs_;
  std::vector<std::uint8_t> is_quad_; ///< per triangle: whether its face is a quadrilateral
  std::vector<Index> local_;          ///< scratch
};

/// The surface with seams around the pieces.
inline Surface with_seams_around(const Surface& surface, const std::vector<Straight_piece>& pieces)
{
  std::vector<Index> piece(surface.number_of_triangles(), no_index);
  for (Index p = 0; p < pieces.size(); ++p)
    for (const Index t : pieces[p].triangles)
      piece[t] = p;
  Surface result = surface;
  result.constraint.resize(surface.opposite.size(), Edge_constraint::none);
  for (Index h = 0; h < surface.opposite.size(); ++h)
    if (const Index o = surface.opposite[h]; o != no_index && piece[h / 3] != piece[o / 3])
      result.constraint[h] = Edge_constraint::seam;
  return result;
}

/// Makes a chart of the piece, whatever charts it had.
inline void make_chart(const Surface& surface, const Straight_piece& piece, Segmentation& segmentation)
{
  for (const Index t : piece.triangles) {
    segmentation.chart[t] = segmentation.number_of_charts;
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (surface.opposite[h] != no_index)
        segmentation.cut[h] = must_be_seam(surface, h);
  }
  for (const Index h : piece.cut)
    segmentation.cut[h] = segmentation.cut[surface.opposite[h]] = 1;
  ++segmentation.number_of_charts;
}

/// Numbers the charts anew, in the order of their first triangles.
inline void number_anew(Segmentation& segmentation)
{
  std::vector<Index> number(segmentation.number_of_charts, no_index);
  segmentation.number_of_charts = 0;
  for (Index& c : segmentation.chart) {
    if (number[c] == no_index)
      number[c] = segmentation.number_of_charts++;
    c = number[c];
  }
}

} // namespace internal

ATLAS_INLINE Straight_segmentation::Straight_segmentation(Any_segmentation rest,
                                                          const Distortion_bound& bound)
    : rest_(std::move(rest)), bound_(bound)
{}

ATLAS_INLINE Segmentation Straight_segmentation::segment(const Surface& surface,
                                                         const Execution& execution) const
{
  const std::vector<internal::Straight_piece> pieces = internal::Straight_piece_finder(surface, bound_).run();
  if (pieces.empty())
    return rest_.segment(surface, execution);
  Segmentation result = rest_.segment(internal::with_seams_around(surface, pieces), execution);
  for (const internal::Straight_piece& piece : pieces)
    internal::make_chart(surface, piece, result);
  internal::number_anew(result);
  return result;
}

} // namespace Atlas

#endif
