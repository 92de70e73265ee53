// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_VERTEX_BLOCK_CHOLESKY_H
#define ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_VERTEX_BLOCK_CHOLESKY_H

#include <Atlas/parameterization/internal/geometry/border.h>
#include <Atlas/parameterization/internal/sparse/fill_reducing_order.h>
#include <Atlas/parameterization/internal/sparse/multifrontal_cholesky.h>
#include <Atlas/parameterization/internal/sparse/supernodal_symbolic.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace Atlas::internal {

/// The vertices and edges of a chart.
inline Graph vertex_graph(const Chart& chart)
{
  const Vertex_adjacency adjacency(chart);
  Graph graph{{0}, {}};
  std::vector<Index> neighbors;
  for (Index v = 0; v < chart.number_of_vertices(); ++v) {
    neighbors.clear();
    for (std::size_t k = adjacency.first[v]; k < adjacency.first[v + 1]; ++k)
      if (adjacency.neighbor[k] != v)
        neighbors.push_back(adjacency.neighbor[k]);
    std::sort(neighbors.begin(), neighbors.end());
    graph.neighbor.insert(graph.neighbor.end(), neighbors.begin(),
                          std::unique(neighbors.begin(), neighbors.end()));
    graph.first.push_back(graph.neighbor.size());
  }
  return graph;
}

/// \brief A symmetric positive definite matrix with a 2x2 block for every vertex and every edge of a chart,
/// assembled triangle by triangle and factorized again and again with one symbolic analysis on the vertices.
class Vertex_block_cholesky
{
public:
  /// A block by rows: xx, xy, yx, yy.
  using Block = std::array<double, 4>;

  explicit Vertex_block_cholesky(const Chart& chart) : Vertex_block_cholesky(chart, vertex_graph(chart)) {}
  Vertex_block_cholesky(const Vertex_block_cholesky&) = delete;
  Vertex_block_cholesky& operator=(const Vertex_block_cholesky&) = delete;

  void set_zero()
  {
    std::fill(diagonal_.begin(), diagonal_.end(), Block{});
    std::fill(lower_.begin(), lower_.end(), Block{});
  }

  /// Adds to the diagonal block of a vertex.
  void add(Index v, const Block& block) { add(diagonal_[symbolic_.place(v)], block); }

  /// Adds to the block of the i-th and the (i+1)-th corner of a triangle.
  void add(Index t, int i, const Block& block)
  {
    const Slot& slot = slots_[3 * static_cast<std::size_t>(t) + i];
    add(lower_[slot.entry], slot.is_transposed ? Block{block[0], block[2], block[1], block[3]} : block);
  }

  /// Adds `share` of the mean of the diagonal to the diagonal: lifts what translations leave singular.
  void regularize(double share)
  {
    double sum = 0;
    for (const Block& block : diagonal_)
      sum += block[0] + block[3];
    const double shift = share * sum / (2 * static_cast<double>(diagonal_.size()));
    for (Block& block : diagonal_) {
      block[0] += shift;
      block[3] += shift;
    }
  }

  /// Solves for x in place, one complex number for each vertex.
  bool solve(std::vector<Complex>& b)
  {
    const bool is_factorized = cholesky_.factorize(
        [&](Index c, auto add_entry) {
          add_entry(0, 0, diagonal_[c][0]);
          add_entry(1, 0, diagonal_[c][2]);
          add_entry(1, 1, diagonal_[c][3]);
        },
        [&](std::size_t k, auto add_entry) {
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              add_entry(i, j, lower_[k][2 * i + j]);
        },
        [](std::size_t) { return false; });
    if (!is_factorized)
      return false;
    std::vector<double> x(2 * b.size());
    for (Index v = 0; v < b.size(); ++v) {
      x[2 * symbolic_.place(v)] = b[v].real();
      x[2 * symbolic_.place(v) + 1] = b[v].imag();
    }
    const bool is_solved = cholesky_.solve(x);
    for (Index v = 0; v < b.size(); ++v)
      b[v] = {x[2 * symbolic_.place(v)], x[2 * symbolic_.place(v) + 1]};
    return is_solved;
  }

private:
  /// Which entry below the diagonal, and whether its row is the second of the two corners.
  struct Slot
  {
    std::size_t entry;
    bool is_transposed;
  };

  Vertex_block_cholesky(const Chart& chart, const Graph& graph)
      : symbolic_(graph, approximate_minimum_degree(graph)), cholesky_(symbolic_),
        diagonal_(chart.number_of_vertices()), lower_(symbolic_.number_of_entries() + 1)
  {
    slots_.reserve(3 * chart.number_of_triangles());
    for (const auto& corner : chart.triangles)
      for (int i = 0; i < 3; ++i)
        slots_.push_back(slot(symbolic_.place(corner[i]), symbolic_.place(corner[(i + 1) % 3])));
  }

  /// A triangle that repeats a vertex has an edge without an entry; that goes to a place of its own.
  Slot slot(Index p, Index q) const
  {
    std::size_t low = symbolic_.lower_begin(std::min(p, q)), high = symbolic_.lower_begin(std::min(p, q) + 1);
    if (p == q)
      return {symbolic_.number_of_entries(), false};
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (symbolic_.lower_row(middle) > std::max(p, q) ? high : low) = middle;
    }
    return {low, p < q};
  }

  static void add(Block& to, const Block& block)
  {
    for (int i = 0; i < 4; ++i)
      to[i] += block[i];
  }

  Supernodal_symbolic symbolic_;
  Multifrontal_cholesky<2> cholesky_;
  std::vector<Block> diagonal_, lower_;
  std::vector<Slot> slots_;
};

} // namespace Atlas::internal

#endif
