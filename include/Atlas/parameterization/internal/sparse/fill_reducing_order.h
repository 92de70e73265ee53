// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_FILL_REDUCING_ORDER_H
#define ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_FILL_REDUCING_ORDER_H

#include <Atlas/parameterization/internal/sparse/supernodal_symbolic.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// Approximate minimum degree: the k-th vertex to eliminate.
inline std::vector<Index> approximate_minimum_degree(const Graph& graph)
{
  const auto n = static_cast<int>(graph.size());
  Eigen::SparseMatrix<double, Eigen::ColMajor, int> pattern(n, n);
  pattern.reserve(static_cast<Eigen::Index>(graph.neighbor.size()) + n);
  for (int v = 0; v < n; ++v) {
    pattern.startVec(v);
    bool has_diagonal = false;
    for (std::size_t e = graph.first[v]; e < graph.first[v + 1]; ++e) {
      const auto w = static_cast<int>(graph.neighbor[e]);
      if (w > v && !has_diagonal) {
        pattern.insertBackByOuterInner(v, v) = 1;
        has_diagonal = true;
      }
      pattern.insertBackByOuterInner(v, w) = 1;
    }
    if (!has_diagonal)
      pattern.insertBackByOuterInner(v, v) = 1;
  }
  pattern.finalize();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern, permutation);
  std::vector<Index> order(graph.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    order[k] = static_cast<Index>(permutation.indices()[static_cast<Eigen::Index>(k)]);
  return order;
}

} // namespace Atlas::internal

#endif
