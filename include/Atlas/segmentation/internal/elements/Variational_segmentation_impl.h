// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_VARIATIONAL_SEGMENTATION_IMPL_H
#define ATLAS_SEGMENTATION_INTERNAL_ELEMENTS_VARIATIONAL_SEGMENTATION_IMPL_H

#include <Atlas/core/internal/Union_find.h>
#include <Atlas/segmentation/Variational_segmentation.h>
#include <Atlas/segmentation/internal/arguments.h>
#include <Atlas/segmentation/internal/elements/Element_graph.h>
#include <Atlas/segmentation/internal/elements/Variational_clusters.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas {

namespace internal {

/// Groups of triangles on which the charts are found, at least; as many as make the result hardly depend on
/// the resolution.
inline constexpr std::size_t coarse_elements = 4000;
/// At least so many of them for each chart that is asked for.
inline constexpr std::size_t coarse_elements_per_chart = 32;
/// And no more triangles in one of them than that, about.
inline constexpr std::size_t triangles_per_coarse_element = 64;
/// Planes are one whose union has less than the allowed spread divided by this.
inline constexpr double nearness_of_planes = 20;

inline void require_valid(const Variational_segmentation::Options& options)
{
  require_positive(options.max_spread, "max_spread");
  require_share(options.small_share, "small_share");
  require_not_negative(options.compactness, "compactness");
  require_in(options.iterations, 1, std::numeric_limits<int>::max(), "iterations");
  require_in(options.fine_iterations, 1, options.iterations, "fine_iterations");
}

/// Pairs of pairs of ... of elements, until few enough remain.
/// \param group  per element of the graph, receives the element of the result that it is in
inline Element_graph coarsen(const Element_graph& graph, std::size_t enough, std::vector<Index>& group,
                             const Execution& execution)
{
  constexpr double least_progress = 0.9; // where hardly any pairs are left, it does not get coarser
  group.resize(graph.size());
  std::iota(group.begin(), group.end(), Index(0));
  Element_graph coarse = graph;
  while (coarse.size() > 2 * enough && execution.proceed(0.1)) {
    std::vector<Index> pair;
    const Index pairs = match_neighbors(coarse, pair);
    if (pairs > least_progress * static_cast<double>(coarse.size()))
      break;
    for (Index& g : group)
      g = pair[g];
    coarse = contract(coarse, pair, pairs);
  }
  return coarse;
}

/// Per element the area of its connected component. Seeds one cluster in each component.
inline std::vector<double> seed_components(const Element_graph& graph, Variational_clusters& clusters)
{
  std::vector<Index> component;
  const Index components = label_components(graph, std::vector<Index>(graph.size(), 0), component);
  std::vector<double> area(components, 0), result(graph.size());
  for (Index e = 0; e < graph.size(); ++e) {
    if (area[component[e]] == 0 && clusters.size() == component[e])
      clusters.add_seed(e);
    area[component[e]] += graph.area[e];
  }
  for (Index e = 0; e < graph.size(); ++e)
    result[e] = area[component[e]];
  return result;
}

/// The elements that fit worst in the clusters that are to be divided now, worst cluster first.
/// \param whole  per element the area of its component
inline std::vector<Index> next_seeds(const Variational_clusters& clusters, const std::vector<double>& whole,
                                     const Variational_segmentation::Options& options)
{
  std::vector<std::pair<double, Index>> bad; // (-energy, cluster)
  const auto spreads = clusters.spreads();
  for (Index c = 0; c < spreads.size(); ++c) {
    const auto& s = spreads[c];
    const double allowed =
        options.max_spread * std::max(s.area, options.small_share * whole[clusters.seeds()[c]]);
    if (s.worst != no_index && s.energy > (options.number_of_charts ? 0 : allowed))
      bad.emplace_back(-s.energy, c);
  }
  std::sort(bad.begin(), bad.end());
  if (options.number_of_charts)
    bad.resize(std::min<std::size_t>(bad.size(), options.number_of_charts > clusters.size()
                                                     ? options.number_of_charts - clusters.size()
                                                     : 0));
  else // the next worst may be mended by then
    bad.resize((bad.size() + 1) / 2);
  std::vector<Index> result;
  for (const auto& [energy, c] : bad)
    result.push_back(spreads[c].worst);
  return result;
}

/// Divides the clusters that fit worst, at most all of them at once, until the options are met.
inline void add_seeds(const Element_graph& graph, const Variational_segmentation::Options& options,
                      Variational_clusters& clusters, const Execution& execution)
{
  const std::vector<double> whole = seed_components(graph, clusters);
  clusters.flood();
  while (execution.proceed(0.2)) {
    for (int i = 0; i < 2; ++i) { // settle a little, or planes divide that a neighbour would have taken
      clusters.fit();
      clusters.flood();
    }
    clusters.fit();
    const std::vector<Index> seeds = next_seeds(clusters, whole, options);
    if (seeds.empty())
      break;
    for (const Index e : seeds)
      clusters.add_seed(e);
    clusters.flood();
  }
}

/// How much |n - N|^2 the union of two plates has on average beyond what both have, by their area vectors.
inline double spread_of_union(const Vector_3& v, const Vector_3& w)
{
  const double sum = std::sqrt(v.squared_length()) + std::sqrt(w.squared_length());
  return sum > 0 ? 2 * (1 - std::sqrt((v + w).squared_length()) / sum) : 0;
}

/// Leaves one seed where several planes are nearly the same; the nearest pairs go first.
inline void remove_seeds(const Element_graph& graph, const Variational_segmentation::Options& options,
                         Variational_clusters& clusters)
{
  const Element_graph plates = contract(graph, clusters.clusters(), static_cast<Index>(clusters.size()));
  std::vector<std::tuple<double, Index, Index>> pairs;
  for (Index a = 0; a < plates.size(); ++a)
    for (std::size_t k = plates.first[a]; k < plates.first[a + 1]; ++k)
      if (const Index b = plates.links[k].element; a < b)
        pairs.emplace_back(spread_of_union(plates.area_vector[a], plates.area_vector[b]), a, b);
  std::sort(pairs.begin(), pairs.end());

  Union_find sets(plates.size());
  std::vector<Index> kept(plates.size()); // per set, by its least member: the plate whose seed stays
  std::iota(kept.begin(), kept.end(), Index(0));
  std::vector<Vector_3> vector = plates.area_vector;
  for (const auto& [cost, first, second] : pairs) {
    Index a = kept[sets.find(first)], b = kept[sets.find(second)];
    if (std::sqrt(vector[a].squared_length()) < std::sqrt(vector[b].squared_length()))
      std::swap(a, b); // the seed of the larger one stays
    if (a == b || spread_of_union(vector[a], vector[b]) > options.max_spread / nearness_of_planes)
      continue;
    sets.unite(a, b);
    kept[sets.find(a)] = a;
    vector[a] = vector[a] + vector[b];
  }
  Variational_clusters fewer(graph, options.compactness);
  for (Index c = 0; c < plates.size(); ++c)
    if (kept[sets.find(c)] == c)
      fewer.add_seed(clusters.seeds()[c]);
  fewer.flood();
  clusters = std::move(fewer);
}

/// Carries the clusters of groups to the elements and lets them settle there.
inline std::vector<Index> settle(const Element_graph& graph, const std::vector<Index>& group,
                                 const Variational_clusters& coarse,
                                 const Variational_segmentation::Options& options, const Execution& execution)
{
  const int rounds = options.fine_iterations;
  std::vector<Index> seed(coarse.size(), no_index);
  Variational_clusters clusters(graph, options.compactness);
  for (Index e = 0; e < graph.size(); ++e)
    if (const Index c = coarse.clusters()[group[e]]; seed[c] == no_index && group[e] == coarse.seeds()[c])
      seed[c] = e;
  for (const Index e : seed)
    clusters.add_seed(e);
  clusters.assign(coarse.clusters(), group);
  for (int i = 0; i < rounds && (i == 0 || execution.proceed(0.7 + 0.3 * i / rounds)); ++i) {
    clusters.fit();
    clusters.flood();
  }
  return clusters.clusters();
}

} // namespace internal

ATLAS_INLINE Variational_segmentation::Variational_segmentation(const Options& options) : options_(options)
{
  internal::require_valid(options);
}

ATLAS_INLINE Segmentation Variational_segmentation::segment(const Surface& surface,
                                                            const Execution& execution) const
{
  std::vector<Index> element, group;
  const Index count = internal::elements_of_triangles(surface, element);
  const internal::Element_graph graph = internal::element_graph(surface, element, count);
  const std::size_t enough =
      std::max<std::size_t>({internal::coarse_elements, count / internal::triangles_per_coarse_element,
                             internal::coarse_elements_per_chart * options_.number_of_charts});
  const internal::Element_graph coarse = internal::coarsen(graph, enough, group, execution);

  internal::Variational_clusters clusters(coarse, options_.compactness);
  internal::add_seeds(coarse, options_, clusters, execution);
  if (options_.number_of_charts == 0)
    internal::remove_seeds(coarse, options_, clusters);
  for (int i = 0; i < options_.iterations - options_.fine_iterations &&
                  execution.proceed(0.3 + 0.3 * i / options_.iterations);
       ++i) {
    clusters.fit();
    clusters.flood();
  }
  const std::vector<Index> chart = internal::settle(graph, group, clusters, options_, execution);
  return internal::segmentation_of_elements(surface, element, chart, static_cast<Index>(clusters.size()));
}

} // namespace Atlas

#endif
