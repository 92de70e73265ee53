// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_REGION_GROWING_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_REGION_GROWING_SEGMENTATION_IMPL_H

#include <Atlas/segmentation/Region_growing_segmentation.h>
#include <Atlas/segmentation/internal/arguments.h>
#include <Atlas/segmentation/internal/elements/Element_graph.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <tuple>
#include <vector>

namespace Atlas {

namespace internal {

inline void require_valid(const Region_growing_segmentation::Options& options)
{
  require_not_negative(options.planarity_weight, "planarity_weight");
  require_not_negative(options.compactness_weight, "compactness_weight");
  require_not_negative(options.max_cost, "max_cost");
  require(std::isfinite(options.max_cost), "max_cost", "must be finite");
  require_not_negative(options.max_spread, "max_spread");
}

/// Charts so far, with what their cost needs.
struct Regions
{
  Element_graph graph;
  std::vector<Eigen::Matrix3d> second; ///< integral of x x^T, from the graph's origin
  std::vector<double> perimeter;
};

/// The regions of single elements. O(n).
inline Regions initial_regions(const Surface& surface, const std::vector<Index>& element, Index count)
{
  Regions r;
  r.graph = element_graph(surface, element, count);
  r.second.assign(count, Eigen::Matrix3d::Zero());
  r.perimeter.assign(count, 0);
  for (Index t = 0; t < surface.number_of_triangles(); ++t) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      const Vector_3 v = surface.point(h) - r.graph.origin;
      const Eigen::Vector3d x(v.x(), v.y(), v.z());
      sum += x;
      squares += x * x.transpose();
      const Index o = surface.opposite[h];
      if (o == no_index || element[o / 3] != element[t])
        r.perimeter[element[t]] +=
            std::sqrt(CGAL::squared_distance(surface.point(h), surface.point(next_halfedge(h))));
    }
    const double area = std::sqrt(
        CGAL::squared_area(surface.point(3 * t), surface.point(3 * t + 1), surface.point(3 * t + 2)));
    // The integral of x x^T over a triangle with the corners a, b, c.
    r.second[element[t]] += area / 12 * (sum * sum.transpose() + squares);
  }
  return r;
}

/// The regions in which each is a group of regions. O(n).
inline Regions contract(const Regions& old, const std::vector<Index>& group, Index count)
{
  Regions r;
  r.graph = contract(old.graph, group, count);
  r.second.assign(count, Eigen::Matrix3d::Zero());
  r.perimeter.assign(count, 0);
  for (Index e = 0; e < old.graph.size(); ++e) {
    r.second[group[e]] += old.second[e];
    r.perimeter[group[e]] += old.perimeter[e];
    for (std::size_t k = old.graph.first[e]; k < old.graph.first[e + 1]; ++k)
      if (group[old.graph.links[k].element] == group[e])
        r.perimeter[group[e]] -= old.graph.links[k].length; // once from each side
  }
  return r;
}

/// The cost of the chart that two make; infinity if they must not.
inline double cost_of_union(const Regions& r, Index a, Index b, double length,
                            const Region_growing_segmentation::Options& options)
{
  const Element_graph& g = r.graph;
  const double area = g.area[a] + g.area[b];
  const double perimeter = std::max(0.0, r.perimeter[a] + r.perimeter[b] - 2 * length);
  if (!(area > 0))
    return 0;
  const double compact = std::max(0.0, perimeter * perimeter / (4 * std::numbers::pi * area) - 1);
  const double spread = 2 * (1 - std::sqrt((g.area_vector[a] + g.area_vector[b]).squared_length()) / area);
  if (spread > options.max_spread)
    return std::numeric_limits<double>::infinity();
  const Vector_3 m = g.moment[a] + g.moment[b];
  const Eigen::Vector3d mean(m.x() / area, m.y() / area, m.z() / area);
  const Eigen::Matrix3d covariance = (r.second[a] + r.second[b]) / area - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
  const double distance = std::max(0.0, solver.eigenvalues()(0));
  return options.planarity_weight * distance / area + options.compactness_weight * compact;
}

/// Pairs charts, cheapest pairs first, none dearer than the bound.
inline Index pair_regions(const Regions& r, double bound, const Region_growing_segmentation::Options& options,
                          std::vector<Index>& group)
{
  std::vector<std::tuple<double, Index, Index>> pairs;
  for (Index a = 0; a < r.graph.size(); ++a)
    for (std::size_t k = r.graph.first[a]; k < r.graph.first[a + 1]; ++k)
      if (const auto& link = r.graph.links[k]; a < link.element)
        if (const double c = cost_of_union(r, a, link.element, link.length, options); c <= bound)
          pairs.emplace_back(c, a, link.element);
  std::sort(pairs.begin(), pairs.end());
  std::vector<Index> partner(r.graph.size(), no_index);
  for (const auto& [c, a, b] : pairs)
    if (partner[a] == no_index && partner[b] == no_index) {
      partner[a] = b;
      partner[b] = a;
    }
  group.assign(r.graph.size(), no_index);
  Index count = 0;
  for (Index e = 0; e < group.size(); ++e)
    if (group[e] == no_index) {
      group[e] = count;
      if (partner[e] != no_index)
        group[partner[e]] = count;
      ++count;
    }
  return count;
}

} // namespace internal

ATLAS_INLINE Region_growing_segmentation::Region_growing_segmentation(const Options& options)
    : options_(options)
{
  internal::require_valid(options);
}

ATLAS_INLINE Segmentation Region_growing_segmentation::segment(const Surface& surface,
                                                               const Execution& execution) const
{
  std::vector<Index> chart;
  Index charts = internal::elements_of_triangles(surface, chart);
  std::vector<Index> element = chart;
  internal::Regions regions = internal::initial_regions(surface, element, charts);
  for (Index e = 0; e < charts; ++e)
    chart[e] = e;
  chart.resize(charts);

  constexpr int levels = 10;             // bounds, each twice the last
  constexpr int rounds = 40;             // at most, per bound
  constexpr Index fewest_per_round = 50; // the next bound comes when less than 1 of so many charts merge
  double bound = options_.max_cost / (1 << levels);
  for (int level = 0; level <= levels; ++level, bound *= 2)
    for (int round = 0; round < rounds && execution.proceed(double(level) / (levels + 1)); ++round) {
      std::vector<Index> group;
      const Index fewer = internal::pair_regions(regions, bound, options_, group);
      const Index merged = charts - fewer;
      if (merged == 0)
        break;
      for (Index& c : chart)
        c = group[c];
      regions = internal::contract(regions, group, fewer);
      charts = fewer;
      if (level < levels && merged < charts / fewest_per_round)
        break;
    }
  return internal::segmentation_of_elements(surface, element, chart, charts);
}

} // namespace Atlas

#endif
