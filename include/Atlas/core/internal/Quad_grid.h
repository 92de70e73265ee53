// SPDX-License-Identifier: MIT
#ifndef ATLAS_CORE_INTERNAL_QUAD_GRID_H
#define ATLAS_CORE_INTERNAL_QUAD_GRID_H

#include <Atlas/core/Kernel.h>
#include <Atlas/core/internal/halfedges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief A set of triangles as a regular grid of quadrilaterals, if it is one: rows and columns without a
/// gap, flat or closed to a tube.
///
/// Quadrilaterals get columns and rows one after the other, over their sides. Around a vertex of other than
/// four faces, or a hole, that leads to contradictions or to cells that are missing. Linear.
class Quad_grid
{
public:
  /// Sides of a cell: counterclockwise.
  enum Direction : Index { bottom, right, top, left };

  /// \param triangles  in increasing order; those of a face follow each other
  /// \param face       per triangle
  /// \param local      scratch: per triangle of the mesh
  /// \param is_link    whether the grid may go on across a halfedge
  template <typename IsLink>
  Quad_grid(const std::vector<Index>& opposite, std::span<const Index> triangles,
            const std::vector<Index>& face, std::vector<Index>& local, IsLink is_link)
  {
    if (!find_quads(opposite, triangles, face, local))
      return;
    const auto neighbour = [&](Index q, Index side) -> std::pair<Index, Index> {
      const Index h = quads_[q][side];
      if (!is_link(h))
        return {no_index, 0};
      const Index o = opposite[h], n = local[o / 3];
      const auto& sides = quads_[n];
      return {n, static_cast<Index>(std::find(sides.begin(), sides.end(), o) - sides.begin())};
    };
    is_grid_ = spread(neighbour, 0);
    if (is_grid_ && period_[1] > 0) // tubes go around in rows
      is_grid_ = spread(neighbour, 1);
    is_grid_ = is_grid_ && fill_cells();
  }

  bool is_grid() const { return is_grid_; }
  bool is_tube() const { return period_[0] > 0; }
  Index columns() const { return columns_; }
  Index rows() const { return rows_; }

  /// The halfedge of a cell's side.
  Index side(Index column, Index row, Direction direction) const
  {
    const Index q = cells_[row * columns_ + column];
    return quads_[q][(direction + 4 - rotation_[q]) % 4];
  }

private:
  /// Pairs of triangles with a common diagonal, and nothing else.
  bool find_quads(const std::vector<Index>& opposite, std::span<const Index> triangles,
                  const std::vector<Index>& face, std::vector<Index>& local)
  {
    for (std::size_t i = 0; i < triangles.size(); i += 2) {
      if (i + 1 == triangles.size() || face[triangles[i]] != face[triangles[i + 1]])
        return false;
      const Index t = triangles[i], u = triangles[i + 1];
      Index diagonal = no_index, count = 0;
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (opposite[h] != no_index && opposite[h] / 3 == u) {
          diagonal = h;
          ++count;
        }
      if (count != 1)
        return false;
      const Index o = opposite[diagonal];
      local[t] = local[u] = static_cast<Index>(quads_.size());
      quads_.push_back(
          {next_halfedge(diagonal), previous_halfedge(diagonal), next_halfedge(o), previous_halfedge(o)});
    }
    return !quads_.empty();
  }

  /// Gives all quadrilaterals a place, the first one turned by `rotation`. False at contradictions other than
  /// that of a tube.
  template <typename Neighbour>
  bool spread(Neighbour neighbour, Index rotation)
  {
    constexpr std::array<std::array<long, 2>, 4> step{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    constexpr Index unknown = 4;
    rotation_.assign(quads_.size(), unknown);
    place_.assign(quads_.size(), {0, 0});
    period_ = {0, 0};
    links_ = 0;
    rotation_[0] = rotation;
    std::vector<Index> queue{0};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const Index q = queue[i];
      for (Index side = 0; side < 4; ++side) {
        const auto [n, its_side] = neighbour(q, side);
        if (n == no_index)
          continue;
        ++links_;
        const Index direction = (side + rotation_[q]) % 4, turned = (direction + 6 - its_side) % 4;
        const std::array<long, 2> there{place_[q][0] + step[direction][0], place_[q][1] + step[direction][1]};
        if (rotation_[n] == unknown) {
          rotation_[n] = turned;
          place_[n] = there;
          queue.push_back(n);
        } else if (rotation_[n] != turned || !is_periodic(there, place_[n])) {
          return false;
        }
      }
    }
    return queue.size() == quads_.size() && (period_[0] == 0 || period_[1] == 0);
  }

  bool is_periodic(const std::array<long, 2>& a, const std::array<long, 2>& b)
  {
    const std::array<long, 2> way{std::labs(a[0] - b[0]), std::labs(a[1] - b[1])};
    period_ = {std::gcd(period_[0], way[0]), std::gcd(period_[1], way[1])};
    return way[0] == 0 || way[1] == 0;
  }

  /// Whether there is one quadrilateral in each cell, linked to all cells beside it.
  bool fill_cells()
  {
    std::array<long, 2> low = place_[0], high = place_[0];
    for (std::array<long, 2>& p : place_) {
      if (is_tube())
        p[0] = ((p[0] % period_[0]) + period_[0]) % period_[0];
      for (int k : {0, 1}) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    if (is_tube())
      low[0] = 0, high[0] = period_[0] - 1;
    columns_ = static_cast<Index>(high[0] - low[0] + 1);
    rows_ = static_cast<Index>(high[1] - low[1] + 1);
    if (std::size_t(columns_) * rows_ != quads_.size())
      return false;
    cells_.assign(quads_.size(), no_index);
    for (Index q = 0; q < quads_.size(); ++q) {
      Index& cell = cells_[static_cast<Index>(place_[q][1] - low[1]) * columns_ +
                           static_cast<Index>(place_[q][0] - low[0])];
      if (cell != no_index)
        return false;
      cell = q;
    }
    const std::size_t beside = std::size_t(columns_ - (is_tube() ? 0 : 1)) * rows_,
                      above = columns_ * (rows_ - std::size_t(1));
    return links_ == 2 * (beside + above);
  }

  bool is_grid_ = false;
  std::vector<std::array<Index, 4>> quads_; ///< halfedges of the sides, counterclockwise
  std::vector<Index> rotation_;             ///< per quadrilateral: the direction of its first side
  std::vector<std::array<long, 2>> place_;  ///< per quadrilateral: column and row
  std::array<long, 2> period_{0, 0};        ///< of columns and rows; 0: not closed
  std::size_t links_ = 0;
  Index columns_ = 0, rows_ = 0;
  std::vector<Index> cells_; ///< row by row: quadrilaterals
};

} // namespace Atlas::internal

#endif
