// SPDX-License-Identifier: MIT
#ifndef ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_MINIMUM_CUT_H
#define ATLAS_SEGMENTATION_INTERNAL_SMOOTHING_MINIMUM_CUT_H

#include <Atlas/core/Kernel.h>

#include <boost/graph/adjacency_list.hpp>
// Boost keeps optional iterators there that GCC cannot follow.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Atlas::internal {

/// \brief The cheapest way to separate the nodes tied to one side from those tied to the other. Capacities
/// are whole numbers, so that results are the same everywhere.
class Minimum_cut
{
public:
  /// Node n is the one side, node n + 1 the other.
  explicit Minimum_cut(std::size_t n) : graph_(n + 2) {}

  void connect(std::size_t i, std::size_t j, std::int64_t capacity)
  {
    const auto there = add_edge(i, j, graph_).first, back = add_edge(j, i, graph_).first;
    put(boost::edge_capacity, graph_, there, capacity);
    put(boost::edge_capacity, graph_, back, capacity);
    put(boost::edge_reverse, graph_, there, back);
    put(boost::edge_reverse, graph_, back, there);
  }

  /// Returns the capacity of the cut. Y. Boykov, V. Kolmogorov, An experimental comparison of
  /// min-cut/max-flow algorithms, PAMI 2004.
  std::int64_t run()
  {
    const std::size_t n = num_vertices(graph_) - 2;
    return boost::boykov_kolmogorov_max_flow(graph_, n, n + 1);
  }

  /// After run(): whether a node is on the first side.
  bool is_on_first_side(std::size_t i) const
  {
    return get(boost::vertex_color, graph_, i) == boost::black_color;
  }

private:
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Vertex_data =
      boost::property<boost::vertex_color_t, boost::default_color_type,
                      boost::property<boost::vertex_distance_t, long,
                                      boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>;
  using Edge_data =
      boost::property<boost::edge_capacity_t, std::int64_t,
                      boost::property<boost::edge_residual_capacity_t, std::int64_t,
                                      boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>;
  boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Vertex_data, Edge_data> graph_;
};

} // namespace Atlas::internal

#endif
