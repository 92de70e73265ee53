// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_NORMAL_SEGMENTATION_H
#define ATLAS_SEGMENTATION_NORMAL_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/elements/Element_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Connected faces whose normals fall into the same cell of the sphere of directions.
///
/// After Maillot, Yahia, Verroust, *Interactive Texture Mapping*, SIGGRAPH 1993: normals are put into the
/// cells of a grid on the sphere, here that of a cube whose sides have cells_per_side^2 cells; faces of one
/// cell that hang together make a chart; small charts join the neighbour they share the longest border with.
/// A baseline: simple and fast, and the seams of smooth shapes run anywhere. O(n log n). A model of
/// `ChartSegmentation`.
class Normal_segmentation
{
public:
  struct Options
  {
    /// 1 groups by the six sides of a cube, 2 by 24 cells.
    int cells_per_side = 1;
    /// Charts with a smaller share of the surface's area join a neighbour.
    double min_share = 1.0 / 400;
  };

  Normal_segmentation() = default;
  explicit Normal_segmentation(const Options& options) : options_(options) {}

  const Options& options() const { return options_; }

  /// Once cancelled, leaves small charts as they are.
  Segmentation segment(const Surface& surface, const Execution& execution) const
  {
    std::vector<Index> element;
    const Index count = internal::elements_of_triangles(surface, element);
    internal::Element_graph graph = internal::element_graph(surface, element, count);

    std::vector<Index> cells(count), chart;
    for (Index e = 0; e < count; ++e)
      cells[e] = cell(graph.area_vector[e]);
    Index charts = internal::label_components(graph, cells, chart);
    const double least = options_.min_share * std::accumulate(graph.area.begin(), graph.area.end(), 0.0);
    graph = internal::contract(graph, chart, charts);
    // Each round at least halves the small charts that have a neighbour.
    while (execution.proceed(0.5)) {
      std::vector<Index> group;
      const Index fewer = absorb_small(graph, least, group);
      if (fewer == charts)
        break;
      for (Index& c : chart)
        c = group[c];
      graph = internal::contract(graph, group, fewer);
      charts = fewer;
    }
    return internal::segmentation_of_elements(surface, element, chart, charts);
  }

private:
  /// The cell of a direction; all of them for the null vector are one.
  Index cell(const Vector_3& v) const
  {
    const std::array<double, 3> x{v.x(), v.y(), v.z()};
    const auto size = [&](int i) { return std::abs(x[i]); };
    const int axis = size(0) >= size(1) && size(0) >= size(2) ? 0 : size(1) >= size(2) ? 1 : 2;
    const int n = std::clamp(options_.cells_per_side, 1, 1000);
    Index side = static_cast<Index>(2 * axis + (x[axis] < 0));
    for (int k = 1; k <= 2; ++k) {
      const double share = size(axis) > 0 ? (x[(axis + k) % 3] / size(axis) + 1) / 2 : 0;
      side = side * static_cast<Index>(n) +
             static_cast<Index>(std::clamp(static_cast<int>(share * n), 0, n - 1));
    }
    return side;
  }

  /// Joins each small element with the neighbour of the longest border, one way only.
  static Index absorb_small(const internal::Element_graph& graph, double least, std::vector<Index>& group)
  {
    std::vector<Index> target(graph.size());
    std::iota(target.begin(), target.end(), Index(0));
    const auto find = [&](Index e) {
      while (target[e] != e)
        e = target[e] = target[target[e]];
      return e;
    };
    for (Index e = 0; e < graph.size(); ++e) {
      if (graph.area[e] >= least || graph.first[e] == graph.first[e + 1])
        continue;
      const auto* begin = graph.links.data() + graph.first[e];
      const auto* end = graph.links.data() + graph.first[e + 1];
      const auto* best =
          std::max_element(begin, end, [](const auto& a, const auto& b) { return a.length < b.length; });
      target[find(e)] = find(best->element);
    }
    group.assign(graph.size(), no_index);
    Index count = 0;
    for (Index e = 0; e < graph.size(); ++e) {
      const Index root = find(e);
      if (group[root] == no_index)
        group[root] = count++;
      group[e] = group[root];
    }
    return count;
  }

  Options options_;
};

} // namespace Atlas

#endif
