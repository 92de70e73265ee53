// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_BORDER_SMOOTHER_H
#define ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_BORDER_SMOOTHER_H

#include <Atlas/core/Chart.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/extract_triangles.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/smoothing/minimum_cut.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief What must stay as it is while borders move, for a whole surface.
struct Smoothing_limits
{
  std::vector<std::uint8_t> is_open;  ///< per halfedge: it may be inside a chart
  std::vector<std::uint8_t> is_stuck; ///< per triangle: it stays in its chart
};

/// Scratch of the smoother, per triangle of the surface. Pairs of charts that have none in common can use one
/// at the same time.
struct Smoothing_scratch
{
  explicit Smoothing_scratch(std::size_t triangles)
      : node(triangles, 0), stamp(triangles, 0), local(triangles)
  {}
  std::vector<Index> node, stamp, local;
};

/// \brief Moves the border between two charts to the cheapest place in a band around it.
///
/// A band of triangles on both sides of the border may change sides. Each of them is a node of a graph, and
/// each edge between two of them a link, as strong as a seam there is expensive; two more nodes stand for the
/// two charts beside the band. The minimum cut between these two is the cheapest border.
///
/// The border is only taken if both charts stay discs. Their Euler characteristics are told by what changes
/// around the triangles that changed sides; only that each chart hangs together needs a look at all of its
/// triangles. O(n log n) for a band of n triangles, and linear in both charts.
class Border_smoother
{
public:
  /// \param chart  per triangle
  /// \param pair   the two charts, which are discs
  /// \param stamp  two numbers that nobody else has used with this scratch, this and the next one
  Border_smoother(const Surface& surface, const Seam_costs& costs, const Smoothing_limits& limits,
                  const std::vector<Index>& chart, std::array<Index, 2> pair,
                  std::array<std::size_t, 2> sizes, Smoothing_scratch& scratch, Index stamp)
      : surface_(surface), costs_(costs), limits_(limits), chart_(chart), pair_(pair), sizes_(sizes),
        scratch_(scratch), stamp_(stamp)
  {}

  /// Whether there is a cheaper border than the present one at most `rings` rings of triangles away with
  /// which both charts are discs. `border` has the halfedges between the charts, on either side.
  bool run(std::span<const Index> border, int rings)
  {
    find_band(border, rings);
    return !band_.empty() && find_cheapest_border() && keeps_euler() && is_connected(0) && is_connected(1);
  }

  /// After run(): the triangles that change sides.
  const std::vector<Index>& changed() const { return changed_; }

  /// After run(): one of the charts.
  Chart chart(int side)
  {
    std::vector<Index> triangles = reached_[side];
    std::sort(triangles.begin(), triangles.end());
    return extract_triangles(
        surface_.opposite, triangles, scratch_.local, [&](Index h) { return is_glued(h); },
        [&](Index h) -> const Point_3& { return surface_.point(h); });
  }

private:
  Index node_of(Index t) const
  {
    const Index n = scratch_.node[t];
    return n < band_.size() && band_[n] == t ? n : no_index;
  }
  std::uint8_t old_side(Index t) const { return chart_[t] == pair_[1]; }
  std::uint8_t side(Index t) const
  {
    const Index n = node_of(t);
    return n != no_index ? side_[n] : old_side(t);
  }

  /// Whether both sides of the edge are in these two charts and may be glued.
  bool is_link(Index h) const
  {
    if (!limits_.is_open[h])
      return false;
    const Index c = chart_[surface_.opposite[h] / 3];
    return c == pair_[0] || c == pair_[1];
  }
  bool is_glued(Index h) const { return is_link(h) && side(h / 3) == side(surface_.opposite[h] / 3); }

  /// Triangles that may change sides.
  void find_band(std::span<const Index> border, int rings)
  {
    std::vector<Index> front, beyond;
    const auto reach = [&](Index t, std::vector<Index>& list) {
      if (scratch_.stamp[t] == stamp_)
        return;
      scratch_.stamp[t] = stamp_;
      list.push_back(t);
    };
    const auto is_of_pair = [&](Index t) { return chart_[t] == pair_[0] || chart_[t] == pair_[1]; };
    for (const Index h : border)
      if (is_of_pair(h / 3) && is_link(h) && old_side(h / 3) != old_side(surface_.opposite[h] / 3)) {
        reach(h / 3, front);
        reach(surface_.opposite[h] / 3, front);
      }
    for (int step = 0; step < 2 * rings; ++step) {
      beyond.clear();
      for (const Index t : front) {
        if (!limits_.is_stuck[t]) {
          scratch_.node[t] = static_cast<Index>(band_.size());
          band_.push_back(t);
        }
        for (Index h = 3 * t; h < 3 * t + 3; ++h)
          if (is_link(h))
            reach(surface_.opposite[h] / 3, beyond);
      }
      front.swap(beyond);
    }
    for (const Index t : band_)
      side_.push_back(old_side(t));
  }

  /// Whole numbers, relative to the largest cost in the band; an edge that cannot be a seam costs more than
  /// all others together.
  static std::int64_t capacity(const Seam_costs::Cost& cost, double largest)
  {
    constexpr double steps = 1e6;                         // of the largest cost
    constexpr std::int64_t never = std::int64_t(1) << 42; // sums of two million of them fit into 63 bits
    if (cost.is_impossible)
      return never;
    const double share = largest > 0 ? cost.cost / largest : 0;
    return 1 + static_cast<std::int64_t>(std::min(steps * share * cost.penalty, double(never / 2)));
  }

  /// A link of the graph: between two nodes of the band, or one and the node of a chart beside it.
  struct Link
  {
    Index node, other;
    Seam_costs::Cost cost;
    bool is_border; ///< of the present border
  };

  /// All links, and the largest cost of those that may become seams.
  std::vector<Link> links_of_band(double& largest) const
  {
    std::vector<Link> links;
    largest = 0;
    for (Index n = 0; n < band_.size(); ++n)
      for (Index h = 3 * band_[n]; h < 3 * band_[n] + 3; ++h) {
        if (!is_link(h))
          continue;
        const Index o = surface_.opposite[h], m = node_of(o / 3);
        if (m != no_index && m < n)
          continue;
        const Seam_costs::Cost cost = costs_(h);
        if (!cost.is_impossible && std::isfinite(cost.cost))
          largest = std::max(largest, cost.cost);
        links.push_back({n, m != no_index ? m : static_cast<Index>(band_.size()) + old_side(o / 3), cost,
                         side_[n] != old_side(o / 3)});
      }
    return links;
  }

  bool find_cheapest_border()
  {
    constexpr std::int64_t least_gain = 1000; // the thousandth of the cost: less is not worth a change
    double largest;
    const std::vector<Link> links = links_of_band(largest);
    Minimum_cut cut(band_.size());
    std::int64_t before = 0;
    for (const Link& link : links) {
      const std::int64_t c = capacity(link.cost, largest);
      cut.connect(link.node, link.other, c);
      before += link.is_border ? c : 0;
    }
    if (cut.run() >= before - before / least_gain)
      return false;
    for (Index n = 0; n < band_.size(); ++n)
      if (const std::uint8_t now = !cut.is_on_first_side(n); now != side_[n]) {
        side_[n] = now;
        changed_.push_back(band_[n]);
      }
    return !changed_.empty();
  }

  // --- Topology

  /// The corners around one, counterclockwise, as far as the two charts reach, and whether they go all
  /// around.
  bool corners_around(Index h, std::vector<Index>& corners) const
  {
    const auto is_inside = [&](Index g) { return is_link(g); };
    corners.clear();
    return for_each_in_fan(surface_.opposite, first_in_fan(surface_.opposite, h, is_inside), is_inside,
                           [&](Index g) { corners.push_back(g); });
  }

  /// Vertices - edges + triangles of both charts change by nothing, and no two edges get the same ends.
  bool keeps_euler() const
  {
    std::array<long long, 2> euler{0, 0};
    std::vector<Index> around, starts;
    for (const Index t : changed_) {
      const std::uint8_t now = side(t);
      ++euler[now];
      --euler[!now];
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        count_edge(h, euler);
        const bool is_closed = corners_around(h, around);
        starts.push_back(is_closed ? *std::min_element(around.begin(), around.end()) : around.front());
      }
    }
    std::sort(starts.begin(), starts.end());
    starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
    for (const Index start : starts) {
      const bool is_closed = corners_around(start, around);
      count_fans(around, is_closed, euler);
      if (!is_unambiguous(around, is_closed))
        return false;
    }
    return euler[0] == 0 && euler[1] == 0;
  }

  /// An edge between both charts is one of either.
  void count_edge(Index h, std::array<long long, 2>& euler) const
  {
    const std::uint8_t now = side(h / 3);
    if (!is_link(h)) {
      --euler[now];
      ++euler[!now];
      return;
    }
    const Index n = surface_.opposite[h] / 3;
    if (side(n) != old_side(n) && n < h / 3)
      return;
    const auto count = [&](std::uint8_t s, std::uint8_t r, int sign) {
      euler[s] -= sign;
      if (s != r)
        euler[r] -= sign;
    };
    count(!now, old_side(n), -1);
    count(now, side(n), 1);
  }

  /// A vertex of a chart is a run of corners of one side.
  void count_fans(const std::vector<Index>& around, bool is_closed, std::array<long long, 2>& euler) const
  {
    const auto count = [&](auto side_at, int sign) {
      bool has_start = false;
      for (std::size_t i = 0; i < around.size(); ++i) {
        const std::uint8_t s = side_at(around[i] / 3);
        const bool is_start =
            i > 0 ? s != side_at(around[i - 1] / 3) : !is_closed || s != side_at(around.back() / 3);
        euler[s] += is_start ? sign : 0;
        has_start = has_start || is_start;
      }
      if (!has_start)
        euler[side_at(around.front() / 3)] += sign;
    };
    count([&](Index t) { return old_side(t); }, -1);
    count([&](Index t) { return side(t); }, 1);
  }

  /// Whether the edges of each vertex of a chart here lead to different vertices, and none back to it.
  bool is_unambiguous(const std::vector<Index>& around, bool is_closed) const
  {
    const std::size_t n = around.size();
    std::vector<Index> ends; // corners at the other ends of the edges of one vertex, and the vertex itself
    const auto goes_on = [&](std::size_t i) {
      return (i + 1 < n || is_closed) && side(around[i] / 3) == side(around[(i + 1) % n] / 3);
    };
    std::size_t start = 0; // with a vertex, if there is more than one
    while (start + 1 < n && is_closed && goes_on((start + n - 1) % n))
      ++start;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (start + k) % n;
      if (ends.empty())
        ends.push_back(around[i]);
      ends.push_back(next_halfedge(around[i]));
      if (goes_on(i) && k + 1 < n)
        continue;
      if (!goes_on(i))
        ends.push_back(previous_halfedge(around[i]));
      if (!are_different(ends))
        return false;
      ends.clear();
    }
    return true;
  }

  bool are_different(const std::vector<Index>& corners) const
  {
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (surface_.point(corners[i]) == surface_.point(corners[j]) && fan(corners[i]) == fan(corners[j]))
          return false;
    return true;
  }

  /// A name of the vertex of a chart that the corner belongs to.
  Index fan(Index h) const
  {
    Index least = h;
    for_each_in_fan(
        surface_.opposite, h, [&](Index g) { return is_glued(g); },
        [&](Index g) { least = std::min(least, g); });
    return least;
  }

  /// Whether one of the charts hangs together; remembers its triangles.
  bool is_connected(std::uint8_t wanted)
  {
    std::size_t size = sizes_[wanted];
    for (const Index t : changed_)
      size += side(t) == wanted ? 1 : std::size_t(-1);
    std::vector<Index>& reached = reached_[wanted];
    reached.clear();
    reached.reserve(size);
    const Index stamp = stamp_ + 1; // of both charts: they have no triangle in common
    const auto enter = [&](Index t) {
      const bool is_new = scratch_.stamp[t] != stamp;
      if (is_new) {
        scratch_.stamp[t] = stamp;
        reached.push_back(t);
      }
      return is_new;
    };
    if (const Index start = start_of(wanted); start != no_index)
      flood_fill(
          surface_.opposite, start, [&](Index h) { return is_glued(h); }, enter);
    return size > 0 && reached.size() == size;
  }

  /// A triangle of the chart beside the border, if it has any.
  Index start_of(std::uint8_t wanted) const
  {
    for (const Index t : band_)
      if (side(t) == wanted)
        return t;
    for (const Index t : band_)
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (is_link(h) && side(surface_.opposite[h] / 3) == wanted)
          return surface_.opposite[h] / 3;
    return no_index;
  }

  const Surface& surface_;
  const Seam_costs& costs_;
  const Smoothing_limits& limits_;
  const std::vector<Index>& chart_;
  std::array<Index, 2> pair_;
  std::array<std::size_t, 2> sizes_;
  Smoothing_scratch& scratch_;
  Index stamp_;
  std::vector<Index> band_;        ///< triangles that may change sides
  std::vector<std::uint8_t> side_; ///< per entry of band_: which chart
  std::vector<Index> changed_;
  std::array<std::vector<Index>, 2> reached_; ///< the triangles of both charts
};

} // namespace Atlas::internal

#endif
