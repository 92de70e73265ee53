// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_BLOCK_SYSTEM_H
#define ATLAS_PARAMETERIZATION_INTERNAL_BLOCK_SYSTEM_H

#include <Atlas/parameterization/internal/border.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// \brief A symmetric positive definite matrix with a 2x2 block for every vertex and every edge of a chart,
/// assembled triangle by triangle and factorized again and again with one symbolic analysis.
///
/// The fill-reducing order is found on the n vertices, not on the 2n unknowns.
class Block_system
{
public:
  /// A block by rows: xx, xy, yx, yy.
  using Block = std::array<double, 4>;

  explicit Block_system(const Chart& chart) : chart_(chart)
  {
    const std::size_t n = chart.number_of_vertices();
    const Eigen::SparseMatrix<double, Eigen::ColMajor, int> graph = vertex_graph(chart);
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
    Eigen::AMDOrdering<int>()(graph, inverse);
    place_.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      place_[inverse.indices()[static_cast<Eigen::Index>(k)]] = static_cast<int>(k);
    build_pattern(graph);
    find_slots();
    llt_.analyzePattern(matrix_);
  }

  void set_zero() { std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.); }

  /// Adds to the diagonal block of a vertex.
  void add(Index v, const Block& block)
  {
    const int column = 2 * place_[v];
    double* first = matrix_.valuePtr() + matrix_.outerIndexPtr()[column];
    first[0] += block[0];
    first[1] += block[2];
    matrix_.valuePtr()[matrix_.outerIndexPtr()[column + 1]] += block[3];
  }

  /// Adds to the block of the i-th and the (i+1)-th corner of a triangle.
  void add(Index t, int i, const Block& block)
  {
    const Slot& slot = slots_[3 * static_cast<std::size_t>(t) + i];
    double *x = matrix_.valuePtr() + slot.first, *y = matrix_.valuePtr() + slot.second;
    x[0] += block[0];
    x[1] += slot.is_transposed ? block[1] : block[2]; // the lower triangle is stored
    y[0] += slot.is_transposed ? block[2] : block[1];
    y[1] += block[3];
  }

  /// Adds `share` of the mean of the diagonal to the diagonal: lifts what translations leave singular.
  void regularize(double share)
  {
    double sum = 0;
    for (Eigen::Index c = 0; c < matrix_.cols(); ++c)
      sum += matrix_.valuePtr()[matrix_.outerIndexPtr()[c]];
    const double shift = share * sum / static_cast<double>(std::max<Eigen::Index>(1, matrix_.cols()));
    for (Eigen::Index c = 0; c < matrix_.cols(); ++c)
      matrix_.valuePtr()[matrix_.outerIndexPtr()[c]] += shift;
  }

  /// Solves for x in place, one complex number for each vertex.
  bool solve(std::vector<Complex>& b)
  {
    llt_.factorize(matrix_);
    if (llt_.info() != Eigen::Success)
      return false;
    Eigen::VectorXd right(matrix_.cols());
    for (std::size_t v = 0; v < b.size(); ++v) {
      right[2 * place_[v]] = b[v].real();
      right[2 * place_[v] + 1] = b[v].imag();
    }
    const Eigen::VectorXd x = llt_.solve(right);
    for (std::size_t v = 0; v < b.size(); ++v)
      b[v] = {x[2 * place_[v]], x[2 * place_[v] + 1]};
    return x.allFinite();
  }

private:
  /// Where the two columns of a block begin among the values.
  struct Slot
  {
    int first, second;
    bool is_transposed;
  };

  static Eigen::SparseMatrix<double, Eigen::ColMajor, int> vertex_graph(const Chart& chart)
  {
    const Vertex_adjacency adjacency(chart);
    const auto n = static_cast<int>(chart.number_of_vertices());
    std::vector<int> neighbors;
    Eigen::SparseMatrix<double, Eigen::ColMajor, int> graph(n, n);
    graph.reserve(static_cast<Eigen::Index>(adjacency.neighbor.size() / 2 + 2 * chart.number_of_vertices()));
    for (int v = 0; v < n; ++v) {
      neighbors.assign(1, v);
      for (std::size_t k = adjacency.first[v]; k < adjacency.first[v + 1]; ++k)
        neighbors.push_back(static_cast<int>(adjacency.neighbor[k]));
      std::sort(neighbors.begin(), neighbors.end());
      neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
      graph.startVec(v);
      for (const int w : neighbors)
        graph.insertBack(w, v) = 1;
    }
    graph.finalize();
    return graph;
  }

  void build_pattern(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& graph)
  {
    const int n = static_cast<int>(graph.cols());
    std::vector<int> vertex(n), below;
    for (int v = 0; v < n; ++v)
      vertex[place_[v]] = v;
    matrix_.resize(2 * n, 2 * n);
    matrix_.reserve(2 * graph.nonZeros() + 2 * n);
    for (int p = 0; p < n; ++p) {
      below.clear();
      for (Eigen::SparseMatrix<double, Eigen::ColMajor, int>::InnerIterator it(graph, vertex[p]); it; ++it)
        if (const int q = place_[it.row()]; q > p)
          below.push_back(q);
      std::sort(below.begin(), below.end());
      for (int c = 2 * p; c < 2 * p + 2; ++c) {
        matrix_.startVec(c);
        for (int r = c; r < 2 * p + 2; ++r)
          matrix_.insertBack(r, c) = 0;
        for (const int q : below) {
          matrix_.insertBack(2 * q, c) = 0;
          matrix_.insertBack(2 * q + 1, c) = 0;
        }
      }
    }
    matrix_.finalize();
  }

  void find_slots()
  {
    const int *outer = matrix_.outerIndexPtr(), *inner = matrix_.innerIndexPtr();
    slots_.reserve(3 * chart_.number_of_triangles());
    for (const auto& corner : chart_.triangles)
      for (int i = 0; i < 3; ++i) {
        const int p = place_[corner[i]], q = place_[corner[(i + 1) % 3]], low = std::min(p, q);
        const int* row =
            std::lower_bound(inner + outer[2 * low], inner + outer[2 * low + 1], 2 * std::max(p, q));
        const int first = static_cast<int>(row - inner);
        // The second column lacks the entry above the diagonal.
        slots_.push_back({first, first - outer[2 * low] - 1 + outer[2 * low + 1], p < q});
      }
  }

  const Chart& chart_;
  std::vector<int> place_;
  Eigen::SparseMatrix<double, Eigen::ColMajor, int> matrix_;
  std::vector<Slot> slots_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double, Eigen::ColMajor, int>, Eigen::Lower,
                       Eigen::NaturalOrdering<int>>
      llt_;
};

} // namespace Atlas::internal

#endif
