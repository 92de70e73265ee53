// SPDX-License-Identifier: MIT
#ifndef ATLAS_PIPELINE_INTERNAL_TAIL_SLITTER_H
#define ATLAS_PIPELINE_INTERNAL_TAIL_SLITTER_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Flattened_chart.h>
#include <Atlas/core/internal/cuts.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/measure/distortion.h>
#include <Atlas/pipeline/internal/slit_chart.h>
#include <Atlas/segmentation/internal/merging/merge_trial.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>
#include <Atlas/validation/internal/Chart_ways.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// How much of a flattened chart is stretched farther than wanted, as an area: a triangle counts for a part
/// of its own, which grows from none a little below to all a little above.
class Stretched_area
{
public:
  explicit Stretched_area(double wanted) : low_(1 + 0.9 * (wanted - 1)), width_((wanted - 1) / 3) {}

  /// Per triangle of the chart, at the scale at which it has its area in space.
  std::vector<double> of_triangles(const Chart& chart) const
  {
    const std::vector<Triangle_distortion> measured = triangle_distortions(chart);
    double in_space = 0, in_plane = 0;
    for (const Triangle_distortion& t : measured)
      if (t.is_measurable()) {
        in_space += t.area_3d;
        in_plane += t.area_uv;
      }
    const double scale = std::sqrt(in_plane / in_space);
    std::vector<double> result(measured.size(), 0);
    for (std::size_t i = 0; i < measured.size(); ++i)
      if (const Triangle_distortion& t = measured[i]; t.is_measurable()) {
        const double stretch = std::max(scale * t.largest, 1 / (scale * t.smallest));
        result[i] = t.area_3d * std::clamp((stretch - low_) / width_, 0., 1.);
      }
    return result;
  }

  double operator()(const Chart& chart) const
  {
    const std::vector<double> parts = of_triangles(chart);
    return std::accumulate(parts.begin(), parts.end(), 0.);
  }

private:
  double low_, width_;
};

/// \brief Opens charts by short slits until little of the whole surface is stretched farther than wanted.
///
/// Charts that keep their bound may still have places that are stretched much. A slit from the border into
/// such a place costs little seam. Of all charts the slit goes first that helps most for its length; it ends
/// when the surface is good enough, or no slit is worth its length. Slits are found on coarse copies and
/// proved on the charts themselves.
class Tail_slitter
{
public:
  /// Flattens and validates a chart that has coordinates from before it was slit, made as recorded.
  using Flatten = std::function<Flattened_chart(Chart, const Flattening_record&)>;
  /// Only lays a chart flat; one that has coordinates is near its best. Called from several threads.
  using Lay_flat = std::function<Chart_status(Chart&)>;

  /// \param wanted  stretch that at most the part 1 - `share` of the surface may exceed
  Tail_slitter(const Surface& surface, Segmentation& segmentation, double wanted, double share,
               Flatten flatten, Lay_flat lay_flat, const Execution& execution)
      : surface_(surface), segmentation_(segmentation), stretched_(wanted), share_(share),
        flatten_(std::move(flatten)), lay_flat_(std::move(lay_flat)), execution_(execution),
        area_(area_3d(surface)), costs_(surface, sharp_angle, sharp_discount)
  {}

  /// Charts are those of the segmentation. Returns how many slits there are.
  std::size_t run(std::vector<Flattened_chart>& charts)
  {
    const double enough = (1 - share_) * area_;
    std::vector<Place> places(charts.size());
    double sum = 0;
    for (std::size_t i = 0; i < charts.size(); ++i)
      if (charts[i].verdict.is_valid())
        sum += places[i].stretched = stretched_(charts[i].chart);
    if (!(sum > enough))
      return 0;
    execution_.for_each(charts.size(), [&](std::size_t i) { look_for_slit(charts[i].chart, places[i]); });
    std::size_t slits = 0;
    while (sum > enough && execution_.proceed(1)) {
      const auto best = std::max_element(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return a.slit.rate < b.slit.rate;
      });
      if (best->slit.rate < least_rate)
        break;
      Flattened_chart& chart = charts[static_cast<std::size_t>(best - places.begin())];
      const double before = best->stretched;
      const bool is_open = open(chart, *best);
      slits += is_open;
      sum += best->stretched - before;
      best->opened += is_open;
      best->refused = is_open ? 0 : best->refused + 1;
      look_for_slit(chart.chart, *best);
    }
    return slits;
  }

private:
  /// By which the share of the surface that is stretched too far has to fall for the length of a slit, in
  /// roots of the surface's area.
  static constexpr double least_rate = 0.003;
  /// And at all: less is not worth a slit.
  static constexpr double least_gain = 1e-4;
  /// How much more has to be stretched around the end of a slit: hardly all of that gets better.
  static constexpr double least_promise = 2;
  /// A chart with less stretched area than that share of the surface is good enough.
  static constexpr double least_share = 5e-4;
  /// More slits than that make a comb of a chart: the more the larger it is.
  static constexpr double most_opened = 6, most_opened_of_all = 12;
  static constexpr int most_refused = 3;
  /// Slits that are tried on a coarse copy before one is made, and about how many triangles it has: the more
  /// triangles, the fewer slits.
  static constexpr std::size_t most_tries = 16, least_tries = 2, triangles_of_tries = 64'000;
  static constexpr std::array<double, 2> triangles_of_copies{2500, 30000};
  /// Two edges of a border come no nearer than this share of their length.
  static constexpr double least_gap = 0.01;
  static constexpr double sharp_angle = std::numbers::pi / 4, sharp_discount = 0.4;

  /// From a place on the border to one inside.
  struct Slit
  {
    Point_3 start{0, 0, 0}, end{0, 0, 0};
    double rate = 0; ///< rounded
  };

  /// In single precision lengths that are equal but for rounding are equal, and so are their sums.
  static double single(double length) { return static_cast<float>(length); }

  /// Whether two points are at most so far apart, but for rounding.
  static bool is_within(const Point_3& p, const Point_3& q, double distance)
  {
    constexpr double rounding = 1e-6;
    return CGAL::squared_distance(p, q) <= (1 + rounding) * distance * distance;
  }

  /// Gains come from layouts, which are not accurate to the last digits: what is about equal, as on symmetric
  /// shapes, goes by order, at any scale.
  static double rounded(double rate)
  {
    constexpr double steps = 2048;
    int exponent = 0;
    const double mantissa = std::frexp(rate, &exponent);
    return std::isfinite(rate) ? std::ldexp(std::round(steps * mantissa) / steps, exponent) : rate;
  }

  /// What is known of one chart.
  struct Place
  {
    double stretched = 0;            ///< area
    Slit slit;                       ///< the best
    int opened = 0, refused = 0;     ///< slits; in vain since the last one
    std::vector<Point_3> known;      ///< ends of slits that have been made or refused
    std::vector<double> costs;       ///< of seams, per halfedge, once they are known
    std::map<Point_3, double> rates; ///< per end of a slit that was tried: what it brought then
  };

  /// Finds the best slit of a chart.
  void look_for_slit(const Chart& chart, Place& place) const
  {
    place.slit = {};
    const double most = most_opened + most_opened_of_all * area_3d(chart) / area_;
    if (place.stretched < least_share * area_ || place.opened + 1 > most || place.refused >= most_refused)
      return;
    Chart copy;
    std::vector<double> parts;
    double before = 0;
    // The second one is for charts with fine details. What that lacks is roughness: no slit helps there.
    for (const double triangles : triangles_of_copies) {
      copy = coarse_copy(chart, triangles);
      if (lay_flat_(copy) != Chart_status::valid)
        return;
      parts = stretched_.of_triangles(copy);
      before = std::accumulate(parts.begin(), parts.end(), 0.);
      if (before >= 0.5 * place.stretched)
        break;
    }
    if (before < 0.5 * place.stretched)
      return;
    const Chart_ways graph(copy);
    std::vector<Index> border;
    for (Index v = 0; v < copy.number_of_vertices(); ++v)
      if (graph.is_border(v))
        border.push_back(v);
    const Chart_ways::Ways ways = graph.from(border, [&](Index h) { return single(graph.length(h)); });
    const std::vector<Index> ends = promising_ends(copy, graph, ways, parts, place.known);
    for (const auto& [most_rate, v] : with_most_rates(ends, copy, place)) {
      if (most_rate < place.slit.rate)
        break;
      std::vector<Index> way = graph.way_to(ways, v);
      Slit slit{copy.points[graph.tail(way.back())], copy.points[v], 0};
      if (!copy.source.empty())
        way = way_of(slit, copy, graph, costs_of(copy, place));
      if (way.empty())
        continue;
      const double gain = place.stretched * (1 - stretched_with(copy, graph, way) / before);
      if (gain >= least_gain * area_)
        slit.rate = rounded(gain / graph.length(way) / std::sqrt(area_));
      place.rates[slit.end] = slit.rate;
      if (slit.rate > place.slit.rate)
        place.slit = slit;
    }
  }

  /// What slits brought on trial before another one was made is about the most that they bring now. So the
  /// best come first, and behind those that were not tried yet.
  static std::vector<std::pair<double, Index>> with_most_rates(const std::vector<Index>& ends,
                                                               const Chart& copy, const Place& place)
  {
    std::vector<std::pair<double, Index>> result;
    for (const Index v : ends) {
      const auto known = place.rates.find(copy.points[v]);
      result.emplace_back(
          known == place.rates.end() ? std::numeric_limits<double>::infinity() : known->second, v);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    return result;
  }

  /// Inner vertices apart from each other with much stretched area for their distance from the border.
  std::vector<Index> promising_ends(const Chart& chart, const Chart_ways& graph, const Chart_ways::Ways& ways,
                                    const std::vector<double>& parts, const std::vector<Point_3>& known) const
  {
    std::vector<Index> stretched;
    for (Index t = 0; t < parts.size(); ++t)
      if (parts[t] > 0)
        stretched.push_back(t);
    std::vector<std::pair<double, Index>> order;
    for (Index v = 0; v < chart.number_of_vertices(); ++v) {
      if (graph.is_border(v) || !std::isfinite(ways.cost[v]))
        continue;
      double sum = 0;
      for (const Index t : stretched)
        for (const Index w : chart.triangles[t])
          if (is_within(chart.points[v], chart.points[w], ways.cost[v]))
            sum += parts[t] / 3;
      if (const double rate = rounded(sum / ways.cost[v] / std::sqrt(area_));
          rate >= least_promise * least_rate)
        order.emplace_back(-rate, v);
    }
    std::sort(order.begin(), order.end());
    constexpr double least_distance = 0.3; // of the longer one of two slits
    const std::size_t tries =
        std::clamp(triangles_of_tries / chart.number_of_triangles(), least_tries, most_tries);
    std::vector<Index> ends;
    for (const auto& entry : order) {
      const Index v = entry.second;
      const auto is_near = [&](Index w) {
        const double reach = least_distance * std::max(ways.cost[v], ways.cost[w]);
        return is_within(chart.points[v], chart.points[w], reach);
      };
      if (std::none_of(ends.begin(), ends.end(), is_near) &&
          std::find(known.begin(), known.end(), chart.points[v]) == known.end())
        ends.push_back(v);
      if (ends.size() == tries)
        break;
    }
    return ends;
  }

  /// The stretched area of a chart that is cut along a way; infinite where it does not unfold well.
  double stretched_with(const Chart& chart, const Chart_ways& graph, const std::vector<Index>& way) const
  {
    Chart cut = slit_chart(chart, graph, way);
    if (lay_flat_(cut) != Chart_status::valid || !is_border_clear(cut, least_gap))
      return std::numeric_limits<double>::infinity();
    return stretched_(cut);
  }

  /// Makes the slit; takes it back if it does not help as it should.
  bool open(Flattened_chart& f, Place& place)
  {
    const Slit slit = place.slit;
    place.known.push_back(slit.end);
    const Chart_ways graph(f.chart);
    const std::vector<Index> way = way_of(slit, f.chart, graph, costs_of(f.chart, place));
    for (const Index h : way)
      set_cut(surface_, segmentation_, of_surface(f.chart, h), true);
    if (!way.empty()) {
      Flattened_chart opened = flatten_(slit_chart(f.chart, graph, way), f.record);
      const double now = opened.verdict.is_valid() ? stretched_(opened.chart) : place.stretched;
      const double least = std::max(least_gain * area_, least_rate * graph.length(way) * std::sqrt(area_));
      if (place.stretched - now >= least) {
        place.stretched = now;
        f = std::move(opened);
        return true;
      }
    }
    for (const Index h : way)
      set_cut(surface_, segmentation_, of_surface(f.chart, h), false);
    return false;
  }

  static Index of_surface(const Chart& chart, Index h) { return 3 * chart.source[h / 3] + h % 3; }

  /// What a seam costs, per halfedge of a chart, which stays the same when the chart is slit.
  const std::vector<double>& costs_of(const Chart& chart, Place& place) const
  {
    for (Index h = static_cast<Index>(place.costs.size()); h < 3 * chart.number_of_triangles(); ++h) {
      const Index g = of_surface(chart, h);
      const bool is_possible = surface_.opposite[g] != no_index && !must_not_be_seam(surface_, g);
      place.costs.push_back(is_possible ? single(costs_(g).cost) : std::numeric_limits<double>::infinity());
    }
    return place.costs;
  }

  /// The cheapest way from the end of a slit to its start, or to a part of the border that is much nearer.
  std::vector<Index> way_of(const Slit& slit, const Chart& chart, const Chart_ways& graph,
                            const std::vector<double>& costs) const
  {
    constexpr double much_nearer = 0.7;
    Index end = no_index;
    for (Index v = 0; v < chart.number_of_vertices() && end == no_index; ++v)
      if (chart.points[v] == slit.end && !graph.is_border(v))
        end = v;
    if (end == no_index)
      return {};
    const Chart_ways::Ways ways = graph.from({end}, [&](Index h) { return costs[h]; });
    Index best = no_index;
    double least = std::numeric_limits<double>::infinity();
    for (Index v = 0; v < chart.number_of_vertices(); ++v)
      if (graph.is_border(v)) {
        const double cost = ways.cost[v] * (chart.points[v] == slit.start ? much_nearer : 1);
        if (cost < least) {
          least = cost;
          best = v;
        }
      }
    return graph.way_to(ways, best);
  }

  const Surface& surface_;
  Segmentation& segmentation_;
  Stretched_area stretched_;
  double share_;
  Flatten flatten_;
  Lay_flat lay_flat_;
  const Execution& execution_;
  double area_; ///< of the surface
  Seam_costs costs_;
};

} // namespace Atlas::internal

#endif
