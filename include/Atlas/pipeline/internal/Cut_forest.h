// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_CUT_FOREST_H
#define ATLAS_PIPELINE_INTERNAL_CUT_FOREST_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/extract_charts.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/core/internal/extract_triangles.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/packing/internal/cutting/Chart_cut_finder.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// When a cut is worth its seam.
struct Cut_trade
{
  double rate = 0; ///< by which the density has to rise per added seam, both relative; 0: no cut is made
  /// Up to this added seam of all cuts, relative. Beyond, the density has to rise by twice that rate.
  double most_added_seam = std::numeric_limits<double>::infinity();
  /// Whether charts are cut that are larger than a page at the density asked for.
  bool is_for_density = false;
  double full_coverage = 1;  ///< from which on pages are full enough
  double empty_coverage = 0; ///< below which pages are rather empty
  /// Cuts that end that may add so much to the seams within the surface, relative, if they pay.
  double most_added_when_empty = 0;
};

/// \brief Flattened charts that are cut one after the other, so that they need less room on a page.
///
/// Each cut is the one of all charts and pieces that saves most room for its seam. Cuts can be taken back
/// while their pieces are whole. Pieces keep the shapes that the chart had: what was one-to-one stays so, and
/// no triangle is distorted more. A piece is scaled to its area in space.
class Cut_forest
{
public:
  /// \param segmentation  which the charts belong to
  /// \param trade         which cuts are of use; nothing: all
  /// \param seam          the length of all borders between charts
  /// \param bound         pieces of charts that keep it do so too
  Cut_forest(const Surface& surface, const Segmentation& segmentation,
             const std::vector<Flattened_chart>& charts, const Room_estimate& room,
             const Execution& execution, std::optional<Cut_trade> trade, double seam,
             const Distortion_bound& bound)
      : surface_(surface), segmentation_(segmentation), charts_(charts), room_(room), execution_(execution),
        trade_(trade), seam_(seam), bound_(bound), costs_(surface, sharp_angle, sharp_discount)
  {
    for (Index i = 0; i < charts.size(); ++i)
      add(charts[i].chart, i, no_index);
    room_before_ = this->room();
    execution_.for_each(nodes_.size(), [&](std::size_t i) { look_for_cut(nodes_[i]); });
  }

  /// Makes the cut that saves most for its seam, of those that are worth it; false if there is none.
  bool cut()
  {
    const double budget = trade_ ? trade_->most_added_seam * seam_ - added_length() : 0;
    Index best = no_index;
    for (Index i = 0; i < nodes_.size(); ++i)
      if (const Node& node = nodes_[i]; node.is_leaf && node.cut.number_of_parts > 0)
        if (node.cut.rate > least_rate(node.cut.length <= budget) &&
            (best == no_index || node.cut.rate > nodes_[best].cut.rate))
          best = i;
    return cut_node(best);
  }

  /// Cuts the longest chart or piece, if it has more than `least` sides of the page; false if none can be.
  bool cut_longest(double least)
  {
    Index best = no_index;
    for (Index i = 0; i < nodes_.size(); ++i)
      if (const Node& node = nodes_[i]; node.is_leaf && node.cut.number_of_parts > 0 && node.sides > least)
        if (best == no_index || node.sides > nodes_[best].sides)
          best = i;
    return cut_node(best);
  }

  /// All cuts, in the order in which they were made.
  const std::vector<Index>& cuts() const { return cuts_; }

  /// The cuts that can be taken back, those that save least for their seam first.
  std::vector<Index> last_cuts() const
  {
    std::vector<Index> result;
    for (Index i = 0; i < nodes_.size(); ++i) {
      const auto is_leaf = [&](Index child) { return nodes_[child].is_leaf; };
      const std::vector<Index>& children = nodes_[i].children;
      if (is_present(i) && !nodes_[i].is_leaf && std::all_of(children.begin(), children.end(), is_leaf))
        result.push_back(i);
    }
    std::stable_sort(result.begin(), result.end(),
                     [&](Index a, Index b) { return nodes_[a].cut.rate < nodes_[b].cut.rate; });
    return result;
  }

  /// Takes a cut back, or makes it again.
  void set_cut(Index node, bool is_cut)
  {
    nodes_[node].is_leaf = !is_cut;
    for (const Index child : nodes_[node].children)
      nodes_[child].is_leaf = is_cut;
  }

  /// The charts and pieces as they are now, by numbers that do not change.
  std::vector<Index> pieces() const
  {
    std::vector<Index> result;
    for (Index i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].is_leaf)
        result.push_back(i);
    return result;
  }

  /// An estimate of the room that all charts need.
  double room() const
  {
    double sum = 0;
    for (const Node& node : nodes_)
      sum += node.is_leaf ? node.room : 0;
    return sum;
  }

  /// The length of new seams.
  double added_length() const
  {
    double sum = 0;
    for (Index i = 0; i < nodes_.size(); ++i)
      sum += is_present(i) && !nodes_[i].is_leaf ? nodes_[i].cut.length : 0;
    return sum;
  }

  /// The charts and pieces as they are now. The first piece of a chart keeps its number.
  std::vector<Flattened_chart> write(Segmentation& segmentation) const
  {
    segmentation = segmentation_;
    std::vector<Flattened_chart> result = charts_;
    std::vector<bool> is_named(charts_.size(), false);
    std::vector<std::pair<Index, Index>> pieces; // node, number
    for (Index i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      if (!node.is_leaf || node.parent == no_index)
        continue;
      const Index number = is_named[node.root] ? segmentation.number_of_charts++ : node.root;
      is_named[node.root] = true;
      pieces.emplace_back(i, number);
      for (const Index t : node.chart.source)
        segmentation.chart[t] = number;
    }
    result.resize(segmentation.number_of_charts);
    std::vector<Index> local(surface_.number_of_triangles());
    for (const auto& piece : pieces)
      result[piece.second] = piece_of(charts_[nodes_[piece.first].root], nodes_[piece.first].chart, local);
    return result;
  }

private:
  static constexpr double sharp_angle = std::numbers::pi / 4, sharp_discount = 0.3;

  struct Node
  {
    Chart chart;
    Index root;   ///< the chart it is a piece of
    Index parent; ///< the node it is a piece of
    double room = 0;
    double sides = 0; ///< its length, in sides of the page
    Chart_cut cut = {};
    std::vector<Index> children = {};
    bool is_leaf = true; ///< whether it is a chart now
  };

  /// What a cut has to save for its cost. Density goes with the root of the room.
  double least_rate(bool is_within_budget) const
  {
    return trade_ ? (is_within_budget ? 2 : 4) * trade_->rate * room_before_ / seam_ : 0;
  }

  /// What a cut may cost to be worth it: it saves no more than what of the room is not covered.
  double most_cost(const Node& node) const
  {
    if (!trade_)
      return std::numeric_limits<double>::infinity();
    const double left_over = node.room - std::abs(area_uv(node.chart));
    return std::max(trade_->most_added_seam * seam_, left_over / least_rate(false));
  }

  /// Whether the node is a chart now, or some of its pieces are.
  bool is_present(Index i) const
  {
    if (nodes_[i].is_leaf)
      return true;
    return std::any_of(nodes_[i].children.begin(), nodes_[i].children.end(),
                       [&](Index child) { return is_present(child); });
  }

  static std::vector<Vec2> border_of(const Chart& chart)
  {
    std::vector<Vec2> points;
    const std::vector<Index> opposite = opposite_halfedges(chart.triangles);
    for (Index h = 0; h < opposite.size(); ++h)
      if (opposite[h] == no_index)
        for (const Index i : {h % 3, (h + 1) % 3}) {
          const Point_2& p = chart.uv[chart.triangles[h / 3][i]];
          points.push_back({p.x(), p.y()});
        }
    return points;
  }

  Index add(Chart chart, Index root, Index parent)
  {
    const std::vector<Vec2> border = border_of(chart);
    const double room = room_(border), sides = room_.sides(border);
    nodes_.push_back({std::move(chart), root, parent, room, sides});
    return static_cast<Index>(nodes_.size() - 1);
  }

  void look_for_cut(Node& node) const
  {
    const Chart& chart = node.chart;
    if (chart.number_of_triangles() < 2)
      return;
    std::vector<double> cost(3 * chart.number_of_triangles());
    for (Index h = 0; h < cost.size(); ++h) {
      const Index g = 3 * chart.source[h / 3] + h % 3;
      const bool is_possible = surface_.opposite[g] != no_index && !must_not_be_seam(surface_, g);
      cost[h] = is_possible ? costs_(g).cost : std::numeric_limits<double>::infinity();
    }
    node.cut = Chart_cut_finder(chart, cost, room_, most_cost(node)).best(execution_);
    keep_faces_whole(chart, node.cut);
    if (!keep_bound(chart, node.cut))
      node.cut.number_of_parts = 0;
  }

  /// Whether all pieces keep the bound, if the chart does: one may have more than its share of what is
  /// stretched.
  bool keep_bound(const Chart& chart, const Chart_cut& cut) const
  {
    if (cut.number_of_parts == 0)
      return true;
    const std::vector<Triangle_distortion> measured = triangle_distortions(chart);
    if (used_share(measured, bound_) > 1)
      return true;
    std::vector<std::vector<Triangle_distortion>> of_parts(cut.number_of_parts);
    for (std::size_t t = 0; t < measured.size(); ++t)
      of_parts[cut.parts[t]].push_back(measured[t]);
    return std::all_of(of_parts.begin(), of_parts.end(),
                       [&](const auto& part) { return used_share(part, bound_) <= 1; });
  }

  /// Parts that share a face become one. Triangles of a face need not hang together in a chart: flat ones of
  /// a face with repeated vertices do not. If one part is left, there is no cut.
  void keep_faces_whole(const Chart& chart, Chart_cut& cut) const
  {
    Union_find sets(cut.number_of_parts);
    for (std::size_t t = 1; t < cut.parts.size(); ++t) // those of a face follow on each other
      if (surface_.face[chart.source[t]] == surface_.face[chart.source[t - 1]])
        sets.unite(cut.parts[t], cut.parts[t - 1]);
    std::vector<Index> number;
    const Index count = sets.number_sets(number);
    if (count == cut.number_of_parts)
      return;
    for (Index& part : cut.parts)
      part = number[part];
    cut.number_of_parts = count > 1 ? count : 0;
  }

  /// Makes the cut of a node; false if there is none.
  bool cut_node(Index i)
  {
    if (i == no_index || execution_.is_cancelled())
      return false;
    cuts_.push_back(i);
    std::vector<std::vector<Index>> lists(nodes_[i].cut.number_of_parts);
    for (Index t = 0; t < nodes_[i].cut.parts.size(); ++t)
      lists[nodes_[i].cut.parts[t]].push_back(t);
    const std::size_t first = nodes_.size();
    for (const std::vector<Index>& list : lists) {
      const Index child = add(part_of(nodes_[i].chart, nodes_[i].cut.parts, list), nodes_[i].root, i);
      nodes_[i].children.push_back(child);
    }
    nodes_[i].is_leaf = false;
    execution_.for_each(nodes_.size() - first, [&](std::size_t k) { look_for_cut(nodes_[first + k]); });
    return true;
  }

  /// Some triangles of a chart, with their coordinates at the scale at which they keep their area in space.
  static Chart part_of(const Chart& chart, const std::vector<Index>& parts,
                       const std::vector<Index>& triangles)
  {
    const std::vector<Index> opposite = opposite_halfedges(chart.triangles);
    std::vector<Index> local(chart.number_of_triangles());
    Chart part = extract_triangles(
        opposite, triangles, local,
        [&](Index h) { return opposite[h] != no_index && parts[opposite[h] / 3] == parts[h / 3]; },
        [&](Index h) -> const Point_3& { return chart.points[chart.triangles[h / 3][h % 3]]; });
    part.uv.resize(part.points.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (int i = 0; i < 3; ++i)
        part.uv[part.triangles[t][i]] = chart.uv[chart.triangles[triangles[t]][i]];
    for (Index& t : part.source)
      t = chart.source[t];
    give_area(part);
    return part;
  }

  static void give_area(Chart& chart)
  {
    const double scale = std::sqrt(area_3d(chart) / std::abs(area_uv(chart)));
    if (std::isfinite(scale) && scale > 0.5 && scale < 2)
      for (Point_2& p : chart.uv)
        p = Point_2(scale * p.x(), scale * p.y());
  }

  /// A piece of a chart, as the chart was made. Coordinates go by the corners of triangles.
  Flattened_chart piece_of(const Flattened_chart& whole, const Chart& piece, std::vector<Index>& local) const
  {
    Flattened_chart result{piece, whole.verdict, whole.record, {}};
    result.verdict.culprits.clear();
    if (whole.uv_before.empty())
      return result;
    for (Index t = 0; t < whole.chart.source.size(); ++t)
      local[whole.chart.source[t]] = t;
    result.uv_before.resize(piece.number_of_vertices());
    for (std::size_t t = 0; t < piece.source.size(); ++t)
      for (int i = 0; i < 3; ++i)
        result.uv_before[piece.triangles[t][i]] =
            whole.uv_before[whole.chart.triangles[local[piece.source[t]]][i]];
    return result;
  }

  const Surface& surface_;
  Segmentation segmentation_;
  std::vector<Flattened_chart> charts_;
  Room_estimate room_;
  const Execution& execution_;
  std::optional<Cut_trade> trade_;
  double seam_, room_before_ = 0;
  Distortion_bound bound_;
  Seam_costs costs_;
  std::vector<Node> nodes_;
  std::vector<Index> cuts_;
};

} // namespace Atlas::internal

#endif
