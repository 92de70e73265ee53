// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_BORDER_SMOOTHER_H
#define ATLAS_SEGMENTATION_INTERNAL_BORDER_SMOOTHER_H

#include <Atlas/Chart.h>
#include <Atlas/Surface.h>
#include <Atlas/segmentation/internal/Disc_cutter.h>
#include <Atlas/segmentation/internal/Piece.h>
#include <Atlas/segmentation/internal/minimum_cut.h>
#include <Atlas/segmentation/internal/triangle_geometry.h>
#include <Atlas/segmentation/internal/whole_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// The piece as a chart of its own.
inline Chart chart_of_piece(const Surface& surface, const Piece& piece)
{
  Chart chart;
  chart.source = piece.triangles;
  chart.points.resize(piece.number_of_vertices());
  chart.triangles.resize(piece.triangles.size());
  for (Index h = 0; h < piece.vertex.size(); ++h) {
    chart.triangles[h / 3][h % 3] = piece.vertex[h];
    chart.points[piece.vertex[h]] = surface.point(piece.global(h));
  }
  return chart;
}

inline bool is_disc(const Piece& piece)
{
  return !piece.triangles.empty() && piece.euler() == 1 && piece.number_of_border_loops() == 1 &&
         connected_parts(piece).size() == 1 && ambiguous_triangles(piece).empty();
}

/// Scratch of the smoother, per triangle of the surface. Pairs of charts that have none in common can use one
/// at the same time.
struct Smoothing_scratch
{
  explicit Smoothing_scratch(std::size_t triangles) : slot(triangles), local(triangles) {}
  std::vector<Index> slot, local;
};

/// \brief Moves the border between two charts to the cheapest place in a band around it.
///
/// The triangles of the band become nodes, the edges between them links as strong as a seam there is
/// expensive, and the triangles beside the band stay what they are: a minimum cut is the best border.
class Border_smoother
{
public:
  /// \param cost  per halfedge of the surface: what a seam there costs
  Border_smoother(const Surface& surface, const Segmentation& segmentation, const std::vector<float>& cost,
                  const std::vector<Index>& a, const std::vector<Index>& b, Smoothing_scratch& scratch)
      : surface_(surface), segmentation_(segmentation),
        cost_(cost), charts_{segmentation.chart[a.front()], segmentation.chart[b.front()]}, triangles_(a),
        scratch_(scratch)
  {
    triangles_.insert(triangles_.end(), b.begin(), b.end());
    std::sort(triangles_.begin(), triangles_.end());
    for (Index i = 0; i < triangles_.size(); ++i) {
      scratch_.slot[triangles_[i]] = i;
      side_.push_back(segmentation.chart[triangles_[i]] == charts_[1]);
    }
  }

  /// Whether there is a cheaper border than the present one at most `rings` rings of triangles away with
  /// which both charts are discs.
  bool run(int rings)
  {
    find_band(rings);
    return !band_.empty() && find_cheapest_border() && is_disc(piece(0)) && is_disc(piece(1));
  }

  /// The triangles of one chart after run().
  std::vector<Index> triangles(int side) const
  {
    std::vector<Index> result;
    for (Index i = 0; i < triangles_.size(); ++i)
      if (side_[i] == side)
        result.push_back(triangles_[i]);
    return result;
  }

  /// One chart after run().
  Piece piece(int side)
  {
    return make_piece(
        surface_, triangles(side),
        [&](Index h) { return is_open(h) && side_of(h) == side_of(surface_.opposite[h]); }, scratch_.local);
  }

private:
  std::uint8_t side_of(Index h) const { return side_[scratch_.slot[h / 3]]; }

  /// Whether both sides of the edge are in these two charts and no cut runs there.
  bool is_open(Index h) const
  {
    const Index o = surface_.opposite[h];
    return may_cross(surface_, h) && !segmentation_.cut[h] &&
           (segmentation_.chart[o / 3] == charts_[0] || segmentation_.chart[o / 3] == charts_[1]);
  }

  /// Triangles that may change sides: near the border, and not at a cut inside a chart, which would lose its
  /// end.
  void find_band(int rings)
  {
    std::vector<Index> ends_of_cuts;
    std::vector<Index> front;
    node_.assign(triangles_.size(), no_index);
    std::vector<std::uint8_t> is_seen(triangles_.size(), 0);
    for (Index i = 0; i < triangles_.size(); ++i)
      for (Index h = 3 * triangles_[i]; h < 3 * triangles_[i] + 3; ++h) {
        if (surface_.opposite[h] != no_index && segmentation_.cut[h]) {
          ends_of_cuts.push_back(surface_.triangles[h / 3][h % 3]);
          ends_of_cuts.push_back(surface_.triangles[h / 3][(h + 1) % 3]);
        }
        if (!is_seen[i] && is_open(h) && side_of(h) != side_of(surface_.opposite[h])) {
          is_seen[i] = 1;
          front.push_back(i);
        }
      }
    std::sort(ends_of_cuts.begin(), ends_of_cuts.end());
    const auto is_at_cut = [&](Index i) {
      const auto& corners = surface_.triangles[triangles_[i]];
      return std::any_of(corners.begin(), corners.end(), [&](Index v) {
        return std::binary_search(ends_of_cuts.begin(), ends_of_cuts.end(), v);
      });
    };
    for (int step = 0; step < 2 * rings; ++step) {
      std::vector<Index> beyond;
      for (const Index i : front) {
        if (!is_at_cut(i)) {
          node_[i] = static_cast<Index>(band_.size());
          band_.push_back(i);
        }
        for (Index h = 3 * triangles_[i]; h < 3 * triangles_[i] + 3; ++h)
          if (is_open(h)) {
            const Index j = scratch_.slot[surface_.opposite[h] / 3];
            if (!is_seen[j]) {
              is_seen[j] = 1;
              beyond.push_back(j);
            }
          }
      }
      front.swap(beyond);
    }
  }

  /// Whole numbers, relative to the largest cost in the band; an edge that cannot be a seam costs more than
  /// all others together.
  std::int64_t capacity(Index h, double largest) const
  {
    constexpr double steps = 1e6;
    constexpr std::int64_t never = std::int64_t(1) << 50;
    if (surface_.is_diagonal(h))
      return never;
    return largest > 0 ? 1 + static_cast<std::int64_t>(steps * (static_cast<double>(cost_[h]) / largest)) : 1;
  }

  bool find_cheapest_border()
  {
    double largest = 0;
    for (const Index i : band_)
      for (Index h = 3 * triangles_[i]; h < 3 * triangles_[i] + 3; ++h)
        if (std::isfinite(cost_[h]))
          largest = std::max(largest, static_cast<double>(cost_[h]));
    Minimum_cut cut(band_.size());
    std::int64_t before = 0;
    for (Index n = 0; n < band_.size(); ++n) {
      const Index t = triangles_[band_[n]];
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        if (!is_open(h))
          continue;
        const Index o = surface_.opposite[h], m = node_[scratch_.slot[o / 3]];
        if (m != no_index && m < n)
          continue;
        const std::int64_t c = capacity(h, largest);
        cut.connect(n, m != no_index ? m : band_.size() + side_of(o), c);
        before += side_of(h) != side_of(o) ? c : 0;
      }
    }
    // A gain of less than a thousandth is not worth a change.
    if (cut.run() >= before - before / 1000)
      return false;
    for (Index n = 0; n < band_.size(); ++n)
      side_[band_[n]] = !cut.is_on_first_side(n);
    return true;
  }

  const Surface& surface_;
  const Segmentation& segmentation_;
  const std::vector<float>& cost_;
  std::array<Index, 2> charts_;
  std::vector<Index> triangles_; ///< of both charts, increasing
  Smoothing_scratch& scratch_;
  std::vector<std::uint8_t> side_; ///< per entry of triangles_: which chart
  std::vector<Index> band_;        ///< entries of triangles_ that may change sides
  std::vector<Index> node_;        ///< the reverse
};

} // namespace Atlas::internal

#endif
