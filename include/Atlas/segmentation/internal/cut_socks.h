// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_CUT_SOCKS_H
#define ATLAS_SEGMENTATION_INTERNAL_CUT_SOCKS_H

#include <Atlas/Execution.h>
#include <Atlas/Surface.h>
#include <Atlas/extract_charts.h>
#include <Atlas/segmentation/internal/Front.h>
#include <Atlas/segmentation/internal/Piece.h>
#include <Atlas/segmentation/internal/triangle_geometry.h>
#include <Atlas/segmentation/internal/whole_surface.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Cuts charts like socks (capped cylinders) from the seed to the border, along the steepest descent.
///
/// Distances are to the border of the chart: the same as to the features if they are all on the border, and
/// where a feature ends inside a chart the cut still begins at the tip and reaches the border.
class Sock_cutter
{
public:
  Sock_cutter(const Surface& surface, Segmentation& segmentation)
      : surface_(surface), segmentation_(segmentation), local_(surface.number_of_triangles())
  {}

  /// A sock has area / perimeter^2 greater than that. O(n log n).
  void run(double sock_ratio, const Execution& execution)
  {
    std::vector<std::vector<Index>> lists = triangles_of_charts(segmentation_);
    std::vector<std::vector<Index>> cuts(lists.size());
    execution.for_each(lists.size(), [&](std::size_t c) {
      if (is_sock(lists[c], sock_ratio))
        cuts[c] = path_from_tip(std::move(lists[c]));
    });
    for (const std::vector<Index>& path : cuts)
      for (const Index h : path)
        segmentation_.cut[h] = segmentation_.cut[surface_.opposite[h]] = 1;
  }

private:
  bool is_sock(const std::vector<Index>& triangles, double ratio) const
  {
    double area = 0, perimeter = 0;
    for (const Index t : triangles) {
      area += triangle_area(surface_, t);
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (!segmentation_.is_glued(surface_, h))
          perimeter += edge_length(surface_, h);
    }
    return perimeter > 0 && area > ratio * perimeter * perimeter;
  }

  /// Halfedges of the surface; none if the way is barred.
  std::vector<Index> path_from_tip(std::vector<Index> triangles)
  {
    const Piece chart = make_piece(
        surface_, std::move(triangles), [&](Index h) { return segmentation_.is_glued(surface_, h); }, local_);
    std::vector<Index> border;
    for (Index v = 0; v < chart.number_of_vertices(); ++v)
      if (chart.is_on_border[v])
        border.push_back(v);
    Front front(surface_, chart);
    front.run(border);
    const std::vector<double>& height = front.distance();
    Index v = static_cast<Index>(std::max_element(height.begin(), height.end()) - height.begin());
    std::vector<Index> path;
    while (!chart.is_on_border[v]) {
      const Index down = steepest_descent(chart, height, v);
      if (down == no_index)
        return {};
      path.push_back(chart.global(down));
      v = chart.head(down);
    }
    return path;
  }

  Index steepest_descent(const Piece& chart, const std::vector<double>& height, Index v) const
  {
    Index best = no_index;
    double steepest = 0;
    for (Index k = chart.first[v]; k < chart.first[v + 1]; ++k) {
      const Index h = chart.outgoing[k];
      const double fall = height[v] - height[chart.head(h)];
      if (!(fall > 0) || must_not_cut(surface_, chart.global(h)))
        continue;
      const double slope = fall / edge_length(surface_, chart.global(h));
      if (best == no_index || slope > steepest) {
        steepest = slope;
        best = h;
      }
    }
    return best;
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  std::vector<Index> local_;
};

} // namespace Atlas::internal

#endif
