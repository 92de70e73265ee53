// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_CUT_SOCKS_H
#define ATLAS_SEGMENTATION_INTERNAL_CUT_SOCKS_H

#include <Atlas/Surface.h>
#include <Atlas/segmentation/distance_to_features.h>
#include <Atlas/segmentation/internal/Piece.h>
#include <Atlas/segmentation/internal/triangle_geometry.h>
#include <Atlas/segmentation/internal/whole_surface.h>

#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// \brief Cuts charts like socks (capped cylinders) from the seed to the border, along the steepest descent.
class Sock_cutter
{
public:
  Sock_cutter(const Surface& surface, const Piece& piece, const Distance_field& field,
              Segmentation& segmentation)
      : surface_(surface), piece_(piece), field_(field), segmentation_(segmentation)
  {}

  /// A sock has area / perimeter^2 greater than that. Linear.
  void run(double sock_ratio)
  {
    struct Measure
    {
      double area = 0, perimeter = 0;
      Index seed = no_index;
    };
    std::vector<Measure> measures(segmentation_.number_of_charts);
    for (Index t = 0; t < surface_.number_of_triangles(); ++t) {
      Measure& m = measures[segmentation_.chart[t]];
      m.area += triangle_area(surface_, t);
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (!segmentation_.is_glued(surface_, h))
          m.perimeter += edge_length(surface_, h);
      if (m.seed == no_index || field_.triangle[t] > field_.triangle[m.seed])
        m.seed = t;
    }
    for (const Measure& m : measures)
      if (m.perimeter > 0 && m.area > sock_ratio * m.perimeter * m.perimeter)
        cut_from(m.seed);
  }

private:
  double height(Index h) const { return field_.vertex[piece_.vertex[h]]; }

  void cut_from(Index seed)
  {
    Index h = 3 * seed;
    for (Index k = h + 1; k < 3 * seed + 3; ++k)
      if (height(k) > height(h))
        h = k;
    std::vector<Index> path;
    for (Index v = piece_.vertex[h]; !is_on_border(v); v = piece_.head(path.back())) {
      const Index down = steepest_descent(v);
      if (down == no_index)
        return;
      path.push_back(down);
    }
    for (const Index p : path)
      segmentation_.cut[p] = segmentation_.cut[piece_.opposite[p]] = 1;
  }

  bool is_on_border(Index v) const
  {
    for (Index k = piece_.first[v]; k < piece_.first[v + 1]; ++k)
      if (!segmentation_.is_glued(surface_, piece_.outgoing[k]))
        return true;
    return false;
  }

  Index steepest_descent(Index v) const
  {
    Index best = no_index;
    double steepest = 0;
    for (Index k = piece_.first[v]; k < piece_.first[v + 1]; ++k) {
      const Index h = piece_.outgoing[k];
      const double fall = height(h) - field_.vertex[piece_.head(h)];
      if (!(fall > 0) || must_not_cut(surface_, h))
        continue;
      const double slope = fall / edge_length(surface_, h);
      if (best == no_index || slope > steepest) {
        steepest = slope;
        best = h;
      }
    }
    return best;
  }

  const Surface& surface_;
  const Piece& piece_;
  const Distance_field& field_;
  Segmentation& segmentation_;
};

} // namespace Atlas::internal

#endif
