// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_VARIATIONAL_SEGMENTATION_H
#define ATLAS_SEGMENTATION_VARIATIONAL_SEGMENTATION_H

#include <Atlas/core/Execution.h>
#include <Atlas/core/Surface.h>
#include <Atlas/segmentation/internal/elements/Element_graph.h>
#include <Atlas/segmentation/internal/elements/variational_clusters.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace Atlas {

/// \brief Variational shape approximation: clusters of triangles that planes fit best.
///
/// Cohen-Steiner, Alliez, Desbrun, *Variational Shape Approximation*, SIGGRAPH 2004, with the metric L2,1 and
/// a term that keeps charts compact. The clusters are found on groups of triangles first, whose number hardly
/// depends on the resolution and whose averaged normals filter noise, and settle on the triangles at the end.
/// Input faces stay whole, patches and seams the user asks for are not crossed, charts are connected.
/// Deterministic; O(n log n). A model of `ChartSegmentation`.
class Variational_segmentation
{
public:
  struct Options
  {
    /// Number of charts; 0 lets `max_spread` decide. Every connected component has one chart at least.
    Index number_of_charts = 0;
    /// A chart gets divided while the mean of |n - N|^2 over it is larger; n is the normal, N that of the
    /// chart.
    double max_spread = 0.12;
    /// Charts below this share of their component's area are divided more reluctantly.
    double small_share = 1.0 / 60;
    /// Weight of the squared distance to the chart's centre, in units of the mean squared radius of charts.
    double compactness = 0.1;
    /// Rounds of fitting planes and growing charts anew after the last chart has been added.
    int iterations = 8;
    /// Of these, the rounds on the triangles themselves.
    int fine_iterations = 2;
  };

  Variational_segmentation() = default;
  explicit Variational_segmentation(const Options& options) : options_(options) {}

  const Options& options() const { return options_; }

  /// Once cancelled, returns one chart per connected component or better.
  Segmentation segment(const Surface& surface, const Execution& execution) const
  {
    std::vector<Index> element;
    const Index count = internal::elements_of_triangles(surface, element);
    const internal::Element_graph graph = internal::element_graph(surface, element, count);

    // Pairs of pairs of ... of elements, until few enough remain.
    std::vector<Index> group(count);
    for (Index e = 0; e < count; ++e)
      group[e] = e;
    internal::Element_graph coarse = graph;
    const std::size_t enough =
        std::max<std::size_t>({coarse_size, count / 64, 32u * options_.number_of_charts});
    while (coarse.size() > 2 * enough && execution.proceed(0.1)) {
      std::vector<Index> pair;
      const Index pairs = internal::match_neighbors(coarse, pair);
      if (pairs > 0.9 * static_cast<double>(coarse.size()))
        break;
      for (Index& g : group)
        g = pair[g];
      coarse = internal::contract(coarse, pair, pairs);
    }

    internal::Variational_clusters clusters(coarse, options_.compactness);
    add_seeds(coarse, clusters, execution);
    if (options_.number_of_charts == 0)
      remove_seeds(coarse, clusters);
    const int fine = std::clamp(options_.fine_iterations, 1, std::max(1, options_.iterations));
    for (int i = 0; i < options_.iterations - fine && execution.proceed(0.3 + 0.3 * i / options_.iterations);
         ++i) {
      clusters.fit();
      clusters.flood();
    }
    const std::vector<Index> chart = settle(graph, group, clusters, fine, execution);
    return internal::segmentation_of_elements(surface, element, chart, static_cast<Index>(clusters.size()));
  }

private:
  /// Groups of triangles on which the charts are found.
  static constexpr std::size_t coarse_size = 4000;

  /// Divides the charts that fit worst, at most all of them at once, until the options are met.
  void add_seeds(const internal::Element_graph& graph, internal::Variational_clusters& clusters,
                 const Execution& execution) const
  {
    std::vector<Index> component;
    const Index components =
        internal::label_components(graph, std::vector<Index>(graph.size(), 0), component);
    std::vector<double> area(components, 0);
    for (Index e = 0; e < graph.size(); ++e) {
      if (area[component[e]] == 0 && clusters.size() == component[e])
        clusters.add_seed(e);
      area[component[e]] += graph.area[e];
    }
    clusters.flood();
    while (execution.proceed(0.2)) {
      for (int i = 0; i < 2; ++i) { // settle a little, or planes divide that a neighbour would have taken
        clusters.fit();
        clusters.flood();
      }
      clusters.fit();
      std::vector<std::pair<double, Index>> bad; // (-energy, cluster)
      const auto spreads = clusters.spreads();
      for (Index c = 0; c < spreads.size(); ++c) {
        const auto& s = spreads[c];
        const double whole = area[component[clusters.seeds()[c]]];
        const double allowed = options_.max_spread * std::max(s.area, options_.small_share * whole);
        if (s.worst != no_index && s.energy > (options_.number_of_charts ? 0 : allowed))
          bad.emplace_back(-s.energy, c);
      }
      std::sort(bad.begin(), bad.end());
      if (options_.number_of_charts)
        bad.resize(std::min<std::size_t>(bad.size(), options_.number_of_charts > clusters.size()
                                                         ? options_.number_of_charts - clusters.size()
                                                         : 0));
      else // the next worst may be mended by then
        bad.resize((bad.size() + 1) / 2);
      if (bad.empty())
        break;
      for (const auto& [energy, c] : bad)
        clusters.add_seed(spreads[c].worst);
      clusters.flood();
    }
  }

  /// Leaves one seed where several planes are nearly the same; the nearest pairs go first.
  void remove_seeds(const internal::Element_graph& graph, internal::Variational_clusters& clusters) const
  {
    const internal::Element_graph plates =
        internal::contract(graph, clusters.clusters(), static_cast<Index>(clusters.size()));
    const auto length = [](const Vector_3& v) { return std::sqrt(v.squared_length()); };
    const auto spread = [&](const Vector_3& v, const Vector_3& w) { // of the union, beyond that of both
      const double sum = length(v) + length(w);
      return sum > 0 ? 2 * (1 - length(v + w) / sum) : 0;
    };
    std::vector<std::tuple<double, Index, Index>> pairs;
    for (Index a = 0; a < plates.size(); ++a)
      for (std::size_t k = plates.first[a]; k < plates.first[a + 1]; ++k)
        if (const Index b = plates.links[k].element; a < b)
          pairs.emplace_back(spread(plates.area_vector[a], plates.area_vector[b]), a, b);
    std::sort(pairs.begin(), pairs.end());

    std::vector<Index> root(plates.size());
    std::iota(root.begin(), root.end(), Index(0));
    const auto find = [&](Index c) {
      while (root[c] != c)
        c = root[c] = root[root[c]];
      return c;
    };
    std::vector<Vector_3> vector = plates.area_vector;
    for (const auto& [cost, first, second] : pairs) {
      Index a = find(first), b = find(second);
      if (length(vector[a]) < length(vector[b]))
        std::swap(a, b); // the seed of the larger one stays
      if (a == b || spread(vector[a], vector[b]) > options_.max_spread / 20)
        continue;
      root[b] = a;
      vector[a] = vector[a] + vector[b];
    }
    internal::Variational_clusters fewer(graph, options_.compactness);
    for (Index c = 0; c < plates.size(); ++c)
      if (root[c] == c)
        fewer.add_seed(clusters.seeds()[c]);
    fewer.flood();
    clusters = std::move(fewer);
  }

  /// Carries the clusters of groups to the elements and lets them settle there.
  std::vector<Index> settle(const internal::Element_graph& graph, const std::vector<Index>& group,
                            const internal::Variational_clusters& coarse, int rounds,
                            const Execution& execution) const
  {
    std::vector<Index> seed(coarse.size(), no_index);
    internal::Variational_clusters clusters(graph, options_.compactness);
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

  Options options_;
};

} // namespace Atlas

#endif
