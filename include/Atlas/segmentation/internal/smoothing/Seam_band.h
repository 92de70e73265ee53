// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_SEAM_BAND_H
#define ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_SEAM_BAND_H

#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/merging/Chart_arcs.h>
#include <Atlas/segmentation/internal/merging/Coarse_surface.h>
#include <Atlas/segmentation/internal/smoothing/Segmentation_smoother.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The surface with its charts, as it is around the borders between charts, and coarse elsewhere.
///
/// Borders can be smoothed on it as on the surface itself, and charts be flattened for trial, at a cost that
/// grows with the length of the borders only.
class Seam_band
{
public:
  /// Marks of cuts between different charts are cleared.
  /// \param rings                of triangles around the borders that stay as they are
  /// \param triangles_per_chart  about as many triangles a chart has but for these
  Seam_band(const Surface& surface, Segmentation& segmentation, int rings, double triangles_per_chart)
  {
    (void)smoothing_limits(surface, segmentation);
    const Chart_arcs arcs = chart_arcs(surface, segmentation);
    Surface_simplifier simplifier(surface, segmentation, arcs, triangles_per_chart);
    for (const Index t : triangles_around_borders(surface, segmentation, rings))
      simplifier.keep_triangle(t);
    // The triangles of an input face move together.
    std::vector<std::uint8_t> is_movable(surface.number_of_faces, 1);
    for (Index t = 0; t < surface.number_of_triangles(); ++t)
      is_movable[surface.face[t]] &= simplifier.is_kept(t);
    Coarse_surface coarse = simplifier.run();
    take_segmentation(coarse, segmentation.number_of_charts);
    take_surface(surface, arcs, coarse);
    limits_ = smoothing_limits(surface_, segmentation_);
    for (Index t = 0; t < source_.size(); ++t)
      limits_.is_stuck[t] |= !is_movable[surface.face[source_[t]]];
  }

  const Surface& surface() const { return surface_; }
  Segmentation& segmentation() { return segmentation_; }
  const Smoothing_limits& limits() const { return limits_; }

  /// Writes to the segmentation of the surface where the borders are now.
  void write_back(Segmentation& segmentation) const
  {
    for (Index t = 0; t < source_.size(); ++t)
      if (!limits_.is_stuck[t])
        segmentation.chart[source_[t]] = segmentation_.chart[t];
  }

private:
  static std::vector<Index> triangles_around_borders(const Surface& surface, const Segmentation& segmentation,
                                                     int rings)
  {
    std::vector<std::uint8_t> is_reached(surface.number_of_triangles(), 0);
    std::vector<Index> reached;
    const auto reach = [&](Index t) {
      if (!is_reached[t])
        reached.push_back(t);
      is_reached[t] = 1;
    };
    for (Index h = 0; h < surface.opposite.size(); ++h)
      if (may_cross(surface, h) && segmentation.chart[h / 3] != segmentation.chart[surface.opposite[h] / 3])
        reach(h / 3);
    std::size_t begin = 0;
    for (int step = 1; step < 2 * rings; ++step)
      for (const std::size_t end = reached.size(); begin < end; ++begin)
        for (Index h = 3 * reached[begin]; h < 3 * reached[begin] + 3; ++h)
          if (segmentation.is_glued(surface, h))
            reach(surface.opposite[h] / 3);
    return reached;
  }

  /// What bounds charts but must not move becomes a cut.
  void take_segmentation(Coarse_surface& coarse, Index charts)
  {
    segmentation_.number_of_charts = charts;
    segmentation_.cut.assign(coarse.opposite.size(), 0);
    for (Index h = 0; h < coarse.opposite.size(); ++h)
      if (const Index o = coarse.opposite[h]; o != no_index && coarse.side[h] != no_index)
        segmentation_.cut[h] = coarse.chart[h / 3] == coarse.chart[o / 3];
    segmentation_.chart = std::move(coarse.chart);
  }

  void take_surface(const Surface& surface, const Chart_arcs& arcs, Coarse_surface& coarse)
  {
    surface_.points = std::move(coarse.points);
    surface_.triangles = std::move(coarse.triangles);
    surface_.opposite = std::move(coarse.opposite);
    source_ = std::move(coarse.source);
    surface_.number_of_faces = surface.number_of_faces;
    surface_.number_of_corners = surface.number_of_corners;
    const std::size_t n = surface_.opposite.size();
    surface_.constraint.assign(n, Edge_constraint::none);
    if (!surface.seam_cost.empty())
      surface_.seam_cost.assign(n, 1);
    for (const Index t : source_)
      surface_.face.push_back(surface.face[t]);
    for (Index h = 0; h < n; ++h) {
      const Index o = surface_.opposite[h], original = 3 * source_[h / 3] + h % 3;
      surface_.corner.push_back(surface.corner[original]);
      if (o == no_index)
        continue;
      // Halfedges of triangles that have not changed have their edge, those of others may have any.
      const bool is_same = surface.opposite[original] == 3 * source_[o / 3] + o % 3;
      if (coarse.side[h] != no_index && arcs.must_be_seam[coarse.side[h] / 2])
        surface_.constraint[h] = Edge_constraint::seam;
      else if (is_same && !surface.constraint.empty())
        surface_.constraint[h] = surface.constraint[original];
      if (is_same && !surface.seam_cost.empty())
        surface_.seam_cost[h] = surface.seam_cost[original];
    }
  }

  Surface surface_;
  Segmentation segmentation_;
  Smoothing_limits limits_;
  std::vector<Index> source_; ///< per triangle: the one of the surface
};

} // namespace Atlas::internal

#endif
