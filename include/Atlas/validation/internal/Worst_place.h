// SPDX-License-Identifier: MIT
#ifndef ATLAS_VALIDATION_INTERNAL_WORST_PLACE_H
#define ATLAS_VALIDATION_INTERNAL_WORST_PLACE_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/validation/internal/Chart_ways.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The inner vertex of a flattened chart around which distortion is largest, and cuts through it.
///
/// Distortion gathers where the surface is curved as no plane is, such as at the tip of a cone, far from the
/// border. A cut that ends there opens the cone; one that goes through it halves the angle that is missing.
class Worst_place
{
public:
  /// What a cut costs at a halfedge of the chart, not negative; infinite where there must be none.
  using Cost = std::function<double(Index)>;

  Worst_place(const Chart& chart, Cost cost)
      : chart_(chart), cost_(std::move(cost)), graph_(chart), position_(chart.number_of_vertices(), 0)
  {
    measure_border();
    find_worst();
  }

  /// The cheapest path of halfedges between the worst vertex and the border, that at the border first; none
  /// if there is no inner vertex.
  std::vector<Index> slit() const
  {
    if (worst_ == no_index)
      return {};
    const Chart_ways::Ways paths = graph_.from({worst_}, cost_);
    return graph_.way_to(paths, nearest(paths));
  }

  /// The part of each triangle, 0 or 1: the cut goes from the worst vertex to the border on either side. Of
  /// all ends the one is taken that gives the shortest cut for the length of border it cuts off. All are 0
  /// if there is no such cut.
  std::vector<Index> parts() const
  {
    std::vector<Index> cut = slit();
    if (cut.empty())
      return std::vector<Index>(chart_.number_of_triangles(), 0);
    const Index start = graph_.head(cut.front());
    std::vector<std::uint8_t> is_closed(chart_.number_of_vertices(), 0);
    for (const Index h : cut)
      is_closed[graph_.head(h)] = 1;
    const Chart_ways::Ways paths = graph_.from({worst_}, cost_, is_closed);
    const std::vector<Index> other = graph_.way_to(paths, opposite_end(paths, start, graph_.length(cut)));
    cut.insert(cut.end(), other.begin(), other.end());
    return sides(cut);
  }

private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  /// How often distortion is averaged over neighbours before the worst vertex is looked for: a place is more
  /// than a triangle.
  static constexpr int averaging_rounds = 2;

  /// Where border vertices are along the border.
  void measure_border()
  {
    for (const std::vector<Index>& loop : border_loops(graph_.opposite())) {
      double length = 0;
      for (const Index h : loop) {
        position_[graph_.tail(h)] = length;
        length += graph_.length(h);
      }
      perimeter_ = std::max(perimeter_, length);
    }
  }

  void find_worst()
  {
    std::vector<double> weight(chart_.number_of_vertices(), 0), excess(weight);
    const std::vector<Triangle_distortion> measured = triangle_distortions(chart_);
    const Distortion all = summarize_distortion(measured);
    const double g2 = all.area_uv / all.area_3d;
    for (Index t = 0; t < measured.size(); ++t)
      if (const Triangle_distortion& m = measured[t]; m.is_measurable())
        for (const Index v : chart_.triangles[t]) {
          const double a = g2 * m.largest * m.largest, b = g2 * m.smallest * m.smallest;
          weight[v] += m.area_3d;
          excess[v] += m.area_3d * ((a + b + 1 / a + 1 / b) / 4 - 1);
        }
    for (int round = 0; round < averaging_rounds; ++round) {
      std::vector<double> weights = weight, excesses = excess;
      for (Index v = 0; v < weight.size(); ++v)
        graph_.for_each_neighbour(v, [&](Index w, Index) {
          weights[v] += weight[w];
          excesses[v] += excess[w];
        });
      weight.swap(weights);
      excess.swap(excesses);
    }
    double most = 0;
    for (Index v = 0; v < weight.size(); ++v)
      if (!graph_.is_border(v) && weight[v] > 0 && excess[v] / weight[v] > most) {
        most = excess[v] / weight[v];
        worst_ = v;
      }
  }

  Index nearest(const Chart_ways::Ways& paths) const
  {
    Index best = no_index;
    for (Index v = 0; v < position_.size(); ++v)
      if (graph_.is_border(v) && std::isfinite(paths.cost[v]) &&
          (best == no_index || paths.cost[v] < paths.cost[best]))
        best = v;
    return best;
  }

  /// \param length  of the cut so far, that ends on the border at `start`
  Index opposite_end(const Chart_ways::Ways& paths, Index start, double length) const
  {
    Index best = no_index;
    double least = infinite;
    for (Index v = 0; v < position_.size(); ++v) {
      if (!graph_.is_border(v) || v == start || !std::isfinite(paths.cost[v]))
        continue;
      const double way = std::abs(position_[v] - position_[start]);
      const double cut_off = std::min(way, perimeter_ - way);
      if (const double ratio = (length + paths.cost[v]) / cut_off; ratio < least) {
        least = ratio;
        best = v;
      }
    }
    return best;
  }

  std::vector<Index> sides(const std::vector<Index>& cut) const
  {
    const std::vector<Index>& opposite = graph_.opposite();
    std::vector<std::uint8_t> is_cut(opposite.size(), 0);
    for (const Index h : cut)
      is_cut[h] = is_cut[opposite[h]] = 1;
    return connected_components(
               opposite, [](Index) { return true; }, [&](Index h) { return !is_cut[h]; })
        .of_triangle;
  }

  const Chart& chart_;
  Cost cost_;
  Chart_ways graph_;
  std::vector<double> position_; ///< per vertex, on the border
  double perimeter_ = 0;
  Index worst_ = no_index;
};

} // namespace Atlas::internal

#endif
