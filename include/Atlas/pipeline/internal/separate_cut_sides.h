// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_SEPARATE_CUT_SIDES_H
#define ATLAS_PIPELINE_INTERNAL_SEPARATE_CUT_SIDES_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/pipeline/internal/round_coordinates.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// \brief Parts the two sides of a cut inside a chart where they lie on each other in the plane.
///
/// A flat ring that has been cut open unfolds onto itself: both sides of the cut get the same coordinates,
/// and who reads the coordinates sees a ring again instead of a disc. The vertices of one side are moved into
/// the chart by a few cells of the grid of stored coordinates, about a thousandth of a texel, so that the
/// chart is a disc for everybody. A vertex only moves inside the triangles around it, which keeps the map
/// one-to-one.
class Cut_side_separator
{
public:
  Cut_side_separator(const Surface& surface, const Segmentation& segmentation, Chart& chart)
      : surface_(surface), segmentation_(segmentation), chart_(chart)
  {}

  void operator()()
  {
    for (Index t = 0; t < chart_.triangles.size(); ++t)
      for (Index i = 0; i < 3; ++i)
        if (const Index h = 3 * t + i; is_closed_slit(h))
          open(h);
  }

private:
  static constexpr double step = 16 / grid_cells;

  Index vertex(Index h) const { return chart_.triangles[h / 3][h % 3]; }

  /// The local halfedge on the other side of a cut, or `no_index`.
  Index other_side(Index h) const
  {
    const Index global = 3 * chart_.source[h / 3] + h % 3, o = surface_.opposite[global];
    if (o == no_index || segmentation_.chart[o / 3] != segmentation_.chart[global / 3] ||
        segmentation_.is_glued(surface_, global))
      return no_index;
    const auto place = std::lower_bound(chart_.source.begin(), chart_.source.end(), o / 3);
    return 3 * static_cast<Index>(place - chart_.source.begin()) + o % 3;
  }

  bool is_closed_slit(Index h) const
  {
    const Index o = other_side(h);
    return o != no_index && chart_.uv[vertex(h)] == chart_.uv[vertex(next_halfedge(o))] &&
           chart_.uv[vertex(next_halfedge(h))] == chart_.uv[vertex(o)];
  }

  /// Moves an end of h that is not shared with the other side.
  void open(Index h)
  {
    const Index o = other_side(h), tail = vertex(h), head = vertex(next_halfedge(h));
    if (opposite_.empty())
      opposite_ = opposite_halfedges(chart_.triangles);
    if (tail != vertex(next_halfedge(o)) && move_inside(h))
      return;
    if (head != vertex(o))
      (void)move_inside(next_around_border(h));
  }

  /// The border halfedge that starts where border halfedge h ends.
  Index next_around_border(Index h) const
  {
    h = next_halfedge(h);
    while (opposite_[h] != no_index)
      h = next_halfedge(opposite_[h]);
    return h;
  }

  /// Moves the tail of border halfedge h to the left of both border edges that meet there, if all triangles
  /// around it stay positive.
  bool move_inside(Index h)
  {
    if (opposite_[h] != no_index)
      return false;
    std::vector<Index> fan{h / 3}; // triangles around the tail, from h to the border edge that ends there
    Index last = previous_halfedge(h);
    while (opposite_[last] != no_index) {
      fan.push_back(opposite_[last] / 3);
      last = previous_halfedge(opposite_[last]);
    }
    const Index v = vertex(h);
    const Point_2 start = chart_.uv[v], before = chart_.uv[vertex(last)],
                  after = chart_.uv[vertex(next_halfedge(h))];
    for (const double size : {step, step / 4})
      for (const auto& [x, y] :
           {std::array{1, 1}, {-1, 1}, {1, -1}, {-1, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
        const Point_2 moved(start.x() + x * size, start.y() + y * size);
        if (CGAL::orientation(before, start, moved) == CGAL::RIGHT_TURN ||
            CGAL::orientation(start, after, moved) == CGAL::RIGHT_TURN)
          continue;
        chart_.uv[v] = moved;
        if (std::all_of(fan.begin(), fan.end(), [&](Index t) { return is_positive(t); }))
          return true;
        chart_.uv[v] = start;
      }
    return false;
  }

  bool is_positive(Index t) const
  {
    const auto& [a, b, c] = chart_.triangles[t];
    return CGAL::orientation(chart_.uv[a], chart_.uv[b], chart_.uv[c]) == CGAL::LEFT_TURN;
  }

  const Surface& surface_;
  const Segmentation& segmentation_;
  Chart& chart_;
  std::vector<Index> opposite_;
};

} // namespace Atlas::internal

#endif
