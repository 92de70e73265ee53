// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_CHART_BOUNDARIES_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_CHART_BOUNDARIES_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>

#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// \brief The charts of a surface and the set of edges between them, the paper's chart_boundaries.
///
/// At first every edge is a boundary. Opening one removes it, together with all loose ends: edges that end
/// where no other boundary is. What is left of the boundary inside a chart is what makes it a disc. Every
/// edge is removed at most once, so all calls together take linear time.
class Chart_boundaries
{
public:
  Chart_boundaries(const Surface& surface, const Submesh& submesh)
      : surface_(&surface), submesh_(&submesh), chart_(submesh.triangles.size(), no_index),
        is_boundary_(submesh.opposite.size(), 1), degree_(submesh.number_of_vertices(), 0)
  {
    for (Index h = 0; h < is_boundary_.size(); ++h)
      if (const Index o = submesh.opposite[h]; o == no_index || h < o) {
        ++degree_[submesh.vertex[h]];
        ++degree_[submesh.head(h)];
      }
  }

  Index new_chart() { return charts_.add(); }

  /// Charts are named by numbers below that; some names are those of charts merged into others.
  Index number_of_names() const { return static_cast<Index>(charts_.size()); }

  /// The chart of a triangle, or no_index.
  Index chart(Index t) { return chart_[t] == no_index ? no_index : charts_.find(chart_[t]); }

  void put(Index t, Index c) { chart_[t] = c; }

  /// Makes two charts one and returns its number.
  Index unite(Index c, Index d)
  {
    charts_.unite(c, d);
    return charts_.find(c);
  }

  bool is_boundary(Index h) const { return is_boundary_[h]; }

  /// Removes the edge and the loose ends that this makes. Both sides belong to one chart.
  void open(Index h)
  {
    remove(h);
    shorten(submesh_->vertex[h]);
    shorten(submesh_->head(h));
  }

  /// Charts numbered by their first triangles; boundaries inside a chart are cuts.
  Segmentation segmentation()
  {
    Segmentation result;
    result.chart.resize(chart_.size());
    result.cut.assign(is_boundary_.size(), 0);
    std::vector<Index> number(charts_.size(), no_index);
    for (Index t = 0; t < chart_.size(); ++t) {
      Index& n = number[chart(t)];
      if (n == no_index)
        n = result.number_of_charts++;
      result.chart[t] = n;
    }
    for (Index h = 0; h < is_boundary_.size(); ++h) {
      const Index o = surface_->opposite[h];
      result.cut[h] = o != no_index && is_boundary_[h] && result.chart[h / 3] == result.chart[o / 3] &&
                      !surface_->is_diagonal(h);
    }
    return result;
  }

private:
  void remove(Index h)
  {
    is_boundary_[h] = is_boundary_[submesh_->opposite[h]] = 0;
    --degree_[submesh_->vertex[h]];
    --degree_[submesh_->head(h)];
  }

  /// Follows a loose end that starts at v.
  void shorten(Index v)
  {
    while (degree_[v] == 1 && !submesh_->is_on_border[v]) {
      const Index h = boundary_at(v);
      remove(h);
      v = submesh_->head(h);
    }
  }

  Index boundary_at(Index v) const
  {
    Index k = submesh_->first[v];
    while (!is_boundary_[submesh_->outgoing[k]])
      ++k;
    return submesh_->outgoing[k];
  }

  const Surface* surface_;
  const Submesh* submesh_;
  std::vector<Index> chart_; ///< per triangle, a chart that may have been merged into another
  Union_find charts_;
  std::vector<std::uint8_t> is_boundary_;
  std::vector<Index> degree_; ///< per vertex: boundaries that end there
};

} // namespace Atlas::internal

#endif
