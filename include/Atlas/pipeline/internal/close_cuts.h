// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_CLOSE_CUTS_H
#define ATLAS_PIPELINE_INTERNAL_CLOSE_CUTS_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/core/internal/edge_rules.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Glues the cuts of a flattened chart whose two sides have the same coordinates.
///
/// A flat plate with holes is cut from hole to hole to make it a disc, and unrolls so that the cuts close
/// again: nobody needs them after that. The chart then has as many border loops as the plate. Seams that the
/// user wants stay. Linear in the chart.
class Cut_closer
{
public:
  Cut_closer(const Surface& surface, Segmentation& segmentation)
      : surface_(surface), segmentation_(segmentation)
  {}

  /// \param local  scratch: per triangle of the surface
  void operator()(Chart& chart, std::vector<Index>& local)
  {
    const std::size_t n = chart.source.size();
    for (Index t = 0; t < n; ++t)
      local[chart.source[t]] = t;
    bool is_any_closed = false;
    for (Index t = 0; t < n; ++t)
      for (Index i = 0; i < 3; ++i) {
        const Index h = 3 * chart.source[t] + i, o = surface_.opposite[h];
        if (o == no_index || !segmentation_.cut[h] || must_be_seam(surface_, h) ||
            segmentation_.chart[o / 3] != segmentation_.chart[h / 3])
          continue;
        const auto at = [&](Index g) -> const Point_2& {
          return chart.uv[chart.triangles[local[g / 3]][g % 3]];
        };
        if (at(h) != at(next_halfedge(o)) || at(next_halfedge(h)) != at(o))
          continue;
        segmentation_.cut[h] = segmentation_.cut[o] = 0;
        is_any_closed = true;
      }
    if (is_any_closed)
      number_anew(chart, local);
  }

private:
  void number_anew(Chart& chart, std::vector<Index>& local)
  {
    Chart glued = extract_chart(surface_, segmentation_, chart.source, local);
    glued.uv.resize(glued.points.size());
    for (std::size_t t = 0; t < glued.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i)
        glued.uv[glued.triangles[t][i]] = chart.uv[chart.triangles[t][i]];
    chart = std::move(glued);
  }

  const Surface& surface_;
  Segmentation& segmentation_;
};

} // namespace Atlas::internal

#endif
