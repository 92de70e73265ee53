// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_FEATURES_SOCK_FINDER_H
#define ATLAS_SEGMENTATION_INTERNAL_FEATURES_SOCK_FINDER_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/core/internal/cuts.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/segmentation/internal/features/Fast_marching.h>
#include <Atlas/segmentation/internal/surface/Submesh.h>
#include <Atlas/segmentation/internal/surface/surface_connectivity.h>
#include <Atlas/segmentation/internal/surface/triangle_geometry.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// Socks of less than that share of the area of their chart are left alone: noise.
inline constexpr double least_share_of_sock = 0.01;

/// \brief Finds the socks (capped cylinders) in one chart and the cuts that open them.
///
/// The paper measures area / perimeter of whole charts. Here the chart is flooded backwards from the places
/// farthest from its border, and each connected part above the water line is measured, so that a finger is
/// found too if the chart goes on beyond it. The cut starts at the tip and follows the steepest descent to
/// the border. O(n log n) for n triangles.
class Sock_finder
{
public:
  Sock_finder(const Surface& surface, const Submesh& chart)
      : surface_(surface), chart_(chart), distances_(surface, chart), is_reached_(chart.is_on_border)
  {
    std::vector<Index> border;
    for (Index v = 0; v < chart.number_of_vertices(); ++v)
      if (chart.is_on_border[v])
        border.push_back(v);
    distances_.run(border);
  }

  /// Halfedges of the surface to cut. A sock has area / perimeter^2 greater than the ratio.
  std::vector<Index> cuts(double sock_ratio)
  {
    std::vector<Index> result;
    for (const Index t : tips_of_socks(sock_ratio)) {
      const std::vector<Index> path = path_down_from(highest_corner(t));
      result.insert(result.end(), path.begin(), path.end());
    }
    return result;
  }

  /// Halfedges of the surface to cut, from the seed to the border, if the chart as a whole is a sock: the
  /// paper's rule.
  /// \param seed  a triangle of the chart
  std::vector<Index> cut_of_whole_chart(double sock_ratio, Index seed)
  {
    double area = 0, perimeter = 0;
    for (Index t = 0; t < chart_.triangles.size(); ++t)
      area += triangle_area(surface_, chart_.triangles[t]);
    for (Index h = 0; h < chart_.opposite.size(); ++h)
      if (chart_.opposite[h] == no_index)
        perimeter += edge_length(surface_, chart_.global(h));
    return area > sock_ratio * perimeter * perimeter ? path_down_from(highest_corner(seed))
                                                     : std::vector<Index>();
  }

private:
  struct Part
  {
    double area = 0, perimeter = 0;
    Index tip = no_index; ///< the highest triangle
    bool is_sock = false;
  };

  double height(Index v) const { return distances_.distance()[v]; }

  double height_of_triangle(Index t) const
  {
    return height(chart_.vertex[3 * t]) + height(chart_.vertex[3 * t + 1]) + height(chart_.vertex[3 * t + 2]);
  }

  std::vector<Index> tips_of_socks(double sock_ratio) const
  {
    const auto n = static_cast<Index>(chart_.triangles.size());
    std::vector<double> heights(n);
    std::vector<Index> order(n);
    double total = 0;
    for (Index t = 0; t < n; ++t) {
      heights[t] = height_of_triangle(t);
      total += triangle_area(surface_, chart_.triangles[t]);
    }
    std::iota(order.begin(), order.end(), Index(0));
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return heights[a] != heights[b] ? heights[a] > heights[b] : a < b; });

    Union_find parts(n);
    std::vector<Part> data(n);
    std::vector<std::uint8_t> is_above(n, 0);
    std::vector<Index> tips;
    for (const Index t : order) {
      is_above[t] = 1;
      data[t] = {triangle_area(surface_, chart_.triangles[t]), 0, t, false};
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        const Index o = chart_.opposite[h];
        const double length = edge_length(surface_, chart_.global(h));
        const bool is_inner = o != no_index && is_above[o / 3];
        data[parts.find(t)].perimeter += is_inner ? -length : length;
        if (is_inner)
          join(parts, data, heights, t, o / 3);
      }
      Part& part = data[parts.find(t)];
      if (!part.is_sock && part.area > least_share_of_sock * total &&
          part.area > sock_ratio * part.perimeter * part.perimeter) {
        part.is_sock = true;
        tips.push_back(part.tip);
      }
    }
    return tips;
  }

  static void join(Union_find& parts, std::vector<Part>& data, const std::vector<double>& heights, Index s,
                   Index t)
  {
    const Index a = parts.find(s), b = parts.find(t);
    if (!parts.unite(a, b))
      return;
    const Part &p = data[a], &q = data[b];
    data[parts.find(a)] = {p.area + q.area, p.perimeter + q.perimeter,
                           heights[p.tip] >= heights[q.tip] ? p.tip : q.tip, p.is_sock || q.is_sock};
  }

  Index highest_corner(Index t) const
  {
    Index best = chart_.vertex[3 * t];
    for (Index h = 3 * t + 1; h < 3 * t + 3; ++h)
      if (height(chart_.vertex[h]) > height(best))
        best = chart_.vertex[h];
    return best;
  }

  /// To the border or to another cut; nothing if the way is barred.
  std::vector<Index> path_down_from(Index v)
  {
    std::vector<Index> path, places;
    while (!is_reached_[v]) {
      const Index down = steepest_descent(v);
      if (down == no_index)
        return {};
      path.push_back(chart_.global(down));
      places.push_back(v);
      v = chart_.head(down);
    }
    for (const Index p : places)
      is_reached_[p] = 1;
    return path;
  }

  Index steepest_descent(Index v) const
  {
    Index best = no_index;
    double steepest = 0;
    for (Index k = chart_.first[v]; k < chart_.first[v + 1]; ++k) {
      const Index h = chart_.outgoing[k];
      const double fall = height(v) - height(chart_.head(h));
      if (!(fall > 0) || must_not_be_seam(surface_, chart_.global(h)))
        continue;
      const double slope = fall / edge_length(surface_, chart_.global(h));
      if (best == no_index || slope > steepest) {
        steepest = slope;
        best = h;
      }
    }
    return best;
  }

  const Surface& surface_;
  const Submesh& chart_;
  Fast_marching distances_;
  std::vector<std::uint8_t> is_reached_; ///< per vertex: on the border or on a cut
};

/// Cuts charts open: `find` gives the halfedges for the finder of a chart and the chart. Parallel over
/// charts.
template <typename Find>
void cut_charts_open(const Surface& surface, Segmentation& segmentation, const Execution& execution,
                     Find find)
{
  std::vector<std::vector<Index>> lists = triangles_of_charts(segmentation);
  std::vector<std::vector<Index>> cuts(lists.size());
  std::vector<Index> local(surface.number_of_triangles());
  execution.for_each(lists.size(), [&](std::size_t c) {
    const Submesh chart = make_submesh(
        surface, std::move(lists[c]), [&](Index h) { return segmentation.is_glued(surface, h); }, local);
    Sock_finder finder(surface, chart);
    cuts[c] = find(finder, chart);
  });
  for (const std::vector<Index>& some : cuts)
    for (const Index h : some)
      set_cut(surface, segmentation, h, true);
}

/// Cuts the socks of all charts. O(n log n).
inline void cut_socks(const Surface& surface, double sock_ratio, Segmentation& segmentation,
                      const Execution& execution)
{
  cut_charts_open(surface, segmentation, execution,
                  [&](Sock_finder& finder, const Submesh&) { return finder.cuts(sock_ratio); });
}

/// Cuts the charts that are socks as a whole, from their seeds: the triangles with the largest distance to
/// features. The cut falls with the distance to the chart's border, so that it arrives there also where a
/// feature ends inside the chart. O(n log n).
inline void cut_socks_from_seeds(const Surface& surface, double sock_ratio,
                                 const std::vector<double>& distance, Segmentation& segmentation,
                                 const Execution& execution)
{
  cut_charts_open(surface, segmentation, execution, [&](Sock_finder& finder, const Submesh& chart) {
    Index seed = 0;
    for (Index t = 1; t < chart.triangles.size(); ++t)
      if (distance[chart.triangles[t]] > distance[chart.triangles[seed]])
        seed = t;
    return finder.cut_of_whole_chart(sock_ratio, seed);
  });
}

} // namespace Atlas::internal

#endif
