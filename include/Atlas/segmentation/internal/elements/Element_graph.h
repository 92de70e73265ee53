// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_ELEMENT_GRAPH_H
#define ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_ELEMENT_GRAPH_H

#include <Atlas/core/Surface.h>
#include <Atlas/core/internal/Union_find.h>
#include <Atlas/core/internal/edge_rules.h>
#include <Atlas/core/internal/halfedges.h>
#include <Atlas/segmentation/internal/surface/Seam_costs.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief The smallest parts that charts are made of, with their adjacency and their moments.
///
/// An element is an input face, or faces joined by edges that must not become seams. Elements are adjacent
/// where they share an edge that a chart may run over: not a seam the user asks for, not the limit of a
/// patch.
struct Element_graph
{
  struct Link
  {
    Index element;
    double length; ///< of the shared edges
    double cost;   ///< of a seam along them: lengths times the user's factors
  };
  std::vector<std::size_t> first; ///< per element: where its links start; one more entry closes the list
  std::vector<Link> links;
  std::vector<double> area;
  std::vector<Vector_3> area_vector; ///< sum of area times normal
  std::vector<Vector_3> moment;      ///< area times centroid, from `origin`
  Point_3 origin = CGAL::ORIGIN;

  std::size_t size() const { return area.size(); }
  Vector_3 centroid(Index e) const { return area[e] > 0 ? moment[e] / area[e] : moment[e]; }
};

/// Per triangle its element, numbered in the order of first triangles; returns their number.
inline Index elements_of_triangles(const Surface& surface, std::vector<Index>& element)
{
  Components elements = connected_components(
      surface.opposite, [](Index) { return true; }, [&](Index h) { return must_not_be_seam(surface, h); });
  element = std::move(elements.of_triangle);
  return elements.count;
}

/// Fills the links from (element, other, length, cost) in any order; parallel links become one. O(n).
template <typename ForEachLink>
void fill_links(Element_graph& graph, std::size_t n, ForEachLink for_each_link)
{
  std::vector<std::size_t> start(n + 1, 0);
  for_each_link([&](Index a, Index, double, double) { ++start[a + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Element_graph::Link> raw(start.back());
  std::vector<std::size_t> fill(start.begin(), start.end() - 1);
  for_each_link([&](Index a, Index b, double length, double cost) { raw[fill[a]++] = {b, length, cost}; });

  constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  std::vector<std::size_t> slot(n, nowhere);
  graph.first.assign(1, 0);
  graph.links.clear();
  for (std::size_t a = 0; a < n; ++a) {
    const std::size_t begin = graph.links.size();
    for (std::size_t k = start[a]; k < start[a + 1]; ++k) {
      std::size_t& s = slot[raw[k].element];
      if (s != nowhere && s >= begin && s < graph.links.size() && graph.links[s].element == raw[k].element) {
        graph.links[s].length += raw[k].length;
        graph.links[s].cost += raw[k].cost;
      } else {
        s = graph.links.size();
        graph.links.push_back(raw[k]);
      }
    }
    graph.first.push_back(graph.links.size());
  }
}

/// The graph of the elements of a surface. O(n).
inline Element_graph element_graph(const Surface& surface, const std::vector<Index>& element, Index count)
{
  Element_graph graph;
  graph.area.assign(count, 0);
  graph.area_vector.assign(count, Vector_3(0, 0, 0));
  graph.moment.assign(count, Vector_3(0, 0, 0));
  // Moments from a point of the surface: a model far from the origin loses no digits.
  if (!surface.triangles.empty())
    graph.origin = surface.point(0);
  for (Index t = 0; t < surface.number_of_triangles(); ++t) {
    const Vector_3 a = surface.point(3 * t) - graph.origin, b = surface.point(3 * t + 1) - graph.origin,
                   c = surface.point(3 * t + 2) - graph.origin;
    const Vector_3 vector = CGAL::cross_product(b - a, c - a) / 2;
    const double area = std::sqrt(vector.squared_length());
    const Index e = element[t];
    graph.area[e] += area;
    graph.area_vector[e] = graph.area_vector[e] + vector;
    graph.moment[e] = graph.moment[e] + area / 3 * (a + b + c);
  }
  fill_links(graph, count, [&](auto link) {
    for (Index h = 0; h < surface.opposite.size(); ++h)
      if (!must_be_seam(surface, h) && element[h / 3] != element[surface.opposite[h] / 3]) {
        const double length =
            std::sqrt(CGAL::squared_distance(surface.point(h), surface.point(next_halfedge(h))));
        link(element[h / 3], element[surface.opposite[h] / 3], length, length * wanted_cost(surface, h));
      }
  });
  return graph;
}

/// The graph in which each element is a group of elements: `group[e]` in [0, count). O(n).
inline Element_graph contract(const Element_graph& graph, const std::vector<Index>& group, Index count)
{
  Element_graph result;
  result.origin = graph.origin;
  result.area.assign(count, 0);
  result.area_vector.assign(count, Vector_3(0, 0, 0));
  result.moment.assign(count, Vector_3(0, 0, 0));
  for (Index e = 0; e < graph.size(); ++e) {
    result.area[group[e]] += graph.area[e];
    result.area_vector[group[e]] = result.area_vector[group[e]] + graph.area_vector[e];
    result.moment[group[e]] = result.moment[group[e]] + graph.moment[e];
  }
  fill_links(result, count, [&](auto link) {
    for (Index e = 0; e < graph.size(); ++e)
      for (std::size_t k = graph.first[e]; k < graph.first[e + 1]; ++k)
        if (group[e] != group[graph.links[k].element])
          link(group[e], group[graph.links[k].element], graph.links[k].length, graph.links[k].cost);
  });
  return result;
}

/// What a bend between two elements costs, 1 - |a + b| / (|a| + |b|) for area vectors a and b: one of 10
/// degrees between equal halves about as much as a quarter of the shared length.
inline constexpr double weight_of_bends = 100;

/// Groups each element with at most one neighbour, the one it is most coplanar and most compact with. O(n).
inline Index match_neighbors(const Element_graph& graph, std::vector<Index>& group)
{
  Index count = 0;
  group.assign(graph.size(), no_index);
  for (Index e = 0; e < graph.size(); ++e) {
    if (group[e] != no_index)
      continue;
    Index best = no_index;
    double best_score = 0;
    for (std::size_t k = graph.first[e]; k < graph.first[e + 1]; ++k) {
      const Index other = graph.links[k].element;
      if (group[other] != no_index)
        continue;
      const double area = graph.area[e] + graph.area[other];
      const double flat =
          area > 0 ? std::sqrt((graph.area_vector[e] + graph.area_vector[other]).squared_length()) / area : 1;
      const double score = graph.links[k].cost / (std::sqrt(area) * (1 + weight_of_bends * (1 - flat)));
      if (best == no_index || score > best_score) {
        best = other;
        best_score = score;
      }
    }
    group[e] = count;
    if (best != no_index)
      group[best] = count;
    ++count;
  }
  return count;
}

/// Numbers connected sets of elements of equal label in the order of their first elements. O(n).
inline Index label_components(const Element_graph& graph, const std::vector<Index>& label,
                              std::vector<Index>& component)
{
  Union_find sets(graph.size());
  for (Index e = 0; e < graph.size(); ++e)
    for (std::size_t k = graph.first[e]; k < graph.first[e + 1]; ++k)
      if (const Index o = graph.links[k].element; label[o] == label[e])
        sets.unite(e, o);
  return sets.number_sets(component);
}

/// The segmentation in which triangle t is in the chart of its element; seams the user asks for are cuts.
inline Segmentation segmentation_of_elements(const Surface& surface, const std::vector<Index>& element,
                                             const std::vector<Index>& chart, Index number_of_charts)
{
  Segmentation result;
  result.number_of_charts = number_of_charts;
  result.chart.reserve(element.size());
  for (const Index e : element)
    result.chart.push_back(chart[e]);
  result.cut.assign(3 * element.size(), 0);
  for (Index h = 0; h < result.cut.size(); ++h)
    result.cut[h] = surface.opposite[h] != no_index && must_be_seam(surface, h);
  return result;
}

} // namespace Atlas::internal

#endif
