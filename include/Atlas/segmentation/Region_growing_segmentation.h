// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_REGION_GROWING_SEGMENTATION_H
#define ATLAS_SEGMENTATION_REGION_GROWING_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/elements/Element_graph.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

namespace Atlas {

/// \brief Faces grow together to charts while these stay planar and compact.
///
/// After Sander, Snyder, Gortler, Hoppe, *Texture Mapping Progressive Meshes*, SIGGRAPH 2001, section 3:
/// every face starts as a chart of its own, and the pair with the least cost merges; the cost grows with the
/// mean squared distance of the merged chart to its best plane, and with its perimeter. Two things differ:
/// the perimeter counts by the chart's own area, as in Garland, Willmott, Heckbert, *Hierarchical Face
/// Clustering*, I3D 2001, so that large planes may become one chart; and all pairs below a rising bound merge
/// at once, each chart with one other, so that the work is O(n log n). A baseline, and a base for merging. A
/// model of `ChartSegmentation`.
class Region_growing_segmentation
{
public:
  struct Options
  {
    /// Weight of (mean squared distance to the best plane) / (area of the chart).
    double planarity_weight = 400;
    /// Weight of (perimeter squared) / (4 pi area of the chart) - 1, which is 0 for a disc.
    double compactness_weight = 0.2;
    /// Pairs whose cost would be larger do not merge.
    double max_cost = 1;
    /// Nor do pairs for which the mean of |n - N|^2 would be larger: the two sides of a plate are coplanar,
    /// too.
    double max_spread = 0.5;
  };

  Region_growing_segmentation() = default;
  explicit Region_growing_segmentation(const Options& options) : options_(options) {}

  const Options& options() const { return options_; }

  /// Once cancelled, returns what has grown by then.
  Segmentation segment(const Surface& surface, const Execution& execution) const
  {
    std::vector<Index> chart;
    Index charts = internal::elements_of_triangles(surface, chart);
    std::vector<Index> element = chart;
    Regions regions = initial_regions(surface, element, charts);
    for (Index e = 0; e < charts; ++e)
      chart[e] = e;
    chart.resize(charts);

    constexpr int levels = 10; // bounds, each twice the last
    constexpr int rounds = 40; // at most, per bound
    double bound = options_.max_cost / (1 << levels);
    for (int level = 0; level <= levels; ++level, bound *= 2)
      for (int round = 0; round < rounds && execution.proceed(double(level) / (levels + 1)); ++round) {
        std::vector<Index> group;
        const Index fewer = match(regions, bound, group);
        const Index merged = charts - fewer;
        if (merged == 0)
          break;
        for (Index& c : chart)
          c = group[c];
        regions = join(regions, group, fewer);
        charts = fewer;
        if (level < levels && merged < charts / 50)
          break;
      }
    return internal::segmentation_of_elements(surface, element, chart, charts);
  }

private:
  /// Charts so far, with what their cost needs.
  struct Regions
  {
    internal::Element_graph graph;
    std::vector<Eigen::Matrix3d> second; ///< integral of x x^T, from the graph's origin
    std::vector<double> perimeter;
  };

  static Regions initial_regions(const Surface& surface, const std::vector<Index>& element, Index count)
  {
    Regions r;
    r.graph = internal::element_graph(surface, element, count);
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
      r.second[element[t]] += area / 12 * (sum * sum.transpose() + squares);
    }
    return r;
  }

  static Regions join(const Regions& old, const std::vector<Index>& group, Index count)
  {
    Regions r;
    r.graph = internal::contract(old.graph, group, count);
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
  double cost(const Regions& r, Index a, Index b, double length) const
  {
    const internal::Element_graph& g = r.graph;
    const double area = g.area[a] + g.area[b];
    const double perimeter = std::max(0.0, r.perimeter[a] + r.perimeter[b] - 2 * length);
    if (!(area > 0))
      return 0;
    const double compact = std::max(0.0, perimeter * perimeter / (4 * CGAL_PI * area) - 1);
    const double spread = 2 * (1 - std::sqrt((g.area_vector[a] + g.area_vector[b]).squared_length()) / area);
    if (spread > options_.max_spread)
      return std::numeric_limits<double>::infinity();
    const Vector_3 m = g.moment[a] + g.moment[b];
    const Eigen::Vector3d mean(m.x() / area, m.y() / area, m.z() / area);
    const Eigen::Matrix3d covariance = (r.second[a] + r.second[b]) / area - mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
    const double distance = std::max(0.0, solver.eigenvalues()(0));
    return options_.planarity_weight * distance / area + options_.compactness_weight * compact;
  }

  /// Pairs charts, cheapest pairs first, none dearer than the bound.
  Index match(const Regions& r, double bound, std::vector<Index>& group) const
  {
    std::vector<std::tuple<double, Index, Index>> pairs;
    for (Index a = 0; a < r.graph.size(); ++a)
      for (std::size_t k = r.graph.first[a]; k < r.graph.first[a + 1]; ++k)
        if (const auto& link = r.graph.links[k]; a < link.element)
          if (const double c = cost(r, a, link.element, link.length); c <= bound)
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

  Options options_;
};

} // namespace Atlas

#endif
